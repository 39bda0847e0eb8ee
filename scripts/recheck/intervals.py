"""Certificates of schemes with knot intervals: NURSS, eigen-polyhedra and HNUSS around one vertex, HNUSS for all."""

from flint import arb, fmpq

from . import BadInput
from .exact import fraction
from .lemma3 import CELLS, lemma
from .ngon import NGon, for_all_valences
from .polyhedron import Rules, moduli, sums
from .statements import PROVEN, UNDECIDED, Found

NUMERICAL = "numerical"
HNUSS = {"hnuss": True, "hnuss:printed": True, "hnuss:simple": False}
# What is computed there in doubles agrees with what is computed here to so much.
CLOSE = 1e-9
# Lemma 1's bound is attained by equal intervals, where no ball tells mu from it.
SLACK = 2.0**-40


class NoScheme(Exception):
    """Intervals for which there is no scheme, and hence nothing to be said."""


def judged(holds, yes=PROVEN):
    return yes if holds else UNDECIDED


def hnuss_for_all(coplanar, points=None):
    """Every valence and all positive intervals at once."""
    identities = for_all_valences()
    regular, injective, coefficients = lemma(points)
    found = {
        "row_sums": Found(judged(identities)),
        "subdominant": Found(judged(identities), 0.5),
        "polygon": Found(judged(identities)),
        "regular": Found(judged(regular)),
        "injective": Found(judged(injective)),
        "bounded_curvature": Found(judged(coplanar, NUMERICAL)),
    }
    return found, {"regular": least_of(coefficients)}, coefficients


def least_of(coefficients):
    """By how much the Jacobian stays above zero in its best part, on the worst of the patches."""
    return min(max(min(each) for each in lists) for lists in coefficients.values())


def hnuss(ngon, coplanar, points=None):
    """One set of intervals. The first level of the rules that make coplanar corners needs the eigen-polyhedron."""
    if coplanar:
        found = Rules(ngon.d).eigen_polyhedron()
        if found is None or not found[1] > -CLOSE:
            raise NoScheme("the eigen-polyhedron does not exist, and with it the first level")
    positive = all(d > 0 for d in ngon.d)
    gap = arb(ngon.gap())
    # twice: by the bounds of n alpha, and by matrices that are positive definite
    first = positive and ngon.gap() > 0 and ngon.is_strict()
    first = first and ngon.lies_within(gap * (1 - SLACK), 1 - gap * (1 - SLACK))
    polygon = ngon.polygon_is_halved()
    regular, injective, coefficients = lemma(points)
    applies = positive and polygon and ngon.corners_lie_in_cones()
    fourth = ngon.fourth()
    bounded = positive and (ngon.n < 5 or fourth < 0.25 - CLOSE)
    found = {
        "row_sums": Found(judged(ngon.rows_sum_to_one())),
        "subdominant": Found(judged(first), 0.5),
        "polygon": Found(judged(polygon)),
        "regular": Found(judged(regular and applies)),
        "injective": Found(judged(injective and applies)),
        "bounded_curvature_matrix": Found(judged(bounded, NUMERICAL), fourth),
        "bounded_curvature": Found(judged(bounded or (coplanar and positive), NUMERICAL)),
    }
    margins = {"bounded_curvature_matrix": 0.25 - fourth}
    if positive:
        margins["subdominant"] = ngon.gap()
    if applies:
        margins["regular"] = least_of(coefficients)
    return found, margins, coefficients


def around_a_vertex(rules, scheme):
    """NURSS and eigen-polyhedra with the intervals that they have after a level."""
    out, margins = {}, {}
    if scheme == "nurss":
        rows = rules.nurss()
    else:
        found = rules.eigen_polyhedron()
        if found is None or not found[1] > -CLOSE:
            raise NoScheme("the eigen-polyhedron does not exist")
        rows, margin = found
        out["domain"] = Found(judged(rules.fits(rows), NUMERICAL))
        margins["domain"] = float(margin.mid())
    out["row_sums"] = Found(judged(sums(rows) < CLOSE, NUMERICAL))
    values = moduli(rules.matrix(rows))
    second, third, fourth = (float(values[i][0].mid()) for i in (1, 2, 3))
    double = abs(second - third) < CLOSE and values[1][1]
    out["subdominant"] = Found(judged(double and fourth < third, NUMERICAL), (third, second))
    margins["subdominant"] = third - fourth
    out["regular"] = out["injective"] = Found(UNDECIDED)
    return out, margins, {}


def derived(document):
    """The statements of a certificate with their statuses, margins and coefficients; None if the scheme is unknown."""
    scheme, knots = document["scheme"], document["knots"]
    if scheme not in HNUSS and scheme not in ("nurss", "eigen-polyhedron"):
        return None
    if knots is None:
        if scheme not in HNUSS:
            raise BadInput(f"{scheme} for all intervals: accepted is hnuss")
        return hnuss_for_all(HNUSS[scheme])
    d = [fraction(x) for x in knots["intervals"]]
    if not 3 <= len(d) <= 200 or any(x < 0 for x in d):
        raise BadInput(f"{len(d)} intervals: accepted are 3 to 200 that are not negative")
    for i in range(len(d)):
        if d[i] + d[(i + 2) % len(d)] == 0:
            raise NoScheme(f"spokes {i} and {(i + 2) % len(d)} have zero intervals, and the rules divide by their sum")
    if scheme in HNUSS:
        return hnuss(NGon(d), HNUSS[scheme])
    return around_a_vertex(Rules(d), scheme)


def agrees(status, stored, own):
    """Whether a stored margin is what it must be: a lower bound of the own one if proven, else the same in doubles."""
    if isinstance(own, fmpq):
        exact = fraction(stored)
        return exact <= own and own - exact <= own * fmpq(1, 2**50)
    return abs(stored - own) <= CLOSE * max(1.0, abs(own)) and status != PROVEN


def check(document):
    """Differences between a certificate and what is derived here, and how many statements were compared."""
    try:
        found = derived(document)
    except NoScheme as none:
        return [str(none)], 0, ""
    if found is None:
        return [], 0, "a scheme with knot intervals that is not known here"
    statements, margins, coefficients = found
    differences = []
    names = [claim["name"] for claim in document["checks"]]
    if sorted(names) != sorted(statements):
        differences.append(f"statements {', '.join(names)} there, {', '.join(statements)} here")
    for claim in document["checks"]:
        name, status = claim["name"], claim["status"]
        if name not in statements:
            continue
        own = statements[name]
        if status != own.status:
            differences.append(f"{name}: {status} there, {own.status} here")
            continue
        stored, margin = claim.get("margin"), margins.get(name)
        # of sums of rounded numbers the distance from 1 is the rounding there
        if name != "row_sums" and (stored is None) != (margin is None):
            differences.append(f"{name}: the margin is {stored} there, {margin} here")
        elif name != "row_sums" and stored is not None and not agrees(status, stored, margin):
            differences.append(f"{name}: the margin is {stored} there, {margin} here")
        if own.value is not None:
            low, high = claim.get("enclosure") or (None, None)
            least, most = own.value if isinstance(own.value, tuple) else (own.value, own.value)
            if low is None or abs(low - least) > CLOSE or abs(high - most) > CLOSE:
                differences.append(f"{name}: {low} to {high} there, {least} to {most} here")
    stored = {tuple(patch["cell"]): [[fraction(c) for c in each] for each in patch["jacobians"]] for patch in document["bernstein"]}
    if stored != coefficients or [tuple(patch["cell"]) for patch in document["bernstein"]] != list(CELLS)[: len(coefficients)]:
        differences.append("regular: other Bernstein coefficients")
    return differences, len(names), ""
