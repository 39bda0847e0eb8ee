"""Tuning: the command on the same file, own objectives, and what callbacks may do."""

import json
import pathlib
import signal
import threading

import numpy as np
import pytest

import eigenring

ROOT = pathlib.Path(__file__).resolve().parents[3]

TEXT = (
    'name = "cc"\nkind = "one-ring"\n[parameters]\nb = { default = "3/8", range = ["1/4", "1/2"] }\n[rule]\nn = "3.."\n'
    'f1 = "1/4"\nf2 = "1/4"\nf3 = "1/4"\nd1 = "b"\nd2 = "3/4-b"\ne1 = "1/16"\ne2 = "1/16"\n'
    'alpha = "3/(2*n)"\nbeta = "1/(4*n)"\n'
)


def parameter(tuned):
    return tuned.json()["rows"][0]["parameters"]["b"]


def test_files_are_tuned_as_the_command_does(command, tmp_path):
    path = tmp_path / "cc.toml"
    path.write_text(TEXT)
    options = ["--minimise", "E", "--subject-to", "hull", "--descents", "2"]
    printed = command("tune", "--scheme", f"file:{path}", "-N", "5", *options, "--format", "json")
    tuned = eigenring.tune(path, 5, "E", subject_to=["hull"], descents=2)
    assert tuned.json() == printed
    assert eigenring.Scheme(tuned.text).at(5).verify().json()["checks"] == tuned.certificates[0].json()["checks"]


def test_an_own_objective_finds_what_the_built_in_one_finds():
    built_in = eigenring.tune(TEXT, 6, "lambda:0.57", descents=2)
    own = eigenring.tune(TEXT, 6, lambda at: abs(at.spectrum().subdominant - 0.57), descents=2)
    assert parameter(own) == pytest.approx(parameter(built_in), abs=1e-6)
    # neither is where the search began, and both are where the oracle, bisection on numpy's eigenvalues, is
    low, high = 0.25, 0.5
    for _ in range(40):
        middle = (low + high) / 2
        moduli = sorted(abs(np.linalg.eigvals(eigenring.Scheme(TEXT).set(b=middle).at(6).matrix(1))))
        low, high = (middle, high) if moduli[-2] > 0.57 else (low, middle)
    assert parameter(own) == pytest.approx(low, abs=1e-6) and abs(low - 0.375) > 0.01


def test_the_lambda_scheme_is_tuned_as_the_command_does(command):
    printed = command("tune", "-N", "5", "--lambda", "0.5", "--format", "json")
    assert eigenring.tune("lambda", 5, lambda_=0.5).json() == printed


def test_exceptions_of_objectives_reach_the_caller():
    def objective(at):
        raise KeyError("mine")

    with pytest.raises(KeyError):
        eigenring.tune(TEXT, 5, objective)
    with pytest.raises(TypeError):
        eigenring.tune(TEXT, 5, lambda at: "three")


def test_progress_is_told_and_may_stop():
    told = []
    eigenring.tune(TEXT, 5, "E", descents=3, progress=lambda *stage: told.append(stage))
    assert told and all(done <= total for _, done, total in told)

    def stop(what, done, total):
        raise InterruptedError

    with pytest.raises(InterruptedError):
        eigenring.tune(TEXT, [3, 5, 6, 7, 8], "E", descents=50, progress=stop)


def test_interrupts_end_long_work():
    # jobs of shells are started with interrupts ignored
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            eigenring.tune(TEXT, list(range(3, 40)), "E", descents=500)
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("splines, file", [("paper", "lambda.json"), ("fine", "lambda-fine.json")])
def test_stored_splines_are_those_of_the_file(splines, file):
    stored = json.loads((ROOT / "crates" / "scheme" / "data" / file).read_text(encoding="utf-8"))
    for entry in stored["valences"]:
        assert eigenring.lambda_table(entry["valence"], splines=splines) == entry


@pytest.mark.parametrize("splines, spec", [("paper", "lambda:"), ("fine", "lambda:fine,")])
def test_the_schemes_have_the_weights_of_the_splines(splines, spec):
    """The oracle is scipy's spline on the knots of the entry: triple ones with equally spaced single ones between."""
    interpolate = pytest.importorskip("scipy.interpolate", reason="scipy is not installed")
    for valence in (3, 5, 8, 20):
        entry = eigenring.lambda_table(valence, splines=splines)
        ends = [entry["knots"][name] for name in "abcde"]
        singles = entry["knots"].get("singles", [1] * 4)
        knots = [ends[0]]
        for low, high, count in zip(ends, ends[1:], singles):
            knots += [low] * 3 + np.linspace(low, high, count + 2)[1:-1].tolist()
        knots += [ends[-1]] * 4
        f2, f3 = (interpolate.BSpline(knots, entry[name], 3) for name in ("f2", "f3"))
        for value in (entry["lambda_optimal"], 0.3, 0.62):
            matrix = eigenring.Scheme(f"{spec}lambda={value}").at(valence).matrix(1)
            # the row of the first face point: its own face, the two edges beside it, the vertex
            f2s, f3s = (matrix[2][abs(matrix[2] - spline(value)) < 1e-11] for spline in (f2, f3))
            assert len(f2s) == 2 and len(f3s) >= 1, (valence, value, matrix[2])


def test_tables_are_stored_and_computed():
    pandas = pytest.importorskip("pandas")
    featured = eigenring.tables([4])["table1_featured_lambda"]
    # the oracle is what the command has stored
    stored = pandas.read_csv(ROOT / "results" / "lambda" / "table1_featured_lambda.csv")
    stored = stored[stored["valence"] == 4].reset_index(drop=True)
    assert featured["name"].tolist() == stored["name"].tolist()
    for column in ("lambda", "f2", "f3", "E"):
        assert featured[column].tolist() == pytest.approx(stored[column].tolist(), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize(
    "call",
    [
        lambda: eigenring.tune(TEXT, 5),
        lambda: eigenring.tune(TEXT, 5, "beauty"),
        lambda: eigenring.tune(TEXT, 5, 3),
        lambda: eigenring.tune(TEXT, 2, "E"),
        lambda: eigenring.tune(TEXT, 5, "E", margin=float("nan")),
        lambda: eigenring.tune(TEXT, 5, "E", descents=0),
        lambda: eigenring.tune(TEXT, 5, "E", subject_to=["beauty"]),
        lambda: eigenring.tune(TEXT, 5, "E", fix={"c": 1}),
        lambda: eigenring.tune("catmull-clark", 5, "E"),
        lambda: eigenring.tune("lambda", 5, lambda_=2.0),
        lambda: eigenring.tune("lambda", [5, 6], lambda_=0.5),
        lambda: eigenring.lambda_table(1000),
        lambda: eigenring.lambda_table(2),
        lambda: eigenring.tables([2]),
    ],
)
def test_bad_input_is_refused(call):
    with pytest.raises(eigenring.Error):
        call()
