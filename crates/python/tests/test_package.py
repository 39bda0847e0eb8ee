"""How the package is built: with the settings of the workspace, so that nothing is compiled twice and runs as the command does."""

import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


def test_the_profile_is_that_of_the_workspace():
    tomllib = pytest.importorskip("tomllib", reason="before Python 3.11 nothing reads TOML")
    read = lambda path: tomllib.loads((ROOT / path).read_text(encoding="utf-8"))
    ours, theirs = (read(path)["profile"]["release"] for path in ("crates/python/Cargo.toml", "Cargo.toml"))
    used = {package["name"] for package in read("crates/python/Cargo.lock")["package"]}
    packages = {name: settings for name, settings in theirs.pop("package").items() if name in used}
    assert ours.pop("package") == packages
    assert ours == theirs


def test_dependencies_have_the_versions_of_the_workspace():
    tomllib = pytest.importorskip("tomllib", reason="before Python 3.11 nothing reads TOML")
    locked = lambda path: tomllib.loads((ROOT / path).read_text(encoding="utf-8"))["package"]
    workspace = {(package["name"], package["version"]) for package in locked("Cargo.lock")}
    names = {name for name, _ in workspace}
    ours = {(package["name"], package["version"]) for package in locked("crates/python/Cargo.lock")}
    assert not {package for package in ours if package[0] in names} - workspace
