"""Scripts: each explains itself, and the comparison with numpy and scipy agrees with them."""

import pathlib
import subprocess
import sys

import pytest

SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "scripts"
NAMES = sorted(str(path.relative_to(SCRIPTS)) for path in [*SCRIPTS.glob("*.py"), *SCRIPTS.glob("peers/*.py"), SCRIPTS / "site/pages.py", SCRIPTS / "site.sh"])


def run(name, *arguments):
    program = ["bash"] if name.endswith(".sh") else [sys.executable]
    return subprocess.run([*program, SCRIPTS / name, *arguments], capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("name", [name for name in NAMES if not name.endswith("/peers.py")])
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
