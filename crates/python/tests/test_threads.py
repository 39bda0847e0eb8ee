"""Threads, callbacks within callbacks, forks, interrupts and pickles."""

import multiprocessing
import pickle
import signal
import sys
import threading
import time

import numpy as np
import pytest

import eigenring
from eigenring import Corner, Mesh, Scheme

CUBE = Mesh(
    [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]],
    creases={(0, 1): 1.5, (1, 3): float("inf")},
    corners={7: 0.1},
)
RULE = dict(f1="1/4", f2="1/4", f3="1/4", d1="b", d2="3/4-b", e1="1/16", e2="1/16", alpha="3/(2*n)", beta="1/(4*n)")
OWN = Scheme.from_stencils(RULE, parameters={"b": {"default": "3/8", "range": ["1/4", "1/2"]}})


def distance(at):
    return abs(at.spectrum().subdominant - 0.57)


def test_callbacks_may_ask_for_further_work():
    """On few threads all of them wait in callbacks for what these ask for."""
    count = [0]

    def objective(at):
        count[0] += 1
        if count[0] <= 12:
            eigenring.tune(OWN, 5, "ratio", descents=1)
            CUBE.limit_mesh("catmull-clark", 8)
        return distance(at)

    expected = eigenring.tune(OWN, 5, distance, descents=2).json()
    assert eigenring.tune(OWN, 5, objective, descents=2).json() == expected
    told = []
    eigenring.tune(OWN, [5, 6], "E", descents=1, progress=lambda *call: told.append(CUBE.limit_mesh("catmull-clark", 2)))
    assert told


def test_threads_give_the_same_results():
    def work():
        yield CUBE.limit_mesh("catmull-clark", 16).vertices.tobytes()
        yield Scheme("tension:order=8,u0=2").at(7).spectrum().eigenvalues.tobytes()
        yield eigenring.tune(OWN, 5, distance, descents=1).text
        yield Scheme("doo-sabin").at(5).characteristic_map().sample(9).points.tobytes()

    expected, found = list(work()), []
    threads = [threading.Thread(target=lambda: found.append(list(work()))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 4


@pytest.mark.skipif(not hasattr(signal, "SIGKILL") or sys.platform == "darwin", reason="processes are not forked here")
def test_a_forked_process_has_threads_of_its_own():
    expected = CUBE.limit_mesh("catmull-clark", 8).vertices.tobytes()
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    process = context.Process(target=lambda: queue.put(CUBE.limit_mesh("catmull-clark", 8).vertices.tobytes()))
    process.start()
    try:
        assert queue.get(timeout=30) == expected
    finally:
        process.kill()
        process.join()


@pytest.mark.parametrize(
    "work",
    [
        lambda: Scheme("tension:order=12,u0=2").at(200).spectrum(),
        lambda: Scheme("catmull-clark").at(400).eigenvectors(),
        lambda: Scheme("catmull-clark").at(1000).characteristic_map().sample(120),
        lambda: Scheme.from_matrix(np.random.default_rng(1).random((1200, 1200))).at(),
        lambda: CUBE.solve("catmull-clark", "poisson", bc="closed", levels=7),
        lambda: eigenring.sweep([("lambda", 20, 0.5 + 0.001 * step) for step in range(100)]),
    ],
)
def test_long_work_stops_at_an_interrupt(work):
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.2, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
            # done before the interrupt: what stops is this
            time.sleep(10)
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)
    # what runs on keeps nobody waiting
    assert CUBE.subdivide("catmull-clark").faces.shape == (24, 4)


def again(given):
    return pickle.loads(pickle.dumps(given))


def test_pickles_give_the_same_numbers(tmp_path):
    text = tmp_path / "scheme.toml"
    eigenring.Mesh.write(CUBE, tmp_path / "cube.obj")
    text.write_text(eigenring.tune(OWN, 5, "ratio", descents=1).text)
    matrix = Scheme.from_matrix(Scheme("catmull-clark").at(6).matrix())
    for scheme, places in (
        (Scheme("catmull-clark"), [(5,), (Corner.fan(3),), (Corner.fan(2, corner=True),), (Corner.dart(5),), (Corner.cusp(4),)]),
        (Scheme("catmull-clark"), [(None, [1.0, 2.0, 1.0, 3.0])]),
        (Scheme("lambda:fine,lambda=0.45"), [(6,)]),
        (Scheme("nurss"), [(None, [1.0, 2.0, 1.0, 3.0, 0.1])]),
        (OWN.set(b="1/3"), [(7,)]),
        (Scheme(text), [(5,)]),
        (matrix, [()]),
    ):
        for place in places:
            expected = scheme.at(*place).spectrum().json()
            assert again(scheme).at(*place).spectrum().json() == expected
            assert again(scheme.at(*place)).spectrum().json() == expected
    fine = CUBE.subdivide("catmull-clark", 3).vertices.tobytes()
    assert again(CUBE).subdivide("catmull-clark", 3).vertices.tobytes() == fine
    certificate = OWN.at(5).verify("bounded")
    assert again(certificate).json() == certificate.json() and again(certificate).recheck() == ""
    points = CUBE.limit("catmull-clark", [0, 1], [0.0, 0.3], [0.0, 0.2])
    for name in ("points", "first", "second", "normals", "gauss", "mean", "principal"):
        assert getattr(again(points), name).tobytes() == getattr(points, name).tobytes()
    assert again(points).kinds == points.kinds
    sample = Scheme("catmull-clark").at(5).characteristic_map().sample(3)
    assert again(sample).jacobians.tobytes() == sample.jacobians.tobytes()


def test_an_objective_s_scheme_is_no_pickle():
    with pytest.raises(eigenring.Error):
        eigenring.tune(OWN, 5, lambda at: len(pickle.dumps(at)), descents=1)
