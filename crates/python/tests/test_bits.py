"""Numbers equal the command's JSON bit for bit: orders odd and even, tensions, features, knots, files, at spectra, vectors, proofs."""

import numpy as np
import pytest

import eigenring
from eigenring import Corner, Scheme

FILE = """
name = "own"
kind = "one-ring"
[parameters]
a = { default = "3/2", range = ["1", "2"] }
b = { default = "3/8", range = ["1/4", "1/2"] }
[rule]
n = "3.."
f1 = "1/4"
f2 = "1/4"
f3 = "1/4"
d1 = "b"
d2 = "3/4-b"
e1 = "1/16"
e2 = "1/16"
alpha = "a/n"
beta = "1/(4*n)"
"""
KNOTS = [1.0, 2.5, 0.75, 3.0, 0.5]

# scheme, what else the command is told, the corner in Python
PLACES = [
    ("tension:order=3,u0=0.3", ["-N", "3"], (3,)),
    ("tension:order=5,u0=7", ["-N", "11"], (11,)),
    ("tension:order=7,u0=0.5", ["-N", "4"], (4,)),
    ("tension:order=8,u0=3", ["-N", "9"], (9,)),
    ("tension:order=4,u0=1.5", ["--fan", "2"], (Corner.fan(2),)),
    ("stam:order=9", ["-N", "6"], (6,)),
    ("morin:u0=0.25", ["-N", "13"], (13,)),
    ("doo-sabin:uniform", ["-N", "16"], (16,)),
    ("lambda:lambda=0.35", ["-N", "17"], (17,)),
    ("lambda:fine,lambda=0.62", ["-N", "10"], (10,)),
    ("lambda:optimal", ["-N", "3"], (3,)),
    ("catmull-clark", ["-N", "41"], (41,)),
    ("catmull-clark", ["--fan", "1", "--corner"], (Corner.fan(1, corner=True),)),
    ("catmull-clark", ["--fan", "5"], (Corner.fan(5),)),
    ("catmull-clark", ["--dart", "-N", "3"], (Corner.dart(3),)),
    ("catmull-clark", ["--cusp", "-N", "6"], (Corner.cusp(6),)),
    ("nurss", ["--knots", ",".join(map(str, KNOTS))], (None, KNOTS)),
    ("hnuss:improved", ["--knots", ",".join(map(str, KNOTS[:3]))], (None, KNOTS[:3])),
    ("eigen-polyhedron", ["--knots", "1,2,1.5,0.8,1.2,1"], (None, [1, 2, 1.5, 0.8, 1.2, 1])),
    ("file,a=1.25", ["-N", "7"], (7,)),
    ("file,a=7/4,b=0.3", ["-N", "3"], (3,)),
]


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    path = tmp_path_factory.mktemp("files") / "own.toml"
    path.write_text(FILE, encoding="utf-8")
    return path


@pytest.mark.parametrize("spec, options, place", PLACES, ids=lambda given: str(given)[:40])
def test_numbers_are_those_of_the_command(command, path, spec, options, place):
    scheme = Scheme(spec) if not spec.startswith("file") else Scheme(path).set(**dict(pair.split("=") for pair in spec.split(",")[1:]))
    name = spec if not spec.startswith("file") else f"file:{path}{spec[4:]}"
    at = scheme.at(*place)
    printed = command("spectrum", "--scheme", name, *options, "--format", "json")
    assert at.spectrum().json() == printed
    assert at.spectrum().subdominant == printed["subdominant"] and at.spectrum().s == printed["s"]
    weights = printed["limit_stencils"]
    for which in ("position", "tangent_x", "tangent_y"):
        found = getattr(at.limit_stencils(), which)
        assert (None if found is None else found.tolist()) == weights[which]
    matrix = command("matrix", "--scheme", name, *options, "--format", "json")
    assert at.matrix().tolist() == matrix["rows"]
    vectors = command("eigenvectors", "--scheme", name, *options, "--format", "json")
    assert at.eigenvectors().json() == vectors
    right = at.eigenvectors().right
    assert right.real.tolist() == vectors["right"]
    assert np.iscomplexobj(right) == any(value["im"] for value in vectors["eigenvalues"])


@pytest.mark.parametrize("spec, options, place", [place for place in PLACES if "order" not in place[0]], ids=lambda given: str(given)[:40])
def test_proofs_are_those_of_the_command(command, path, tmp_path, spec, options, place):
    scheme = Scheme(spec) if not spec.startswith("file") else Scheme(path).set(**dict(pair.split("=") for pair in spec.split(",")[1:]))
    name = spec if not spec.startswith("file") else f"file:{path}{spec[4:]}"
    printed = command("verify", "--scheme", name, *options, "--require", "bounded", "--format", "json")
    found = scheme.at(*place).verify("bounded")
    assert found.json() == printed
    assert found.holds == printed["holds"] and found.status == printed["status"]
    stored = found.to_json()
    again = eigenring.Certificate.from_json(stored, require="bounded")
    assert again.json() == printed and again.recheck() == "" and again.to_json() == stored and repr(again) == repr(found)
    command("verify", "--scheme", name, *options, "-o", str(tmp_path / "stored.json"), "--format", "json")
    assert stored == (tmp_path / "stored.json").read_text(encoding="utf-8")
