#!/usr/bin/env python3
"""Checks stored certificates of one-ring schemes again, by other arithmetic and other algorithms.

Written from docs/certificates.md alone; shares no code with the program. Numbers are balls of Arb (python-flint)
at --precision bits, rational numbers and polynomials where something is an equality. The evidence inside a
certificate is not read: each status is derived here from the scheme and the valence, and compared.

Covered: Catmull-Clark, members of the lambda-scheme, and one-ring scheme files with numbers as weights; the
statements row_sums, hull, dominant, subdominant, regular, injective, bounded_curvature, non_degenerate, strict
and corner, with the numbers beside them. Not covered, and counted as such: gauss, other schemes, and
certificates of ranges, of which --samples members are checked one by one, which is no proof of a range.

Exit code 0: all that is covered agrees. 1: something differs, or is proven there and undecided here. 2: bad input.

  recheck_certificates.py                              results/certificates of the repository
  recheck_certificates.py N005.json my-folder          these
  recheck_certificates.py --self-test                  planted faults must not be proven
"""

import argparse
import json
import sys
import tomllib
from fractions import Fraction
from math import inf, isqrt, nextafter
from pathlib import Path

try:
    from flint import acb, acb_mat, arb, ctx, fmpq, fmpq_mpoly_ctx
except ImportError:
    sys.exit("error: python-flint is not installed: accepted is 'pip install python-flint'")

PROVEN, REFUTED, UNDECIDED = "proven", "refuted", "undecided"

# How often a patch is halved in both directions before its Jacobian counts as undecided; empirical.
DEPTH = 12


class BadInput(Exception):
    """What cannot be read, with what is accepted."""


# --------------------------------------------------------------------------- exact facts


def fraction(value):
    """A double, or a decimal or fraction as written, as an exact number."""
    f = Fraction(value)
    return fmpq(f.numerator, f.denominator)


def square_root(q):
    """The rational square root of a rational number, or None."""
    if q < 0:
        return None
    p, r = int(q.p), int(q.q)
    a, b = isqrt(p), isqrt(r)
    return fmpq(a, b) if a * a == p and b * b == r else None


def lambda_identities():
    """The closed forms of the lambda-scheme give what they are solved for, as identities of polynomials.

    mu = s lambda^2 in block 2 (N >= 5), in block 0 with alpha = 6 beta (any N), trace and determinant of all
    blocks, and rows that sum to 1. Quotients are pairs of polynomials; a numerator is zero or not.
    """
    ring = fmpq_mpoly_ctx.get(["l", "s", "f2", "f3", "c1", "c2", "g3", "h", "mu"], "degrevlex")
    l, s, f2, f3, c1, c2, g3, h, mu = ring.gens()
    one = l**0

    class Quotient:
        def __init__(self, over, under=one):
            self.over, self.under = over, under

        def __add__(self, o):
            return Quotient(self.over * o.under + o.over * self.under, self.under * o.under)

        def __sub__(self, o):
            return Quotient(self.over * o.under - o.over * self.under, self.under * o.under)

        def __mul__(self, o):
            return Quotient(self.over * o.over, self.under * o.under)

        def is_zero(self):
            return self.over == 0

    q = Quotient
    # block 2 with the solved g3 and h
    m = s * l * l
    solved = q(m * ((1 + c1) * m - (1 + c2) * l - (c1 - c2) * f3), (c1 - c2) * m - (1 + c1 - (1 + c2) * s * l) * f3)
    of_h = q(l - f3) * (q(l) - solved) * q(one, (1 + c1) * l)
    second = q(m * m) - q(m) * (solved + q(f3) + of_h * q(1 + c2)) + q(f3) * solved
    # any block in terms of g3 and h: with g2 = h/(2 f2)
    g2 = q(h, 2 * f2)
    d2, e1, e2 = q(g3 + h), q(h * fmpq(1, 2)), g2 * q(f3)
    trace = d2 + q(2 * c1) * e1 + q(f3) - q(g3 + f3 + h * (1 + c1))
    determinant = (d2 + q(2 * c1) * e1) * q(f3) - e2 * q(f2 * (2 + 2 * c1)) - q(f3 * g3)
    # block 0 on the differences from V, at mu
    phi = 6
    over = q(f3) * (q(2 * one) * e1 + d2) - q(4 * f2) * e2 + q(mu * mu) - (q(f3) + q(2 * one) * e1 + d2) * q(mu)
    under = d2 + q(2 * one) * e1 - q(2 * f2) - q(mu) + (q(f3) - q(2 * one) * e2 - q(mu)) * q(phi * one)
    beta = over * q(under.under, under.over)
    alpha = q(phi * one) * beta
    entry = [
        [d2 + q(2 * one) * e1 - alpha - q(mu), q(2 * one) * e2 - beta],
        [q(2 * f2) - alpha, q(f3) - beta - q(mu)],
    ]
    zeroth = entry[0][0] * entry[1][1] - entry[0][1] * entry[1][0]
    f1 = q(one - 2 * f2 - f3)
    g1 = q(one) - g2 - g2 - q(g3)
    d1 = g1 + q(2 * one) * g2 * f1
    row = d1 + d2 + e1 + e1 + e2 + e2 - q(one)
    return all(x.is_zero() for x in (second, trace, determinant, zeroth, row))


# --------------------------------------------------------------------------- schemes


class OneRing:
    """Weights of E, F and V as balls; all other points have the rule of bicubic B-splines.

    F' = f1 V + f2 (E_i + E_i+1) + f3 F_i,  E' = d1 V + d2 E_i + e1 (E_i-1 + E_i+1) + e2 (F_i-1 + F_i),
    V' = (1 - alpha - beta) V + alpha/N sum E_i + beta/N sum F_i.

    `square` says which eigenvalues are known to be lambda^2 exactly: (index, how many), by the closed forms.
    """

    NAMES = ("f1", "f2", "f3", "d1", "d2", "e1", "e2", "alpha", "beta")

    def __init__(self, valence, weights, exact_rows, square=()):
        self.valence, self.exact_rows, self.square = valence, exact_rows, dict(square)
        for name in self.NAMES:
            setattr(self, name, weights[name] if isinstance(weights[name], arb) else arb(weights[name]))

    def cosine(self, k):
        return arb.cos_pi_fmpq(fmpq(2 * k, self.valence))

    @staticmethod
    def of_numbers(valence, numbers):
        """From exact weights; sums are exact too."""
        n = numbers
        defects = [n["f1"] + 2 * n["f2"] + n["f3"] - 1, n["d1"] + n["d2"] + 2 * n["e1"] + 2 * n["e2"] - 1]
        return OneRing(valence, n, exact_rows=all(x == 0 for x in defects))

    @staticmethod
    def catmull_clark(valence):
        q = fmpq
        weights = dict(f1=q(1, 4), f2=q(1, 4), f3=q(1, 4), d1=q(3, 8), d2=q(3, 8), e1=q(1, 16), e2=q(1, 16))
        return OneRing.of_numbers(valence, {**weights, "alpha": q(3, 2 * valence), "beta": q(1, 4 * valence)})

    @staticmethod
    def lambda_member(valence, lam, s, f2, f3):
        """The closed forms (Ma, Wang and Ma 2023) at exact lambda, f2, f3 and a number or ball s; phi = 6."""
        lam, f2 = arb(lam), arb(f2)
        mu = arb(s) * lam * lam
        c1, c2 = (arb.cos_pi_fmpq(fmpq(2 * k, valence)) for k in (1, 2))
        if valence == 4:
            f3, g3 = mu, mu
        elif valence == 3:
            f3 = arb(f3)
            g3 = lam * mu / f3
        else:
            f3 = arb(f3)
            over = mu * ((1 + c1) * mu - (1 + c2) * lam - (c1 - c2) * f3)
            g3 = over / ((c1 - c2) * mu - (1 + c1 - (1 + c2) * arb(s) * lam) * f3)
        h = (lam - f3) * (lam - g3) / ((1 + c1) * lam)
        g2 = h / (2 * f2)
        f1, g1 = 1 - 2 * f2 - f3, 1 - 2 * g2 - g3
        d2, e1, e2 = g3 + h, h / 2, g2 * f3
        over = f3 * (2 * e1 + d2) - 4 * f2 * e2 + mu * mu - (f3 + 2 * e1 + d2) * mu
        beta = over / (d2 + 2 * e1 - 2 * f2 - mu + (f3 - 2 * e2 - mu) * 6)
        weights = dict(f1=f1, f2=f2, f3=f3, d1=g1 + 2 * g2 * f1, d2=d2, e1=e1, e2=e2, alpha=6 * beta, beta=beta)
        square = ()
        if s == 1 and IDENTITIES:
            # at N = 3 the other eigenvalue of block 1 is f3 g3/lambda = mu, at N = 4 block 2 is diagonal
            square = {3: ((0, 1), (1, 1)), 4: ((0, 1), (2, 2))}.get(valence, ((0, 1), (2, 1)))
        return OneRing(valence, weights, exact_rows=IDENTITIES, square=square)


# --------------------------------------------------------------------------- spectrum


class Root:
    """An enclosed eigenvalue of a block: real ball, or modulus of a complex pair."""

    def __init__(self, value, real=True, origin="ring 1"):
        self.value, self.real, self.origin = value, real, origin
        self.modulus = abs(value)


def quadratic(trace, determinant):
    """Both roots of x^2 - trace x + determinant, the larger one first; None if they are not told apart."""
    if trace.is_exact() and determinant.is_exact():
        t, d = trace.fmpq(), determinant.fmpq()
        root = square_root(t * t - 4 * d)
        if root is not None:
            return [Root(arb((t + root) / 2)), Root(arb((t - root) / 2))]
    discriminant = trace * trace - 4 * determinant
    if discriminant > 0:
        root = discriminant.sqrt()
        # the root of larger modulus without cancellation, the other from the product
        large = (trace + root) / 2 if trace >= 0 else (trace - root) / 2
        if not (trace >= 0 or trace < 0) or 0 in large:
            pair = [(trace + root) / 2, (trace - root) / 2]
        else:
            pair = [large, determinant / large]
        pair.sort(key=lambda x: -float(x.mid()))
        return [Root(x) for x in pair]
    if discriminant < 0:
        modulus = determinant.sqrt()
        return [Root(modulus, real=False), Root(modulus, real=False)]
    return None


# Ring 2 maps to itself alike in every block: (2,2) by 1/64, the others by a matrix with the eigenvalues 1/8, 1/16,
# 1/32; later rings read only earlier ones. `outer_rings` checks it.
OUTER = [fmpq(1, 8), fmpq(1, 16), fmpq(1, 32), fmpq(1, 64)]


def regular_row(a, b):
    """The bicubic rule of the fine point (a, b) as {(x, y): weight}."""

    def line(i):
        if i % 2 == 0:
            return {i // 2 - 1: fmpq(1, 8), i // 2: fmpq(6, 8), i // 2 + 1: fmpq(1, 8)}
        return {i // 2: fmpq(1, 2), i // 2 + 1: fmpq(1, 2)}

    return {(x, y): p * q for x, p in line(a).items() for y, q in line(b).items()}


def folded(a, b):
    """Point (a, b) of the lattice around sector 0 as (a', b', sector) with a' >= 1, b' >= 0."""
    if a >= 1 and b >= 0:
        return a, b, 0
    if a >= 0 and b < 0:
        return -b, a, -1
    if a <= 0 and b >= 1:
        return b, -a, 1
    return (0, 0, 0) if (a, b) == (0, 0) else None


def ring(r):
    return [(r, b) for b in range(r + 1)] + [(a, r) for a in range(1, r)]


def outer_rings():
    """That rings 2 and beyond have the eigenvalues `OUTER` and zeros, and which reads are needed."""
    for r in range(3, 6):
        for a, b in ring(r):
            reads = (folded(*at) for at in regular_row(a, b))
            if any(max(x, y) >= r for x, y, _ in reads):
                return False
    points, matrix = [(2, 0), (2, 1), (1, 2), (2, 2)], []
    for a, b in points:
        row = {}
        for at, weight in regular_row(a, b).items():
            x, y, sector = folded(*at)
            if max(x, y) >= 2:
                row[(x, y, sector)] = row.get((x, y, sector), fmpq(0)) + weight
        matrix.append(row)
    # in the unknowns (2,0), (2,1), (1,2) of the sector before, phases drop out: ring 2 without corners is a path
    expected = [
        {(2, 0, 0): fmpq(6, 64), (2, 1, 0): fmpq(1, 64), (1, 2, -1): fmpq(1, 64)},
        {(2, 0, 0): fmpq(1, 16), (2, 1, 0): fmpq(1, 16)},
        {(1, 2, 0): fmpq(1, 16), (2, 0, 1): fmpq(1, 16)},
    ]
    if matrix[:3] != expected or matrix[3].get((2, 2, 0)) != fmpq(1, 64):
        return False
    # its characteristic polynomial is that of diag(1/8, 1/16, 1/32)
    x = [[fmpq(6, 64), fmpq(1, 64), fmpq(1, 64)], [fmpq(1, 16), fmpq(1, 16), 0], [fmpq(1, 16), 0, fmpq(1, 16)]]
    trace = x[0][0] + x[1][1] + x[2][2]
    minors = x[0][0] * x[1][1] - x[0][1] * x[1][0] + x[0][0] * x[2][2] - x[0][2] * x[2][0] + x[1][1] * x[2][2]
    det = x[0][0] * x[1][1] * x[2][2] - x[0][1] * x[1][0] * x[2][2] - x[0][2] * x[2][0] * x[1][1]
    a, b, c = OUTER[:3]
    return trace == a + b + c and minors == a * b + a * c + b * c and det == a * b * c


class Spectrum:
    """Eigenvalues by Fourier index 0 .. N/2, the 1 of the constants left out."""

    def __init__(self, rules):
        self.rules, n = rules, rules.valence
        self.blocks, self.diagonal = {}, set()
        for k in range(n // 2 + 1):
            c = rules.cosine(k)
            if k == 0:
                # on E - V and F - V
                a = rules.d2 + 2 * rules.e1 - rules.alpha
                b = 2 * rules.e2 - rules.beta
                x, d = 2 * rules.f2 - rules.alpha, rules.f3 - rules.beta
                product = b * x
            else:
                a, d = rules.d2 + 2 * rules.e1 * c, rules.f3
                product = rules.e2 * rules.f2 * (2 + 2 * c)
            if product.is_zero():
                roots = sorted((Root(a), Root(d)), key=lambda root: -float(root.value.mid()))
                self.diagonal.add(k)
            else:
                roots = quadratic(a + d, a * d - product)
            self.blocks[k] = roots
        self.known = all(roots is not None for roots in self.blocks.values())
        self.outer = [Root(arb(x), origin="outer rings") for x in OUTER] if outer_rings() else None

    def others(self, taken):
        """(index, place, root) of all eigenvalues but the taken places; outer ones have the place None."""
        inner = [(k, i, root) for k, roots in self.blocks.items() for i, root in enumerate(roots)]
        return [x for x in inner if x[:2] not in taken] + [(None, None, root) for root in self.outer]


def largest(balls):
    top = None
    for ball in balls:
        top = ball if top is None else top.max(ball)
    return top


# --------------------------------------------------------------------------- characteristic map


def characteristic_net(rules, lam):
    """Values of the eigenvector of index 1 on rings 1 to 5, by (a, b) of sector 0; None if it is not isolated."""
    n = rules.valence
    w = acb(rules.cosine(1), arb.sin_pi_fmpq(fmpq(2, n)))
    # (f3 - lambda) F + f2 (1 + w) E = 0, on the axis of the sector F has the argument pi/n if E is real
    if 0 in (arb(lam) - rules.f3):
        return None
    v = {(1, 0): acb(1)}
    v[1, 1] = rules.f2 * (1 + w) / (lam - rules.f3)
    phases = {-1: w.conjugate(), 0: acb(1), 1: w}

    def read(at):
        x, y, sector = folded(*at)
        return None if (x, y) == (0, 0) else (v.get((x, y)), (x, y), phases[sector])

    # ring 2: (lambda - S_22) v_2 = S_21 v_1
    points = ring(2)
    size = len(points)
    matrix = [[acb(0) for _ in range(size)] for _ in range(size)]
    right = [[acb(0)] for _ in range(size)]
    for i, point in enumerate(points):
        matrix[i][i] += lam
        for at, weight in regular_row(*point).items():
            found = read(at)
            if found is None:
                continue
            value, where, phase = found
            if value is None:
                matrix[i][points.index(where)] -= phase * acb(weight)
            else:
                right[i][0] += phase * acb(weight) * value
    try:
        solution = acb_mat(matrix).solve(acb_mat(right))
    except ZeroDivisionError:
        return None
    for i, point in enumerate(points):
        v[point] = solution[i, 0]
    for r in range(3, 6):
        fresh = {}
        for point in ring(r):
            total = acb(0)
            for at, weight in regular_row(*point).items():
                found = read(at)
                if found is not None:
                    total += found[2] * acb(weight) * found[0]
            fresh[point] = total / lam
        v.update(fresh)

    def at(a, b):
        x, y, sector = folded(a, b)
        return acb(0) if (x, y) == (0, 0) else phases[sector] * v[x, y]

    return at


# the cubic B-spline's piece in Bernstein form
TO_BEZIER = [[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]]
BINOMIAL = {3: [1, 3, 3, 1], 2: [1, 2, 1], 5: [1, 5, 10, 10, 5, 1]}


def bezier(net, p, q):
    """Bezier points [i][j] of patch (p, q): i along the first direction."""
    grid = [[net(p + i, q + j) for j in range(-1, 3)] for i in range(-1, 3)]
    rows = [[sum((grid[k][j] * t for k, t in enumerate(line) if t), acb(0)) / 6 for j in range(4)] for line in TO_BEZIER]
    return [[sum((row[k] * t for k, t in enumerate(line) if t), acb(0)) / 6 for line in TO_BEZIER] for row in rows]


def jacobian(points):
    """Bernstein coefficients, of degree 5 in both directions, of det(P_u, P_v)."""
    du = [[3 * (points[i + 1][j] - points[i][j]) for j in range(4)] for i in range(3)]
    dv = [[3 * (points[i][j + 1] - points[i][j]) for j in range(3)] for i in range(4)]
    out = [[arb(0) for _ in range(6)] for _ in range(6)]
    for i in range(3):
        for j in range(4):
            x, y = du[i][j].real, du[i][j].imag
            scale = BINOMIAL[2][i] * BINOMIAL[3][j]
            for k in range(4):
                for l in range(3):
                    other = dv[k][l]
                    out[i + k][j + l] += (x * other.imag - y * other.real) * (scale * BINOMIAL[3][k] * BINOMIAL[2][l])
    return [[out[i][j] / (BINOMIAL[5][i] * BINOMIAL[5][j]) for j in range(6)] for i in range(6)]


def halves(row):
    """Both halves of a polynomial's Bernstein coefficients (de Casteljau)."""
    left, right = [], []
    while row:
        left.append(row[0])
        right.append(row[-1])
        row = [(a + b) / 2 for a, b in zip(row, row[1:])]
    return left, right[::-1]


def signs(coefficients, depth=0):
    """The signs that a polynomial has certainly, as a set; with 0 where it was not decided."""
    flat = [c for row in coefficients for c in row]
    if all(c > 0 for c in flat):
        return {1}
    if all(c < 0 for c in flat):
        return {-1}
    corners = [coefficients[i][j] for i in (0, -1) for j in (0, -1)]
    found = {1 for c in corners if c > 0} | {-1 for c in corners if c < 0}
    if found == {1, -1}:
        return found
    if depth == DEPTH:
        return found | {0}
    for half in zip(*(halves(row) for row in coefficients)):
        columns = [halves(list(column)) for column in zip(*half)]
        for side in (0, 1):
            part = [list(row) for row in zip(*(column[side] for column in columns))]
            found |= signs(part, depth + 1)
            if {1, -1} <= found:
                return found
    return found


def turn(curve, depth=0):
    """The change of argument along a cubic, enclosed; None if it may meet the origin."""
    middle = sum(curve, acb(0))
    toward = middle.conjugate()
    if all((toward * z).real > 0 for z in curve):
        return (curve[-1] / curve[0]).log().imag
    if depth == DEPTH:
        return None
    parts = [turn(part, depth + 1) for part in halves(list(curve))]
    return None if None in parts else parts[0] + parts[1]


# --------------------------------------------------------------------------- statements


class Found:
    """A derived status with the number beside it, if one is compared."""

    def __init__(self, status, value=None, remark=""):
        self.status, self.value, self.remark = status, value, remark


def statements(rules):
    """The status of each covered statement, derived."""
    n = rules.valence
    out = {"row_sums": Found(PROVEN if rules.exact_rows else REFUTED)}
    weights = [rules.f1, rules.f2, rules.f3, rules.d1, rules.d2, rules.e1, rules.e2]
    weights += [rules.alpha / n, rules.beta / n, 1 - rules.alpha - rules.beta, arb(fmpq(1, 64))]
    if any(w < 0 for w in weights):
        out["hull"] = Found(REFUTED)
    elif all(w >= 0 for w in weights):
        least = None
        for w in (w for w in weights if not w.is_zero()):
            least = w if least is None else least.min(w)
        out["hull"] = Found(PROVEN, least)
    else:
        out["hull"] = Found(UNDECIDED)
    rest = ["dominant", "subdominant", "regular", "injective", "bounded_curvature", "non_degenerate", "strict", "corner"]
    out.update({name: Found(UNDECIDED) for name in rest})
    spectrum = Spectrum(rules)
    if not rules.exact_rows or not spectrum.known or spectrum.outer is None:
        return out
    second = largest(root.modulus for _, _, root in spectrum.others(set()))
    if second < 1:
        out["dominant"] = Found(PROVEN, second)
    elif any(root.real and root.modulus >= 1 for _, _, root in spectrum.others(set())):
        out["dominant"] = Found(REFUTED)
        return out
    if out["dominant"].status != PROVEN:
        return out
    lam = subdominant(rules, spectrum, out)
    if lam is None:
        return out
    second_order(rules, spectrum, lam, out)
    net = characteristic_net(rules, lam)
    if net is not None:
        of_map(rules, net, out)
    return out


def subdominant(rules, spectrum, out):
    """Lambda, if it leads: real, positive, of index 1, simple there, and above all others."""
    n = rules.valence
    places = [(k, i) for k, roots in spectrum.blocks.items() for i, _ in enumerate(roots)]
    leader = max(places, key=lambda at: float(spectrum.blocks[at[0]][at[1]].modulus.mid()))
    root = spectrum.blocks[leader[0]][leader[1]]
    above = all(other.modulus < root.modulus for _, _, other in spectrum.others({leader}))
    if not above or not root.real:
        return None
    index = leader[0]
    if index == 1 and root.value > 0:
        out["subdominant"] = Found(PROVEN, root.value)
        return root.value
    # simple, leads, and does not make a planar map of winding one
    if (index == 1 and root.value < 0) or (2 <= index and 2 * index < n and root.value > 0):
        out["subdominant"] = Found(REFUTED)
    return None


def second_order(rules, spectrum, lam, out):
    n, square = rules.valence, lam * lam
    leader = max(range(2), key=lambda i: float(spectrum.blocks[1][i].value.mid()))
    taken = {(1, leader)}
    left = {k: count for k, count in rules.square.items()}

    def is_square(k, root):
        """Whether an eigenvalue is lambda^2 exactly: by the closed forms, or as rational numbers."""
        if lam.is_exact() and root.real and root.value.is_exact():
            return root.value.fmpq() == lam.fmpq() * lam.fmpq()
        return left.get(k, 0) > 0 and root.real and root.value.overlaps(square)

    verdict, ratio, equal = PROVEN, arb(0), {}
    for k, _, root in spectrum.others(taken):
        if k is not None and is_square(k, root):
            left[k] = left.get(k, 0) - 1
            equal[k] = equal.get(k, 0) + 1
            ratio = ratio.max(arb(1))
            continue
        ratio = ratio.max(root.modulus / square)
        if root.modulus < square:
            continue
        if root.real and root.modulus > square:
            verdict = REFUTED
        elif verdict == PROVEN:
            verdict = UNDECIDED
    # equal ones in one block are semisimple if it is diagonal; in blocks of their own they always are
    if any(count > 1 and k not in spectrum.diagonal for k, count in equal.items()) and verdict == PROVEN:
        verdict = UNDECIDED
    # outer rings may tie too, but 1/8, 1/16, .. are then told apart from lambda^2 as rational numbers
    out["bounded_curvature"] = Found(verdict, ratio)

    needed = {3: {0: 1, 1: 1}, 4: {0: 1, 2: 2}}.get(n, {0: 1, 2: 1})
    enough = all(equal.get(k, 0) >= count for k, count in needed.items())
    apart = any(
        sum(1 for i, root in enumerate(spectrum.blocks[k]) if (k, i) not in taken and root.value.overlaps(square)) < count
        for k, count in needed.items()
    ) and not any(root.value.overlaps(square) for root in spectrum.outer)
    out["non_degenerate"] = Found(PROVEN if enough else REFUTED if apart else UNDECIDED)

    chosen = set()
    for k, count in needed.items():
        free = [i for i in range(2) if (k, i) not in taken]
        free.sort(key=lambda i: -float(spectrum.blocks[k][i].modulus.mid()))
        chosen |= {(k, i) for i in free[:count]}
    mus = [spectrum.blocks[k][i] for k, i in chosen]
    low = None
    for root in mus:
        low = root.modulus if low is None else low.min(root.modulus)
    following = spectrum.others(taken | chosen)
    top = largest(root.modulus for _, _, root in following)
    if all(root.real for root in mus) and top < low:
        out["strict"] = Found(PROVEN, top / low)
    elif any(root.modulus > low for _, _, root in following):
        out["strict"] = Found(REFUTED)


def of_map(rules, net, out):
    n = rules.valence
    found = set()
    for p in range(4):
        for q in range(4):
            if max(p, q) >= 2:
                found |= signs(jacobian(bezier(net, p, q)))
    if {1, -1} <= found:
        out["regular"] = Found(REFUTED)
    elif found in ({1}, {-1}):
        out["regular"] = Found(PROVEN)
    if out["regular"].status == PROVEN:
        edges = [bezier(net, 3, q)[3] for q in range(4)]
        edges += [[bezier(net, p, 3)[i][3] for i in (3, 2, 1, 0)] for p in (3, 2, 1, 0)]
        turns = [turn(edge) for edge in edges]
        if None not in turns:
            winding = sum(turns, arb(0)) * n / (2 * arb.pi())
            whole = winding.unique_fmpz()
            if whole is not None:
                out["injective"] = Found(PROVEN if int(whole) == 1 else REFUTED)
    if (net(1, 0) - net(1, 1)).contains(0) or net(1, 1).contains(0):
        return
    theta = abs(((net(1, 0) - net(1, 1)) / (0 - net(1, 1))).log().imag)
    bound = arb.pi() / 2 - arb.pi() / (2 * n)
    status = PROVEN if theta < bound else REFUTED if theta > bound else UNDECIDED
    out["corner"] = Found(status, theta)


# --------------------------------------------------------------------------- certificates


def rules_of(document):
    """The scheme of a certificate; None with a reason if it is not covered."""
    kind = document["input"]
    valence = document["valence"]
    if not isinstance(valence, int) or not 3 <= valence <= 1000:
        raise BadInput(f"valence {valence}: accepted are 3 to 1000")
    if "family" in kind and kind["family"] == {"spec": "catmull-clark"}:
        return OneRing.catmull_clark(valence), ""
    if "lambda" in kind:
        plane = kind["lambda"]
        lam, s, f2 = (fraction(plane[name]) for name in ("lambda", "s", "f2"))
        f3 = None if plane["f3"] is None else fraction(plane["f3"])
        if (f3 is None) != (valence == 4):
            raise BadInput("f3 is given exactly where the valence is not 4")
        return OneRing.lambda_member(valence, lam, s, f2, f3), ""
    if "file" in kind and "text" in kind["file"]:
        return one_ring_file(kind["file"]["text"], valence)
    return None, "no one-ring scheme that is known here"


def one_ring_file(text, valence):
    """A scheme file of kind "one-ring" whose weights are numbers."""
    parsed = tomllib.loads(text, parse_float=str)
    listed = [entry for entry in parsed.get("valence", []) if entry.get("n") == valence]
    if parsed.get("kind") != "one-ring" or len(listed) != 1:
        return None, "no one-ring rule of this valence with numbers"
    try:
        numbers = {name: fraction(str(listed[0][name])) for name in OneRing.NAMES}
    except (KeyError, ValueError):
        return None, "weights are not all numbers"
    return OneRing.of_numbers(valence, numbers), ""


def encloses(interval, ball):
    """Whether a stored interval and a ball have a common point: both hold the number."""
    low, high = interval
    return low is None or high is None or not (ball < arb(low) or ball > arb(high))


def check(document):
    """Differences between a certificate and what is derived here, and how many statements were compared."""
    rules, reason = rules_of(document)
    if rules is None:
        return [], 0, reason
    derived, differences, compared = statements(rules), [], 0
    for claim in document["checks"]:
        name, status = claim["name"], claim["status"]
        if name not in derived:
            continue
        compared += 1
        found = derived[name]
        if status == found.status:
            stored = claim.get("enclosure")
            if status == PROVEN and stored and found.value is not None and not encloses(stored, found.value):
                differences.append(f"{name}: {stored} does not hold {found.value}")
        elif status == UNDECIDED:
            differences.append(f"{name}: undecided there, {found.status} here")
        else:
            differences.append(f"{name}: {status} there, {found.status} here")
    return differences, compared, ""


# --------------------------------------------------------------------------- ranges


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


# --------------------------------------------------------------------------- planted faults


def self_test():
    """Faults that must not be proven, and a scheme that must be; true if all are as they must be."""

    def planted(valence, *weights):
        return OneRing.of_numbers(valence, dict(zip(OneRing.NAMES, map(fraction, weights))))

    sound = ("1/4", "1/4", "1/4", "3/8", "3/8", "1/16", "1/16", "3/10", "1/20")
    cases = [
        ("a sum off by 1e-9", planted(5, "0.250000001", *sound[1:]), "row_sums", REFUTED),
        ("a negative leader", planted(5, "0.9", "0", "0.1", "1.6", "-0.4", "-0.1", "0", "-0.5", "0"), "subdominant", REFUTED),
        ("index 2 leads", planted(5, "0.9", "0", "0.1", "0.9", "0.3", "-0.1", "0", "0.1", "0"), "subdominant", REFUTED),
        (
            "mu off by 1e-6",
            planted(4, "0.249999", "0.25", "0.250001", "3/8", "3/8", "1/16", "1/16", "0.375", "0.0625"),
            "bounded_curvature",
            REFUTED,
        ),
        ("a fold", planted(5, "1", "-0.05", "0.1", "0.4", "0.4", "0.1", "0", "0.4", "0"), "regular", REFUTED),
        ("sheets", planted(5, "1.3", "-0.2", "0.1", "0.4", "0.4", "0.1", "0", "0.4", "0"), "injective", REFUTED),
        ("a negative weight", planted(5, "1", "-0.05", "0.1", "0.4", "0.4", "0.1", "0", "0.4", "0"), "hull", REFUTED),
        ("Catmull-Clark as numbers", planted(5, *sound), "injective", PROVEN),
        ("Catmull-Clark, curvature", OneRing.catmull_clark(5), "bounded_curvature", REFUTED),
        ("Catmull-Clark, triangle", OneRing.catmull_clark(3), "bounded_curvature", PROVEN),
        ("one weight off by 1e-3", planted(4, "1/4", "1/4", "1/4", "0.374", "0.376", *sound[5:7], "3/8", "1/16"), "non_degenerate", REFUTED),
    ]
    good = True
    for what, rules, name, expected in cases:
        found = statements(rules)[name].status
        good &= found == expected
        print(f"{'ok ' if found == expected else 'BAD'}  {what}: {name} is {found}, {expected} expected")
    # a certificate in which a status, or a number beside it, is another one
    def around(ball):
        middle = float(ball.mid())
        return [nextafter(middle, -inf), nextafter(middle, inf)]

    claims = [
        {"name": name, "status": found.status, "enclosure": None if found.value is None else around(found.value)}
        for name, found in statements(OneRing.catmull_clark(5)).items()
    ]
    document = {"input": {"family": {"spec": "catmull-clark"}}, "valence": 5, "checks": claims}
    for name, change in (("bounded_curvature", {"status": PROVEN}), ("subdominant", {"enclosure": [0.55, 0.551]})):
        spoilt = [{**claim, **change} if claim["name"] == name else claim for claim in claims]
        differences = check({**document, "checks": spoilt})[0]
        good &= len(differences) == 1 and differences[0].startswith(name)
        print(f"{'ok ' if len(differences) == 1 else 'BAD'}  a changed certificate: {differences}")
    return good


# --------------------------------------------------------------------------- command line


def files_of(paths):
    for path in map(Path, paths):
        if path.is_dir():
            yield from sorted(path.rglob("*.json"))
        elif path.is_file():
            yield path
        else:
            raise BadInput(f"{path}: accepted is a certificate or a folder of them")


def main():
    usage = __doc__.split("\n\n", 1)
    parser = argparse.ArgumentParser(
        description=usage[0], epilog=usage[1], formatter_class=argparse.RawDescriptionHelpFormatter
    )
    results = Path(__file__).resolve().parent.parent / "results"
    parser.add_argument("paths", nargs="*", help="certificates, or folders of them")
    parser.add_argument("--precision", type=int, default=200, help="bits of the balls, 64 to 10000; by default 200")
    parser.add_argument("--self-test", action="store_true", help="check planted faults instead of certificates")
    parser.add_argument(
        "--samples", type=int, default=3, help="members looked at in each interval of the ranges, 0 to 1000; by default 3"
    )
    parser.add_argument("--quiet", action="store_true", help="only differences and the summary")
    arguments = parser.parse_args()
    if not 64 <= arguments.precision <= 10000:
        raise BadInput(f"--precision {arguments.precision}: accepted are 64 to 10000")
    if not 0 <= arguments.samples <= 1000:
        raise BadInput(f"--samples {arguments.samples}: accepted are 0 to 1000")
    ctx.prec = arguments.precision
    if not IDENTITIES:
        print("the closed forms of the lambda-scheme do not hold as identities")
        return 1
    if arguments.self_test:
        return 0 if self_test() else 1
    agree = differ = compared = 0
    left = {}
    for path in files_of(arguments.paths or [results / "certificates"]):
        try:
            document = json.loads(path.read_text())
            if "checks" not in document or "input" not in document:
                left["a range of parameters"] = left.get("a range of parameters", 0) + 1
                continue
            differences, count, reason = check(document)
        except (KeyError, TypeError, ValueError) as error:
            raise BadInput(f"{path}: {error}: accepted is a certificate of 'eigenring verify -o'") from error
        if reason:
            left[reason] = left.get(reason, 0) + 1
            continue
        compared += count
        agree, differ = (agree, differ + 1) if differences else (agree + 1, differ)
        for difference in differences:
            print(f"{path.parent.name}/{path.name}: {difference}")
        if not differences and not arguments.quiet:
            print(f"{path.parent.name}/{path.name}: {count} statements agree")
    print(f"{agree} certificates agree ({compared} statements), {differ} differ")
    for reason, count in left.items():
        print(f"{count} not covered: {reason}")
    if not arguments.paths and arguments.samples:
        differences, count = check_ranges(results / "certificates" / "ranges.csv", results, arguments.samples)
        for difference in differences:
            print(difference)
        print(f"{count} statuses of members of the ranges looked at, {len(differences)} differ")
        differ += len(differences)
    if agree + differ == 0:
        raise BadInput("no certificate is covered")
    return 1 if differ else 0


IDENTITIES = lambda_identities()

if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
