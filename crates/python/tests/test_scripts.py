"""Scripts: each explains itself, and the comparison with numpy and scipy agrees with them."""

import os
import pathlib
import subprocess
import sys

import pytest

SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "scripts"
NAMES = sorted(str(path.relative_to(SCRIPTS)) for path in [*SCRIPTS.glob("*.py"), *SCRIPTS.glob("peers/*.py"), SCRIPTS / "site/pages.py", *SCRIPTS.glob("*.sh")])


def run(name, *arguments):
    program = ["bash"] if name.endswith(".sh") else [sys.executable]
    return subprocess.run([*program, SCRIPTS / name, *arguments], capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("name", [name for name in NAMES if not name.endswith(("/peers.py", "help.sh"))])
def test_scripts_explain_themselves(name):
    done = run(name, "--help")
    assert done.returncode == 0 and "usage:" in done.stdout and len(done.stdout) > 300, done.stderr
    assert run(name, "--unheard-of").returncode == 2


def test_numpy_and_scipy_agree():
    pytest.importorskip("scipy", reason="scipy is not installed: nothing to compare with")
    done = run("peers/numpy_scipy.py", "--repeat", "1", "--levels", "3")
    rows = [line for line in done.stdout.splitlines() if " s " in line]
    assert done.returncode == 0 and len(rows) == 6 and "above" not in done.stdout, done.stdout + done.stderr


def test_a_peer_that_is_not_there_is_named(tmp_path):
    pytest.importorskip("scipy", reason="scipy is not installed")
    (tmp_path / "sitecustomize.py").write_text("import sys; sys.modules['pygismo'] = None\n", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, SCRIPTS / "peers" / "gismo.py"],
        capture_output=True, text=True, timeout=60, env={"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"},
    )  # fmt: skip
    assert done.returncode == 0 and done.stdout.startswith("SKIPPED: pygismo is not installed")


def test_broken_links_and_anchors_are_found(tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "index.html").write_text('<h1 id="there">A</h1><a href="../index.html">up</a>', encoding="utf-8")
    page = '<p id="own"><a href="#own">1</a> <a href="other/#there">2</a> <a href="{}">3</a> <img src="{}">'
    for link, picture, broken in (
        ("other/index.html#there", "other", []),
        ("other/#nowhere", "other", ["other/#nowhere"]),
        ("#nowhere", "other", ["#nowhere"]),
        ("gone/index.html", "gone.png", ["gone/index.html", "gone.png"]),
    ):
        (tmp_path / "index.html").write_text(page.format(link, picture), encoding="utf-8")
        done = run("site/pages.py", "check", str(tmp_path))
        named = [line.split(": ")[1] for line in done.stdout.splitlines()[1:]]
        assert (done.returncode, named) == (1 if broken else 0, broken), done.stdout + done.stderr


def test_another_program_agrees_on_knot_intervals(tmp_path):
    pytest.importorskip("flint", reason="python-flint is not installed: no second checker")
    program = os.environ.get("EIGENRING")
    if not program:
        pytest.skip("EIGENRING names no command")
    cases = [("hnuss:simple", ["-N", "3.."]), ("hnuss", ["-N", "3.."])]
    cases += [
        (scheme, ["--knots", knots])
        for scheme, sets in {
            "hnuss": ["1,2,1.5", "1,2,1.5,.8", "1,2,1.5,.8,1.2", "2,2,1,1,2,2,1,1"],
            "hnuss:printed": ["1,1,1,1,1,1"],
            "hnuss:simple": ["1,1e6,2,1,7,0.3,1e-3", "0,1,1,2,1", "0,0,1,2,1,3", ",".join(["1", "3"] * 10)],
            "eigen-polyhedron": ["1,2,1.5,.8,1.2", "10,1,1,10,1,1", "3,1,2"],
            "nurss": ["1,2,1.5,.8,1.2", "1,1,1,1,1,1,1", "10,1,1,10,1,1"],
        }.items()
        for knots in sets
    ]
    for number, (scheme, arguments) in enumerate(cases):
        path = tmp_path / f"{number}.json"
        done = subprocess.run(
            [program, "verify", "--scheme", scheme, *arguments, "-o", str(path)], capture_output=True, text=True, timeout=60
        )
        assert path.is_file(), done.stderr
    done = run("recheck_certificates.py", str(tmp_path))
    assert done.returncode == 0 and f"{len(cases)} certificates agree" in done.stdout, done.stdout + done.stderr
