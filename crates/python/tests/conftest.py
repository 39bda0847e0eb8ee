"""The command beside the package: its JSON is the oracle of all numbers."""

import json
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def command():
    """Runs ``eigenring ARGUMENTS --format json``; EIGENRING names the program."""
    built = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "eigenring"
    program = os.environ.get("EIGENRING", str(built))
    if not os.access(program, os.X_OK):
        pytest.skip("the command is not built: cargo build --release")

    def run(*arguments):
        found = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=300)
        assert found.returncode in (0, 1), found.stderr
        return json.loads(found.stdout)

    return run
