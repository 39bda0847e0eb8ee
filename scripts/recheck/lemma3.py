"""Lemma 3 on HNUSS for every valence and all positive intervals: the points of a sector, and its three patches.

The points `C + x p + y v + z w` are not found here: they are those of docs/certificates.md, and shown to be halved
by the rules, as an identity in the intervals a and b on both sides of a spoke. Jacobians are worked out in powers
and turned into Bernstein coefficients in the end.
"""

from math import comb

from flint import fmpq, fmpq_mpoly_ctx

# (j, k): parts of p, v and w; those of (k, j) have v and w exchanged
POINTS = {
    (0, 0): (1, 0, 0),
    (1, 0): (1, 2, 0),
    (2, 0): (1, 5, 0),
    (3, 0): (1, 8, 0),
    (1, 1): (fmpq(15, 7), fmpq(6, 7), fmpq(6, 7)),
    (2, 1): (fmpq(87, 35), fmpq(123, 35), fmpq(18, 35)),
    (3, 1): (fmpq(93, 35), fmpq(222, 35), fmpq(12, 35)),
    (2, 2): (fmpq(3987, 1085), fmpq(2523, 1085), fmpq(2523, 1085)),
    (3, 2): (fmpq(939, 217), fmpq(1014, 217), fmpq(363, 217)),
    (3, 3): (fmpq(5853, 1085), fmpq(3912, 1085), fmpq(3912, 1085)),
}
CELLS = ((1, 0), (1, 1), (0, 1))


def everywhere(points):
    """The same with their mirror images."""
    return {**points, **{(k, j): (p, w, v) for (j, k), (p, v, w) in points.items()}}


RING = fmpq_mpoly_ctx.get(["a", "b"], "degrevlex")
A, B = RING.gens()
ONE = A**0


class Quotient:
    """A quotient of polynomials in a and b; zero or not by its numerator."""

    def __init__(self, over, under=ONE):
        self.over, self.under = ONE * over, ONE * under

    def __add__(self, o):
        return Quotient(self.over * o.under + o.over * self.under, self.under * o.under)

    def __sub__(self, o):
        return self + Quotient(-o.over, o.under)

    def __mul__(self, o):
        return Quotient(self.over * o.over, self.under * o.under)

    def __truediv__(self, o):
        return Quotient(self.over * o.under, self.under * o.over)

    def is_zero(self):
        return self.over == 0


def edge(before, own, after):
    """The univariate edge point's weights of the ends."""
    total = (before + own + after) * Quotient(2)
    return [(own + after * Quotient(2)) / total, (own + before * Quotient(2)) / total]


def vertex(beyond_left, left, right, beyond_right):
    """The univariate vertex point's weights of the points before, at and after it."""
    near = edge(beyond_left, left, right)
    far = edge(left, right, beyond_right)
    total = (left + right) * Quotient(2)
    before, after = right / total, left / total
    return [before * near[0], Quotient(1) / Quotient(2) + before * near[1] + after * far[0], after * far[1]]


def fine(index, left, own):
    """Weights of a new point over points -1, 0, 1, .. of one direction: the interval before point 0 is zero."""
    zero = Quotient(0)
    if index == 0:
        return dict(zip((-1, 0, 1), vertex(left, zero, own, own)))
    if index == 1:
        return dict(zip((0, 1), edge(zero, own, own)))
    if index == 2:
        return dict(zip((0, 1, 2), vertex(zero, own, own, own)))
    return dict(zip((1, 2), edge(own, own, own)))


def is_halved(points):
    """Whether the rules take every point of the sector to its half, for all positive a and b."""
    points = everywhere(points)
    a, b = Quotient(A), Quotient(B)

    def parts(j, k):
        # beyond spoke i, at k = -1, lies the point (0, j) of the sector before: C + p' + c v, where v divides p and
        # its neighbour p' as E_(i-1) divides the corners: (a + b) v = a p + b p'
        if k == -1:
            _, c, _ = points[j, 0]
            return [Quotient(0) - a / b, (a + b) / b + Quotient(c), Quotient(0)]
        return [Quotient(x) for x in points[j, k]]

    for j in range(1, 4):
        for k in range(j + 1):
            total = [Quotient(0)] * 3
            for at, in_j in fine(j, None, b).items():
                for other, in_k in fine(k, a, b).items():
                    total = [sum_ + in_j * in_k * x for sum_, x in zip(total, parts(at, other))]
            if not all((x - y * Quotient(fmpq(1, 2))).is_zero() for x, y in zip(total, parts(j, k))):
                return False
    return True


def blossom(points, knots, arguments):
    """The polar form of a cubic with these local knots, six of them, at three arguments."""
    points = [list(p) for p in points]
    for step, u in enumerate(arguments):
        for i in range(3 - step):
            low, high = knots[i + step], knots[i + 3]
            share = fmpq(u - low) / (high - low)
            points[i] = [(1 - share) * x + share * y for x, y in zip(points[i], points[i + 1])]
    return points[0]


def control(points, cell):
    """The 16 Bezier points of a cell in parts of p, v, w, by [i][j] with i along the first direction."""
    points = everywhere(points)
    # with a triple knot at the line: its points are (1 + c) v, the intervals of this side all 1
    for (j, k), (p, v, w) in list(points.items()):
        if k == 0:
            points[j, -1] = (p - 1, v + 1, w)
        if j == 0:
            points[-1, k] = (p - 1, v, w + 1)

    def local(index):
        return (range(-1, 3), (0, 0, 0, 1, 2, 3)) if index == 0 else (range(4), (0, 0, 1, 2, 3, 4))

    def ends(index, i):
        return [index + (1 if step < i else 0) for step in range(3)]

    (first, knots), (second, others) = local(cell[0]), local(cell[1])
    rows = [
        [blossom([points.get((j, k), (0, 0, 0)) for k in second], others, ends(cell[1], i)) for i in range(4)] for j in first
    ]
    return [[blossom([rows[j][col] for j in range(4)], knots, ends(cell[0], i)) for col in range(4)] for i in range(4)]


PLANE = fmpq_mpoly_ctx.get(["u", "v"], "degrevlex")
U, V = PLANE.gens()


def polynomial(coefficients):
    """A polynomial from Bernstein coefficients [i][j]."""
    m, n = len(coefficients) - 1, len(coefficients[0]) - 1
    total = 0 * U
    for i, row in enumerate(coefficients):
        for j, c in enumerate(row):
            total += comb(m, i) * comb(n, j) * c * U**i * (1 - U) ** (m - i) * V**j * (1 - V) ** (n - j)
    return total


def bernstein(poly, m, n):
    """Its Bernstein coefficients of degrees m and n, row by row."""
    powers = {tuple(map(int, exponents)): c for exponents, c in poly.to_dict().items()}
    ratio = lambda i, k, size: fmpq(comb(i, k), comb(size, k))  # noqa: E731
    return [
        sum((c * ratio(i, k, m) * ratio(j, l, n) for (k, l), c in powers.items() if k <= i and l <= j), fmpq(0))
        for i in range(m + 1)
        for j in range(n + 1)
    ]


def jacobians(points, cell):
    """The Bernstein coefficients of J_vw, J_pw and J_vp, and whether the map grows as Gale and Nikaido need."""
    net = control(points, cell)
    x, y, z = (polynomial([[net[i][j][part] for j in range(4)] for i in range(4)]) for part in range(3))
    by_u, by_v = (lambda f: f.derivative(0)), (lambda f: f.derivative(1))
    minor = lambda f, g: bernstein(by_u(f) * by_v(g) - by_v(f) * by_u(g), 5, 5)  # noqa: E731

    def grows(f, g, degrees):
        pairs = zip(bernstein(f, *degrees), bernstein(g, *degrees))
        return all(a >= 0 and b >= 0 and a + b > 0 for a, b in pairs)

    rises = grows(by_u(x), by_u(y), (2, 3)) and grows(by_v(x), by_v(z), (3, 2))
    return [minor(y, z), minor(x, z), minor(y, x)], rises


def lemma(points=None):
    """Whether the map is regular and injective, by this proof, and the coefficients of each cell."""
    points = points or POINTS
    found = {cell: jacobians(points, cell) for cell in CELLS}
    halved = is_halved(points)
    positive = all(
        all(c >= 0 for c in each) for lists, _ in found.values() for each in lists
    ) and all(any(min(each) > 0 for each in lists) for lists, _ in found.values())
    regular = halved and positive
    return regular, regular and all(rises for _, rises in found.values()), {cell: lists for cell, (lists, _) in found.items()}
