"""Whatever is given where something else is expected: refused in a line that says what is accepted, or taken."""

import collections

import numpy as np
import pytest

import eigenring
from eigenring import Corner, Error, Mesh, Scheme


class Rude:
    """Raises whatever is asked of it."""

    def __index__(self):
        raise KeyError

    __iter__ = __float__ = __len__ = __repr__ = __fspath__ = __index__


ODD = np.frombuffer(bytes(8 * 12 + 1), dtype=np.uint8)[1:].view(np.float64).reshape(4, 3)
WRONG = [
    None, True, -1, 0, 2, 3, 5, 2**31, 2**32, 2**63, 10**30, -(10**30), 0.0, 1.5, 3.0, float("nan"), float("inf"), -1e308, 1j,
    "", "\0", "\ud800", "nonsense", "lambda:lambda=nan", "a\nb", "x" * 10**5, b"", b"abc", [], [1], [float("nan")], [[]], [[1.0]],
    ["1"], [None], [[1], [1, 2]], (), (1, 2), {}, {"a": 1}, {(0, 1): -1.0}, {0: float("nan")}, {"\ud800": 1}, set(), object(), Rude(), len, int,
    np.float64("nan"), np.int64(-3), np.uint64(2**63), np.bool_(True), np.array(5), np.array(5.0), np.array([]),
    np.zeros((0, 3)), np.zeros((3, 0)), np.zeros((5, 0), dtype=int), np.zeros((4, 3)), np.zeros((4, 3), dtype=np.float32),
    np.zeros((3, 4)).T, np.zeros((8, 3))[::2], np.full((4, 3), np.nan), np.zeros((4, 3), dtype=">f8"), np.zeros((4, 3), dtype=object),
    np.zeros((4, 3), dtype=complex), np.array(["a"]), np.ma.masked_array(np.zeros((4, 3)), mask=True), ODD,
    np.broadcast_to(np.zeros(3), (4, 3)), np.zeros(2, dtype=[("a", "f8")]), np.array(["2020-01-01"], dtype="M8[D]"),
    np.array([[0, 1, 2, -1]]), np.array([[0, 1, 2, 2**40]]), np.arange(4), range(3), memoryview(b"abc"), Corner.fan(3),
]  # fmt: skip

SQUARE = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
RULE = dict(f1="1/4", f2="1/4", f3="1/4", d1="b", d2="3/4-b", e1="1/16", e2="1/16", alpha="3/(2*n)", beta="1/(4*n)")
OWN = Scheme.from_stencils(RULE, parameters={"b": {"default": "3/8", "range": ["1/4", "1/2"]}})
MESH = Mesh(*SQUARE)
AT = Scheme("catmull-clark").at(5)
CHI, SECOND, CERTIFICATE = AT.characteristic_map(), AT.second_order_maps(), AT.verify()
[FIGURE] = eigenring.figure("natural-configurations", valences=[5])


def tune(**given):
    return eigenring.tune(OWN, **{**dict(valence=5, minimise="ratio", descents=1), **given})


def solve(**given):
    return MESH.solve("catmull-clark", **{**dict(levels=1), **given})


def render(**given):
    return MESH.render("catmull-clark", **{**dict(size=32), **given})


# what takes one argument of each kind; those of which many values are meant, and cost time, stand without
CALLS = {
    "Scheme": lambda x: Scheme(x),
    "at": lambda x: Scheme("catmull-clark").at(x),
    "at knots": lambda x: Scheme("catmull-clark").at(None, x),
    "at next": lambda x: Scheme("catmull-clark").at(None, [1, 1, 1, 1], next=x),
    "at cs": lambda x: Scheme("catmull-clark").at(5, cs=x),
    "from_matrix": lambda x: Scheme.from_matrix(x).at().spectrum().eigenvalues,
    "at of a matrix": lambda x: Scheme.from_matrix(np.eye(5)).at(x),
    "from_stencils": lambda x: Scheme.from_stencils(x),
    "name": lambda x: Scheme.from_stencils(RULE, name=x),
    "kind": lambda x: Scheme.from_stencils(RULE, kind=x),
    "valences of a rule": lambda x: Scheme.from_stencils(RULE, valences=x),
    "parameters": lambda x: Scheme.from_stencils(RULE, parameters=x),
    "weight": lambda x: Scheme.from_stencils({**RULE, "f1": x}),
    "set": lambda x: OWN.set(b=x),
    "closed": lambda x: Scheme("catmull-clark").at(Corner.closed(x)),
    "fan": lambda x: Scheme("catmull-clark").at(Corner.fan(x)),
    "dart": lambda x: Scheme("catmull-clark").at(Corner.dart(x)),
    "cusp": lambda x: Scheme("catmull-clark").at(Corner.cusp(x)),
    "fixed": lambda x: Corner.fan(3, x),
    **{
        name: lambda x, name=name: getattr(AT, name)(x)
        for name in ("matrix", "points", "blocks", "spectrum", "eigenvectors", "limit_stencils", "natural_configuration")
    },
    **{f"level of {name}": lambda x, name=name: getattr(AT, name)(level=x) for name in ("matrix", "blocks", "spectrum")},
    "verify": lambda x: AT.verify(x),
    "exact": lambda x: AT.verify(exact=x),
    "progress": lambda x: AT.verify(progress=x) if not callable(x) else None,
    "characteristic map": lambda x: CHI.sample(x),
    "second-order maps": lambda x: SECOND.sample(x),
    "from_json": lambda x: eigenring.Certificate.from_json(x),
    "from_json require": lambda x: eigenring.Certificate.from_json(CERTIFICATE.to_json(), require=x),
    "Mesh": lambda x: Mesh(x),
    "vertices": lambda x: Mesh(x, SQUARE[1]),
    "faces": lambda x: Mesh(SQUARE[0], x),
    "a face": lambda x: Mesh(SQUARE[0], [x]),
    "an index": lambda x: Mesh(SQUARE[0], [[0, 1, 2, x]]),
    "creases": lambda x: Mesh(*SQUARE, creases=x),
    "crease": lambda x: Mesh(*SQUARE, creases={(0, 1): x}),
    "corners": lambda x: Mesh(*SQUARE, corners=x),
    "corner": lambda x: Mesh(*SQUARE, corners={0: x}),
    "boundary": lambda x: Mesh(*SQUARE, boundary=x),
    "read": lambda x: Mesh.read(x),
    "write": lambda x: MESH.write(x),
    "subdivide": lambda x: MESH.subdivide(x),
    "levels": lambda x: MESH.subdivide("catmull-clark", x),
    "limit face": lambda x: MESH.limit("catmull-clark", x, 0.5, 0.5),
    "limit u": lambda x: MESH.limit("catmull-clark", 0, x, 0.5),
    "limit v": lambda x: MESH.limit("catmull-clark", 0, 0.5, x),
    "limit sub": lambda x: MESH.limit("catmull-clark", 0, 0.5, 0.5, sub=x),
    "limit_mesh": lambda x: MESH.limit_mesh("catmull-clark", x),
    "per_face": lambda x: MESH.curvature("catmull-clark", per_face=x),
    "radii": lambda x: MESH.curvature("catmull-clark", per_face=2, radii=x),
    **{
        f"solve {name}": lambda x, name=name: solve(**{name: x})
        for name in "problem solution levels bc boundary dirichlet gauss depth tail solver sphere count".split()
    },
    **{
        f"render {name}": lambda x, name=name: render(**{name: x})
        for name in ("show", "view", "light", "stripes", "size", "up")
    },
    "figure": lambda x: eigenring.figure(x),
    "figure schemes": lambda x: eigenring.figure("characteristic-map", schemes=x, valences=[5]),
    "figure valences": lambda x: eigenring.figure("natural-configurations", schemes=["catmull-clark"], valences=x),
    "figure lambdas": lambda x: eigenring.figure("characteristic-map", lambdas=x) if x is not None else None,
    "png": lambda x: FIGURE.png(x),
    **{
        f"tune {name}": lambda x, name=name: tune(**{name: x})
        for name in "valence lambda_ subject_to fix margin seed descents name".split()
    },
    "minimise": lambda x: tune(minimise=x) if not callable(x) else None,
    "tune scheme": lambda x: eigenring.tune(x, 5, "ratio", descents=1),
    "tune lambda": lambda x: eigenring.tune("lambda", 5, lambda_=x) if x is not None else None,
    "what an objective returns": lambda x: tune(minimise=lambda at: x),
    "lambda_table": lambda x: eigenring.lambda_table(x),
    "splines": lambda x: eigenring.lambda_table(5, splines=x),
    "knots of tables": lambda x: eigenring.tables([4], knots=x),
    "sweep": lambda x: eigenring.sweep(x),
    "a task": lambda x: eigenring.sweep([x]),
    "scheme of a task": lambda x: eigenring.sweep([(x, 5)]),
    "valence of a task": lambda x: eigenring.sweep([("catmull-clark", x)]),
    "lambda of a task": lambda x: eigenring.sweep([("lambda", 5, x)]) if x is not None else None,
}


@pytest.mark.parametrize("name", CALLS)
def test_nothing_but_errors_in_a_line(name):
    outcomes = collections.Counter()
    for given in WRONG:
        try:
            CALLS[name](given)
            outcomes["taken"] += 1
        except Error as error:
            outcomes["refused"] += 1
            assert str(error) and "\n" not in str(error), str(error)
        except TypeError:
            # by Python itself: text or flags of another type, what is no list, arguments that do not go together
            outcomes["type"] += 1
        except KeyError:
            assert isinstance(given, Rude)
    assert outcomes["refused"] + outcomes["type"] > len(WRONG) / 3


def test_numbers_of_the_wrong_kind_are_named():
    """The name of the argument, what was given and what is accepted."""
    for call, words in (
        (lambda: AT.spectrum(-1), ("rings is -1", "whole numbers from 0")),
        (lambda: AT.spectrum(1.0), ("rings is 1.0", "whole numbers")),
        (lambda: Scheme("catmull-clark").at(1001), ("valence is 1001", "0 to 1000")),
        (lambda: MESH.subdivide("catmull-clark", "2"), ("levels is '2'", "whole numbers")),
        (lambda: FIGURE.png(float("nan")), ("dpi is NaN", "10 to 2400")),
        (lambda: tune(seed=-1), ("seed is -1", "whole numbers")),
        (lambda: tune(margin="much"), ("margin is 'much'", "0 to below 0.5")),
        (lambda: Mesh(*SQUARE, boundary=3), ("boundary is 3", "text")),
        (lambda: Mesh(np.zeros((2, 4, 3)), SQUARE[1]), ("vertices", "[2, 4, 3]", "(n, 3)")),
        (lambda: Mesh(ODD, SQUARE[1]), ("vertices", "not aligned")),
        (lambda: Mesh([[0, 0, np.nan]], [[0, 0, 0]]), ("the entry [0, 2] is NaN",)),
        (lambda: AT.verify(progress=3), ("progress is 3", "a function")),
        (lambda: eigenring.lambda_table(5, splines="coarse"), ("splines is 'coarse'", "paper, fine")),
    ):
        with pytest.raises(Error) as caught:
            call()
        assert all(word in str(caught.value) for word in words), str(caught.value)
        assert caught.value.accepted


def test_what_does_not_fit_into_memory_is_refused_before_it_is_begun():
    wide = Scheme("catmull-clark").at(1000)
    for call in (
        lambda: MESH.subdivide("catmull-clark", 25),
        lambda: MESH.subdivide("catmull-clark", 8).limit_mesh("catmull-clark", 10**4),
        lambda: wide.characteristic_map().sample(10**5),
        lambda: wide.second_order_maps().sample(10**5),
        lambda: wide.matrix(200),
        lambda: MESH.solve("catmull-clark", "poisson", levels=40),
    ):
        with pytest.raises(Error) as caught:
            call()
        assert caught.value.accepted
