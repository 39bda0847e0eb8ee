"""Rational numbers, and the closed forms of the lambda-scheme as identities of polynomials."""

from fractions import Fraction
from math import isqrt

from flint import fmpq, fmpq_mpoly_ctx


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


IDENTITIES = lambda_identities()
