"""Members of the certified ranges of lambda, one by one."""

from fractions import Fraction

from flint import arb, fmpq

from .exact import fraction
from .schemes import OneRing
from .spectrum import largest
from .statements import PROVEN, REFUTED, UNDECIDED, statements


# What a requirement asks for.
C1 = ("row_sums", "dominant", "subdominant", "regular", "injective")
REQUIRED = {"c1": C1, "bounded": (*C1, "bounded_curvature"), "strict": (*C1, "bounded_curvature", "strict")}


def table(path):
    """Rows of a CSV file of numbers by their valence, exactly as doubles."""
    with path.open() as file:
        next(file)
        rows = (line.strip().split(",") for line in file)
        return {int(row[0]): [fraction(float(x)) for x in row[1:] if x] for row in rows}


def spline(knots, coefficients, x):
    """The cubic spline at x in exact arithmetic (de Boor)."""
    span = max(i for i in range(3, len(coefficients)) if knots[i] <= x and knots[i] < knots[i + 1])
    d = [coefficients[span - 3 + j] for j in range(4)]
    for r in range(1, 4):
        for j in range(3, r - 1, -1):
            low, high = knots[span - 3 + j], knots[span + 1 + j - r]
            a = (x - low) / (high - low)
            d[j] = (1 - a) * d[j - 1] + a * d[j]
    return d[3]


def relaxation(valence, lam):
    """s by its rule: the largest of the terms, plus 1e-3 up to lambda_l, falling to 0 over 1e-2."""
    c1, c2 = (arb.cos_pi_fmpq(fmpq(2 * k, valence)) for k in (1, 2))
    at_one = [(arb(1) / 8).sqrt()] + ([c2 / c1, (1 + c2) / (1 + 2 * c1 - c2)] if valence >= 5 else [])
    least = largest(at_one)
    x = arb(lam)
    if x > least + arb(fmpq(1, 100)):
        return fmpq(1)
    terms = [arb(1), 1 / (8 * x * x)] + ([at_one[1] / x, at_one[2] / x] if valence >= 5 else [])
    falling = arb(fmpq(1, 1000)) * (1 - (x - least) * 100)
    return largest(terms) + (arb(fmpq(1, 1000)) if x < least else falling)


def check_ranges(path, results, samples):
    """Members of the certified ranges one by one: differences, and how many were looked at.

    Every interval of ranges.csv with a decided status is met at points that divide it evenly.
    """
    knots = table(results / "lambda" / "knots.csv")
    of = [table(results / "lambda" / name) for name in ("table5_f2_coefficients.csv", "table6_f3_coefficients.csv")]
    differences, count, known = [], 0, {}
    with path.open() as file:
        next(file)
        for line in file:
            valence, name, require, low, high, status = line.strip().split(",")[:6]
            valence, low, high = int(valence), fraction(float(low)), fraction(float(high))
            if status == UNDECIDED:
                continue
            for j in range(1, samples + 1):
                lam = low + (high - low) * fmpq(j, samples + 1)
                if (valence, lam) not in known:
                    f2, f3 = (spline(knots[valence], t[valence], lam) for t in of)
                    member = OneRing.lambda_member(valence, lam, relaxation(valence, lam), f2, f3)
                    known[valence, lam] = statements(member)
                found = [known[valence, lam][statement].status for statement in REQUIRED[require]]
                verdict = REFUTED if REFUTED in found else UNDECIDED if UNDECIDED in found else PROVEN
                count += 1
                if verdict != status:
                    at = f"N = {valence}, {name}, lambda = {float(Fraction(int(lam.p), int(lam.q)))}"
                    differences.append(f"ranges.csv: {at}: {require} is {status} there, {verdict} here")
    return differences, count
