"""All valences from one on: Catmull-Clark and Doo-Sabin over the angle theta = 2 pi/N as a ball.

Coordinates are (x, y/theta) in the frame whose x-axis halves sector 0: a point is x + j y with j^2 = -theta^2, and
the turn by one sector is cos theta + j sinc theta. In them thin sectors have a limit, and balls may hold theta = 0.
"""

from flint import arb, arb_mat, fmpq

from .maps import bezier, characteristic_net, jacobian, signs
from .schemes import OneRing
from .spectrum import folded, outer_rings, quadratic, regular_row, ring

# An interval of theta is not halved more often than so; empirical, 2^-9 of the whole decides both schemes.
HALVINGS = 14
FIRST = 5


class Thin:
    """x + j y, j^2 = -square."""

    square = None

    def __init__(self, x, y):
        self.x, self.y = arb(x), arb(y)

    def __add__(self, o):
        return Thin(self.x + o.x, self.y + o.y)

    def __sub__(self, o):
        return Thin(self.x - o.x, self.y - o.y)

    def __mul__(self, o):
        if not isinstance(o, Thin):
            return Thin(self.x * o, self.y * o)
        return Thin(self.x * o.x - Thin.square * self.y * o.y, self.x * o.y + self.y * o.x)


def ball(low, high):
    return arb(low).union(arb(high))


def turns(theta):
    forward, back = Thin(theta.cos(), theta.sinc()), Thin(theta.cos(), -theta.sinc())
    return {-1: back, 0: Thin(1, 0), 1: forward}


def extend(known, points, row, where, lam, phase):
    """Values on the points of a ring from those within: (lambda - S_rr) v_r = sum S_rq v_q; None if not unique."""
    size = len(points)
    matrix = [[arb(0)] * (2 * size) for _ in range(2 * size)]
    right = [[arb(0)] for _ in range(2 * size)]
    for i, point in enumerate(points):
        for half in (2 * i, 2 * i + 1):
            matrix[half][half] += lam
        for at, weight in row(*point).items():
            x, y, sector = where(*at)
            if (x, y) in known:
                value = phase[sector] * known[x, y] * arb(weight)
                right[2 * i][0] += value.x
                right[2 * i + 1][0] += value.y
            else:
                j, w = points.index((x, y)), phase[sector] * arb(weight)
                matrix[2 * i][2 * j] -= w.x
                matrix[2 * i][2 * j + 1] += Thin.square * w.y
                matrix[2 * i + 1][2 * j] -= w.y
                matrix[2 * i + 1][2 * j + 1] -= w.x
    try:
        solution = arb_mat(matrix).solve(arb_mat(right))
    except ZeroDivisionError:
        return None
    fresh = {point: Thin(solution[2 * i, 0], solution[2 * i + 1, 0]) for i, point in enumerate(points)}
    return {**known, **fresh}


class CatmullClark:
    """Bicubic; only the vertex has a rule of its own."""

    degree = 3

    def __init__(self, **changed):
        self.weights = {
            **dict(f1=fmpq(1, 4), f2=fmpq(1, 4), f3=fmpq(1, 4), d1=fmpq(3, 8), d2=fmpq(3, 8)),
            **dict(e1=fmpq(1, 16), e2=fmpq(1, 16), alpha=fmpq(3, 2), beta=fmpq(1, 4), own=fmpq(-7, 4)),
            **changed,
        }

    def rows_sum(self):
        w = self.weights
        return (
            w["f1"] + 2 * w["f2"] + w["f3"] == 1
            and w["d1"] + w["d2"] + 2 * w["e1"] + 2 * w["e2"] == 1
            and w["own"] + w["alpha"] + w["beta"] == 0
        )

    def block(self, cosine):
        """Trace and determinant of a block other than that of the constants."""
        w = self.weights
        own = w["d2"] + 2 * w["e1"] * cosine
        return own + w["f3"], own * w["f3"] - w["e2"] * w["f2"] * (2 + 2 * cosine)

    def leader(self, theta):
        roots = quadratic(*(arb(x) for x in self.block(theta.cos())))
        return None if roots is None or not roots[0].real else roots[0].value

    def leads(self, theta, lam):
        """Whether lambda leads everything else at every N = 2 pi/theta of the ball."""
        w = self.weights
        square = lam * lam
        # the blocks 2 .. N-2 have smaller cosines; at lambda their polynomial grows as the cosine falls
        slope_t, slope_d = 2 * w["e1"], 2 * w["e1"] * w["f3"] - 2 * w["e2"] * w["f2"]
        good = arb(slope_t) * lam - slope_d > 0
        for cosine in (-1, 1):
            t, d = self.block(cosine)
            good = good and square + arb(t) * lam + d > 0 and abs(arb(d)) < square
        # the block of the constants, with 1/N = theta/(2 pi): trace t0 + t1/N, determinant d0 + d1/N
        a, b = w["alpha"], w["beta"]
        p, q, r, s = w["d2"] + 2 * w["e1"], w["f3"], 2 * w["e2"], 2 * w["f2"]
        t0, d0, t1, d1 = p + q, p * q - r * s, -a - b, r * a + s * b - p * b - q * a
        part = theta / (2 * arb.pi())
        t, d = t0 + t1 * part, d0 + d1 * part
        good = good and square + t * lam + d > 0 and abs(d) < square
        # N p(lambda) less N times the polynomial of block 1, which is 0; N (1 - cos theta) = pi theta sinc^2(theta/2)
        flat = arb.pi() * theta * (theta / 2).sinc() ** 2
        return good and lam * (-t1 - slope_t * flat) + d1 + slope_d * flat > 0 and fmpq(1, 8) < lam and outer_rings()

    def net(self, theta, lam):
        phase = turns(theta)
        # the first spoke is at -theta/2
        half = theta / 2
        known = {(0, 0): Thin(0, 0), (1, 0): Thin(half.cos(), -half.sinc() / 2)}
        if 0 in lam - self.weights["f3"]:
            return None
        known[1, 1] = Thin(2 * self.weights["f2"] * half.cos() / (lam - self.weights["f3"]), 0)
        for r in (2, 3):
            known = extend(known, ring(r), regular_row, folded, lam, phase)
            if known is None:
                return None

        def at(a, b):
            x, y, sector = folded(a, b)
            return phase[sector] * known[x, y]

        return at

    def second(self, theta, lam):
        """The larger eigenvalue of block 2 over lambda^2."""
        roots = quadratic(*(arb(x) for x in self.block((2 * theta).cos())))
        return None if roots is None else roots[0].value / (lam * lam)


class DooSabin:
    """Biquadratic, around a face; point (a, b) is the corner at (a + 1/2, b + 1/2)."""

    degree = 2

    def __init__(self, first=fmpq(1, 2), others=fmpq(1, 4)):
        self.first, self.others = first, others

    def rows_sum(self):
        return True

    def leader(self, theta):
        return arb(self.first)

    @staticmethod
    def row(a, b):
        def line(i):
            near, far = (i // 2, i // 2 - 1) if i % 2 == 0 else (i // 2, i // 2 + 1)
            return {near: fmpq(3, 4), far: fmpq(1, 4)}

        return {(x, y): p * q for x, p in line(a).items() for y, q in line(b).items()}

    @staticmethod
    def folded(a, b):
        if a >= 0 and b >= 0:
            return a, b, 0
        if b < 0:
            return -1 - b, a, -1
        return b, -1 - a, 1

    @staticmethod
    def ring(r):
        return [(r, b) for b in range(r + 1)] + [(a, r) for a in range(r)]

    def leads(self, theta, lam):
        # rows of ring 1 have 7/16 in their own ring, those of ring 2 nothing
        for r, bound in ((1, fmpq(7, 16)), (2, fmpq(0))):
            for point in self.ring(r):
                own = [w for at, w in self.row(*point).items() if max(self.folded(*at)[:2]) >= r]
                if sum(own, fmpq(0)) > bound:
                    return False
        return fmpq(7, 16) < lam and abs(arb(self.others)) < lam and lam < 1

    def net(self, theta, lam):
        phase = turns(theta)
        known = {(0, 0): Thin(1, 0)}
        for r in (1, 2):
            known = extend(known, self.ring(r), self.row, self.folded, lam, phase)
            if known is None:
                return None

        def at(a, b):
            x, y, sector = self.folded(a, b)
            return phase[sector] * known[x, y]

        return at

    def second(self, theta, lam):
        return None


# the quadratic B-spline's piece in Bernstein form, in halves, and the cubic one's, in sixths
TO_BEZIER = {2: ([[1, 1, 0], [0, 2, 0], [0, 1, 1]], 2), 3: ([[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]], 6)}
BINOMIAL = {1: [1, 1], 2: [1, 2, 1], 3: [1, 3, 3, 1], 5: [1, 5, 10, 10, 5, 1]}


def patch(net, p, q, degree):
    """Bezier points [i][j] of patch (p, q)."""
    lines, under = TO_BEZIER[degree]
    grid = [[net(p - 1 + i, q - 1 + j) for j in range(degree + 1)] for i in range(degree + 1)]

    def combine(points):
        out = []
        for line in lines:
            total = Thin(0, 0)
            for point, weight in zip(points, line):
                if weight:
                    total += point * fmpq(weight, under)
            out.append(total)
        return out

    along = [combine(column) for column in zip(*grid)]
    return [combine(row) for row in zip(*along)]


def determinant(points, degree):
    """Bernstein coefficients of the Jacobian, with y divided by theta."""
    d, top = degree, 2 * degree - 1
    binomial = {n: BINOMIAL[n] for n in (d - 1, d, top)}
    out = [[arb(0) for _ in range(top + 1)] for _ in range(top + 1)]
    for i in range(d):
        for j in range(d + 1):
            u = (points[i + 1][j] - points[i][j]) * d
            for k in range(d + 1):
                for l in range(d):
                    v = (points[k][l + 1] - points[k][l]) * d
                    scale = binomial[d - 1][i] * binomial[d][j] * binomial[d][k] * binomial[d - 1][l]
                    out[i + k][j + l] += (u.x * v.y - u.y * v.x) * scale
    return [[out[i][j] / (binomial[top][i] * binomial[top][j]) for j in range(top + 1)] for i in range(top + 1)]


def decide(scheme, theta):
    """Whether C1 is shown on a ball of theta, and block 2's eigenvalue over lambda^2 if there is one."""
    Thin.square = theta * theta
    lam = scheme.leader(theta)
    if lam is None or not scheme.leads(theta, lam):
        return False, None
    net = scheme.net(theta, lam)
    if net is None:
        return False, None
    # patch (0, 1) is the mirror image of (1, 0)
    for p, q in ((1, 0), (1, 1)):
        points = patch(net, p, q, scheme.degree)
        # the sector stays in the half-plane x > 0, so that its boundary turns by theta and all of them once
        if not all(point.x > 0 for row in points for point in row):
            return False, None
        if not all(c > 0 for row in determinant(points, scheme.degree) for c in row):
            return False, None
    return True, scheme.second(theta, lam)


def prove(scheme, first=FIRST):
    """Whether C1 is proven for every N >= first; whether block 2 exceeds lambda^2 at all; how many intervals."""
    if not scheme.rows_sum():
        return False, False, 0
    whole = 2 * arb.pi() / first
    waiting, count, above = [(fmpq(0), fmpq(1), 0)], 0, True
    while waiting:
        low, high, depth = waiting.pop()
        good, ratio = decide(scheme, whole * ball(arb(low), arb(high)))
        if not good and depth < HALVINGS:
            middle = (low + high) / 2
            waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]
        elif not good:
            return False, False, count
        else:
            count += 1
            above = above and ratio is not None and ratio > 1
    return True, above, count


SAMPLED = (5, 6, 7, 8, 9, 10, 12, 15, 20, 32, 50, 100, 200, 500, 1000, 5000, 10**4, 5 * 10**4, 10**5, 10**6)


def sampled(valence):
    """Whether Catmull-Clark is regular and its eigenvalues are in order at one N, without thin coordinates."""
    rules, roots = OneRing.catmull_clark(valence), {}
    for k in {0, 1, 2, valence // 2}:
        c = rules.cosine(k)
        if k == 0:
            a, b = rules.d2 + 2 * rules.e1 - rules.alpha, 2 * rules.e2 - rules.beta
            x, d = 2 * rules.f2 - rules.alpha, rules.f3 - rules.beta
            roots[k] = quadratic(a + d, a * d - b * x)
        else:
            a, d = rules.d2 + 2 * rules.e1 * c, rules.f3
            roots[k] = quadratic(a + d, a * d - rules.e2 * rules.f2 * (2 + 2 * c))
    lam = roots[1][0].value
    others = [root for k, pair in roots.items() for i, root in enumerate(pair) if (k, i) != (1, 0)]
    if not all(root.modulus < lam for root in others):
        return False
    net = characteristic_net(rules, lam)
    found = set()
    for p, q in ((1, 0), (1, 1)):
        found |= signs(jacobian(bezier(net, p, q)))
    return found == {1}


def check(document):
    """Differences between a stored certificate of all valences and what is derived here."""
    schemes = {"catmull-clark": CatmullClark, "doo-sabin": DooSabin}
    scheme, first = schemes.get(document["scheme"]), document["from"]
    if scheme is None or not isinstance(first, int) or not FIRST <= first <= 1000:
        return [], 0, "no scheme that is known here for all valences"
    smooth, above, _ = prove(scheme(), first)
    derived = dict.fromkeys(("row_sums", "dominant", "subdominant", "regular", "injective"), "proven" if smooth else "undecided")
    if above:
        derived["bounded_curvature"] = "refuted"
    claims = {claim["name"]: claim["status"] for claim in document["checks"]}
    differences = [
        f"{name}: {claims.get(name)} there, {status} here" for name, status in derived.items() if claims.get(name) != status
    ]
    return differences, len(derived), ""
