"""Planted faults in schemes with knot intervals, which must not be proven."""

from flint import arb, fmpq

from .exact import fraction
from .intervals import NUMERICAL, around_a_vertex, check, hnuss, hnuss_for_all
from .lemma3 import POINTS, lemma
from .ngon import NGon, alpha_times_n, beta
from .polyhedron import Rules
from .statements import PROVEN, REFUTED, UNDECIDED


def exact(*numbers):
    return [fraction(x) for x in numbers]


def certificate(scheme, knots, found, margins, coefficients):
    """A certificate of what was derived, as it is stored: margins rounded downward."""

    def number(x):
        if not isinstance(x, fmpq):
            return x
        value = float(x.p) / float(x.q)
        return value if fraction(value) <= x else value * (1 - 2.0**-52)

    def enclosure(value):
        return None if value is None else list(value) if isinstance(value, tuple) else [value, value]

    return {
        "scheme": scheme,
        "knots": knots and {"intervals": knots, "next": knots},
        "bernstein": [{"cell": list(cell), "jacobians": [[str(c) for c in each] for each in lists]} for cell, lists in coefficients.items()],
        "checks": [
            {"name": name, "status": one.status, "margin": number(margins.get(name)), "enclosure": enclosure(one.value)}
            for name, one in found.items()
        ],
    }


def faults():
    """What is looked at, what must be found, and what is."""
    d = exact(1, 2, "1.5", "0.8", "1.2")
    plain = NGon(d)

    def of(ngon, name, coplanar=False, points=None):
        return hnuss(ngon, coplanar, points)[0][name].status

    yield "sound intervals", PROVEN, of(plain, "subdominant")
    yield "sound intervals, regular", PROVEN, of(plain, "regular")
    yield "all intervals", PROVEN, hnuss_for_all(False)[0]["injective"].status
    # Lemma 1
    opposite = NGon(exact(0, 1, 1, 0, 1, 1))
    yield "two zero spokes opposite each other", UNDECIDED, of(opposite, "subdominant")
    large = alpha_times_n(d)
    large[2] = fmpq(21, 20)
    yield "an alpha beyond 1/n", UNDECIDED, of(NGon(d, alpha=large), "subdominant")
    # Lemma 2 and sums
    yield "modes 0 and +-2 in place of 0 and +-1", UNDECIDED, of(NGon(d, mode=2), "polygon")
    yield "and no regular map", UNDECIDED, of(NGon(d, mode=2), "regular")
    off = beta(d)
    off[0] += fmpq(1, 10**12)
    yield "a beta off by 1e-12", UNDECIDED, of(NGon(d, weights=off), "row_sums")
    # Lemma 3
    for (j, k), point in POINTS.items():
        if (j, k) != (0, 0):
            wrong = {**POINTS, (j, k): (point[0], point[1] + fmpq(1, 1000), point[2])}
            yield f"point ({j},{k}) off by 1e-3", False, lemma(wrong)[0]
    exchanged = {**POINTS, (2, 1): (POINTS[2, 1][0], POINTS[2, 1][2], POINTS[2, 1][1])}
    yield "Eq. 30 with v and w exchanged, as it is printed", False, lemma(exchanged)[0]
    # curvature
    yield "curvature of a coplanar octagon", NUMERICAL, of(NGon(exact(2, 2, 1, 1, 2, 2, 1, 1)), "bounded_curvature", True)
    yield "curvature without coplanar corners", UNDECIDED, of(NGon(exact(2, 2, 1, 1, 2, 2, 1, 1)), "bounded_curvature")
    # eigen-polyhedra
    inside = Rules(d)
    rows, margin = inside.eigen_polyhedron()
    yield "an eigen-polyhedron", True, inside.fits(rows) and margin > 0
    for name, index in (("edge", 1), ("face", inside.n + 1)):
        spoilt = [dict(row) for row in rows]
        first, second = sorted(spoilt[index])[:2]
        spoilt[index][first] += arb(2) ** -40
        spoilt[index][second] -= arb(2) ** -40
        yield f"a weight of an {name} point off by 1e-12", False, inside.fits(spoilt)
    for outside in ((10, 1, 10, 1, 1), (10, 1, 10, 1, 10, 1)):
        found = Rules(exact(*outside)).eigen_polyhedron()
        yield f"intervals {outside}, outside of the domain", False, found is not None and bool(found[1] > 0)
    yield "NURSS with unequal intervals", UNDECIDED, around_a_vertex(inside, "nurss")[0]["subdominant"].status
    yield "NURSS with equal ones", NUMERICAL, around_a_vertex(Rules(exact(1, 1, 1, 1, 1)), "nurss")[0]["subdominant"].status
    # certificates in which something is another
    numbers = [1.0, 2.0, 1.5, 0.75, 1.25]
    one = NGon(exact(*numbers))
    sound = certificate("hnuss:simple", numbers, *hnuss(one, False))
    poly = certificate("eigen-polyhedron", numbers, *around_a_vertex(Rules(exact(*numbers)), "eigen-polyhedron"))
    every = certificate("hnuss", None, *hnuss_for_all(True))
    for what, document in (("one", sound), ("eigen-polyhedron", poly), ("all", every)):
        yield f"a certificate of {what}", [], check(document)[0]

    def changed(document, name, **change):
        return {**document, "checks": [{**c, **change} if c["name"] == name else c for c in document["checks"]]}

    patches = [{**sound["bernstein"][0]}, *sound["bernstein"][1:]]
    patches[0]["jacobians"] = [[*each[:-1], "1/2"] for each in patches[0]["jacobians"]]
    margin = next(c["margin"] for c in sound["checks"] if c["name"] == "subdominant")
    spoilt = [
        ("a status", changed(sound, "bounded_curvature", status=PROVEN)),
        ("a refutation", changed(every, "regular", status=REFUTED)),
        ("a larger margin", changed(sound, "subdominant", margin=margin * (1 + 1e-12))),
        ("another third eigenvalue", changed(poly, "subdominant", margin=0.3)),
        ("another domain", changed(poly, "domain", margin=0.4)),
        ("a coefficient", {**sound, "bernstein": patches}),
        ("no coefficients", {**every, "bernstein": []}),
        ("fewer statements", {**sound, "checks": sound["checks"][1:]}),
        ("other intervals", {**sound, "knots": {"intervals": [1.0, 2.0, 1.5, 0.75, 1.5], "next": numbers}}),
        ("no eigen-polyhedron", {**every, "knots": {"intervals": [10.0, 1.0, 10.0, 1.0, 1.0], "next": numbers}}),
    ]
    for what, document in spoilt:
        yield f"a certificate with {what} is refused", True, bool(check(document)[0])


def self_test():
    """True if all are as they must be."""
    good = True
    for what, expected, found in faults():
        good &= found == expected
        print(f"{'ok ' if found == expected else 'BAD'}  knot intervals, {what}: {found}, {expected} expected")
    return good
