"""Sweeps: what single calls give, on threads and on a cluster, whatever happens to its workers."""

import itertools
import os
import signal

import pytest

import eigenring

TASKS = [
    *itertools.product(["catmull-clark", "doo-sabin", "lambda:optimal"], [3, 5, 12]),
    *itertools.product(["lambda"], [3, 4, 7], [0.4, 0.55]),
    ("tension", 6, {"order": 6, "u0": 2}),
    ("catmull-clark", 2),
    ("lambda", 5, 9.0),
]
TEXT = """
name = "mine"
kind = "one-ring"
parameters = { b = { default = "3/8", range = ["1/4", "1/2"] } }
[rule]
n = "3.."
f1 = "1/4"
f2 = "1/4"
f3 = "1/4"
d1 = "b"
d2 = "3/4-b"
e1 = "1/16"
e2 = "1/16"
alpha = "3/(2*n)"
beta = "1/(4*n)"
"""


def test_rows_are_what_single_calls_give():
    rows = eigenring.sweep(TASKS)
    assert [(row["scheme"], row["valence"]) for row in rows] == [(task[0], task[1]) for task in TASKS]
    for row in rows[:-2]:
        assert row["error"] is None
        settings = ",".join(f"{name}={value}" for name, value in row["parameters"].items())
        at = eigenring.Scheme(row["scheme"] + (":" + settings if settings else "")).at(row["valence"])
        assert row["subdominant"] == at.spectrum().subdominant
        assert row["c1"] == at.verify("c1").status and row["bounded"] == at.verify("bounded").status
    assert "3 and above" in rows[-2]["error"] and "out of range" in rows[-1]["error"]
    assert rows[-1]["c1"] is None and set(rows[-1]) == set(rows[0])
    verdicts = {row["valence"]: row["bounded"] for row in rows if row["scheme"] == "catmull-clark"}
    # valence 3 is of bounded curvature with a flat spot, 5 and 12 are not bounded
    assert verdicts[5] == verdicts[12] == "refuted"


def test_schemes_of_files_with_parameters(tmp_path):
    (tmp_path / "mine.toml").write_text(TEXT, encoding="utf-8")
    rows = eigenring.sweep([(tmp_path / "mine.toml", 5, {"b": b}) for b in (0.3, "3/8")] + [(TEXT, 5)])
    assert rows[1]["subdominant"] == rows[2]["subdominant"] != rows[0]["subdominant"]
    assert rows[2]["subdominant"] == pytest.approx(eigenring.Scheme("catmull-clark").at(5).spectrum().subdominant, abs=1e-14)


def test_own_study_and_progress():
    calls = []
    rows = eigenring.sweep(
        TASKS[:4], study=lambda at: {"points": len(at.matrix())}, progress=lambda *call: calls.append(call)
    )
    assert calls == [("tasks", done, 4) for done in range(1, 5)]
    assert all(row["points"] > 0 for row in rows)
    assert eigenring.sweep([]) == []

    def stop(what, done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        eigenring.sweep(TASKS, progress=stop)


@pytest.mark.parametrize(
    "task",
    ["catmull-clark", 5, ("catmull-clark",), ("catmull-clark", 5.5), ("catmull-clark", True), (7, 5),
     ("lambda", 5, float("nan")), ("lambda", 5, [0.5]), ("lambda", 5, 0.5, 0.5), ("nowhere.toml", 5)],
)  # fmt: skip
def test_what_is_no_task_is_refused(task):
    with pytest.raises(eigenring.Error) as caught:
        eigenring.sweep([task])
    assert caught.value.accepted


class Deadly:
    """The study of the package, but the first worker that meets valence 7 is lost; at 12 all are."""

    def __init__(self, folder):
        self.folder = folder

    def __call__(self, at):
        if at.valence == 12:
            os.kill(os.getpid(), signal.SIGKILL)
        if at.valence == 7:
            try:
                os.close(os.open(os.path.join(self.folder, "lost"), os.O_CREAT | os.O_EXCL))
            except FileExistsError:
                pass
            else:
                os.kill(os.getpid(), signal.SIGKILL)
        return {"lambda": at.spectrum().subdominant, "c1": at.verify("c1").status}


def test_a_cluster_gives_the_same_rows_though_workers_are_lost(tmp_path):
    distributed = pytest.importorskip("distributed", reason="dask.distributed is not installed: no cluster to test on")
    import dask

    tasks = [task for task in TASKS if task[1] != 12]
    settings = {
        "distributed.scheduler.allowed-failures": 1,
        "distributed.worker.memory.target": False,
        "distributed.nanny.environ.RAYON_NUM_THREADS": "1",
    }
    quiet = {"dashboard_address": None, "silence_logs": 50, "local_directory": tmp_path}
    with dask.config.set(settings), distributed.LocalCluster(2, threads_per_worker=1, **quiet) as cluster:
        with distributed.Client(cluster) as client:
            assert eigenring.sweep(tasks, client) == eigenring.sweep(tasks)
            before = set(client.run(os.getpid).values())
            rows = eigenring.sweep(tasks, client, study=Deadly(tmp_path))
            assert (tmp_path / "lost").exists()
            client.wait_for_workers(2, timeout=60)
            assert set(client.run(os.getpid).values()) != before
            # the marker is there: nobody is lost here
            assert rows == eigenring.sweep(tasks, study=Deadly(tmp_path))
            assert not [row for row in rows[:-2] if row["error"]]
            # a task that no worker survives is given up, and the others are not
            fatal, fine = eigenring.sweep([("catmull-clark", 12), ("catmull-clark", 6)], client, study=Deadly(tmp_path))
            assert "lost" in fatal["error"] and fine["c1"] == "proven"
