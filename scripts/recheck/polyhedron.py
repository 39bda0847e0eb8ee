"""NURSS and eigen-polyhedra around one vertex, in balls: matrices, the domain, eigenvalues.

Rows and columns are V, E_0 .., F_0 .. . A row is a dictionary of these to weights.
"""

from flint import acb_mat, arb, arb_mat, fmpq

CENTRE = ("V", 0)


def combined(*terms):
    row = {}
    for weight, other in terms:
        for point, own in other.items():
            row[point] = row.get(point, arb(0)) + weight * own
    return row


class Rules:
    """The rules of NURSS for intervals d of spokes and a beyond, and the polyhedron of d."""

    def __init__(self, d, a=None):
        self.n = len(d)
        self.d = [arb(x) for x in d]
        self.a = [arb(x) for x in (a or d)]

    def at(self, i):
        return self.d[i % self.n]

    def point(self, kind, i):
        return {(kind, i % self.n): arb(1)}

    def bilinear(self, i, own, following):
        """The face point: own weighs towards E_i, following towards E_(i+1)."""
        return combined(
            (own * following, self.point("F", i)),
            ((1 - own) * following, self.point("E", i + 1)),
            (own * (1 - following), self.point("E", i)),
            ((1 - own) * (1 - following), {CENTRE: arb(1)}),
        )

    def nurss(self):
        """All rows of one step of NURSS."""
        n, d = self.n, self.at
        behind = [d(i - 2) + d(i + 2) for i in range(n)]
        w = [(behind[i] + d(i)) / (behind[i] + 2 * d(i) + 2 * self.a[i]) for i in range(n)]
        middles = [combined((w[i], self.point("E", i)), (1 - w[i], {CENTRE: arb(1)})) for i in range(n)]
        faces = [self.bilinear(i, w[i], w[(i + 1) % n]) for i in range(n)]
        edges = []
        for i in range(n):
            total = 2 * (d(i - 1) + d(i + 1))
            edges.append(combined((arb(0.5), middles[i]), (d(i - 1) / total, faces[i]), (d(i + 1) / total, faces[i - 1])))
        if n == 4:
            # the tensor product, Eq. 3: edge points across the spokes 1 and 3, middles along 0 and 2
            def line(own, first, second, i, j):
                total = 2 * (d(i) + d(j))
                return combined((arb(0.5), own), (d(j) / total, first), (d(i) / total, second))

            along = line({CENTRE: arb(1)}, middles[0], middles[2], 0, 2)
            vertex = line(along, edges[1], edges[3], 1, 3)
        else:
            f = [d(i - 1) * d(i + 2) for i in range(n)]
            m = [f[i] + f[i - 1] for i in range(n)]
            share = arb(fmpq(3, n)) / sum((x + y for x, y in zip(f, m)), arb(0))
            terms = [(share * m[i], middles[i]) for i in range(n)] + [(share * f[i], faces[i]) for i in range(n)]
            vertex = combined((arb(fmpq(n - 3, n)), {CENTRE: arb(1)}), *terms)
        return [vertex, *edges, *faces]

    def polyhedron(self):
        """V^ = 0, E^_i and F^_i in the plane; d-, gamma and lambda."""
        n, d = self.n, self.at
        c = arb.cos_pi_fmpq(fmpq(2, n))
        gamma = 4 / (c + 1 + ((c + 9) * (c + 1)).sqrt())
        minus = [(d(i - 2) * d(i + 1) + d(i + 2) * d(i - 1)) / (d(i - 1) + d(i + 1)) for i in range(n)]
        points = {CENTRE: (arb(0), arb(0))}
        for i in range(n):
            length, turn = (2 * d(i) + minus[i]) / 3, fmpq(2 * i, n)
            points["E", i] = (length * arb.cos_pi_fmpq(turn), length * arb.sin_pi_fmpq(turn))
        for i in range(n):
            points["F", i] = tuple(gamma * (x + y) for x, y in zip(points["E", i], points["E", (i + 1) % n]))
        return points, gamma, (1 + gamma) / (4 * gamma)

    def weights(self):
        """Eqs. 9 and 13 solved: alpha and beta, or None where no root is real."""
        n = self.n
        points, gamma, lam = self.polyhedron()
        centre = image(self.nurss()[0], points)
        alpha, beta = [], []
        for i in range(n):
            e, f = points["E", i], points["E", (i + 1) % n]
            goal = [c + lam * p for c, p in zip(centre, points["F", i])]
            x, y = cross(goal, f) / cross(e, f), cross(e, goal) / cross(e, f)
            pair = []
            for own, other in ((x, y), (y, x)):
                b = 1 - (gamma - 1) * (own - other)
                under = b * b + 4 * (gamma - 1) * own
                if not under >= 0:
                    return None
                pair.append(2 * own / (b + under.sqrt()))
            alpha.append(pair)
        for i in range(n):
            found = self.edge_weights(points, centre, lam, alpha, i)
            if found is None:
                return None
            beta.append(found)
        return alpha, beta

    def sides(self, i, alpha):
        """P_(i,1) .. P_(i,4) of Eqs. 11 and 12, and V and E_i."""
        before, after = alpha[(i - 1) % self.n][0], alpha[i % self.n][1]
        own, vertex = self.point("E", i), {CENTRE: arb(1)}
        return [
            combined((1 - before, vertex), (before, self.point("E", i - 1))),
            combined((1 - after, vertex), (after, self.point("E", i + 1))),
            combined((1 - before, own), (before, self.point("F", i - 1))),
            combined((1 - after, own), (after, self.point("F", i))),
            vertex,
            own,
        ]

    def edge_row(self, i, alpha, first, second):
        p1, p2, p3, p4, vertex, own = self.sides(i, alpha)
        half = arb(0.5)
        return combined(
            ((1 - second) * (1 - first) * half, p1),
            ((1 - second) * first * half, p2),
            ((1 - second) * half, vertex),
            (second * (1 - first) * half, p3),
            (second * first * half, p4),
            (second * half, own),
        )

    def edge_weights(self, points, centre, lam, alpha, i):
        """Eq. 13, bilinear in both weights: q0 + q1 b1 + q2 b2 + q3 b1 b2 = 0 in the plane."""
        at = lambda first, second: image(self.edge_row(i, alpha, arb(first), arb(second)), points)  # noqa: E731
        minus = lambda x, y: [a - b for a, b in zip(x, y)]  # noqa: E731
        goal = [c + lam * p for c, p in zip(centre, points["E", i])]
        q0 = minus(at(0, 0), goal)
        q1, q2 = minus(at(1, 0), at(0, 0)), minus(at(0, 1), at(0, 0))
        q3 = minus(minus(at(1, 1), at(1, 0)), q2)
        # (q0 + q2 b2) x (q1 + q3 b2) = 0
        a, b, c = cross(q2, q3), cross(q0, q3) + cross(q2, q1), cross(q0, q1)
        under = b * b - 4 * a * c
        if not under >= 0:
            return None
        root, best = under.sqrt(), None
        for sign in (1, -1):
            # without a division by a, which vanishes for equal intervals
            low = -b - sign * root
            if 0 in low:
                continue
            second = 2 * c / low
            direction = [x + second * y for x, y in zip(q1, q3)]
            rest = [x + second * y for x, y in zip(q0, q2)]
            size = sum((x * x for x in direction), arb(0))
            if 0 in size:
                continue
            first = -sum((x * y for x, y in zip(rest, direction)), arb(0)) / size
            beyond = max(float(max(-w.mid(), w.mid() - 1, arb(0))) for w in (first, second))
            if best is None or beyond < best[0]:
                best = (beyond, [first, second])
        return best and best[1]

    def eigen_polyhedron(self):
        """The constant matrix N and the least of all weights and of what they lack of 1; None without them."""
        found = self.weights()
        if found is None:
            return None
        alpha, beta = found
        n = self.n
        rows = [self.nurss()[0]]
        rows += [self.edge_row(i, alpha, *beta[i]) for i in range(n)]
        rows += [self.bilinear(i, *alpha[i]) for i in range(n)]
        margin = None
        for weight in (w for pair in alpha + beta for w in pair):
            least = weight.min(1 - weight)
            margin = least if margin is None else margin.min(least)
        return rows, margin

    def fits(self, rows):
        """Whether N takes the polyhedron to V- and lambda times itself, up to the balls' radii."""
        points, _, lam = self.polyhedron()
        centre = image(rows[0], points)
        for row, point in zip(rows, self.order()):
            expected = [c + lam * p for c, p in zip(centre, points[point])]
            if not all(x.overlaps(y) and (x - y).abs_upper() < arb(2) ** -100 for x, y in zip(image(row, points), expected)):
                return False
        return True

    def order(self):
        return [CENTRE, *(("E", i) for i in range(self.n)), *(("F", i) for i in range(self.n))]

    def matrix(self, rows):
        return [[row.get(point, arb(0)) for point in self.order()] for row in rows]


def image(row, points):
    return [sum((weight * points[point][k] for point, weight in row.items()), arb(0)) for k in (0, 1)]


def cross(x, y):
    return x[0] * y[1] - x[1] * y[0]


def sums(rows):
    """The largest distance of a row's sum from 1."""
    return max(float((sum(row.values(), arb(0)) - 1).abs_upper()) for row in rows)


def moduli(matrix):
    """Moduli of the eigenvalues, falling, and whether each is real: as balls, or without radii where Arb cannot tell
    them apart."""
    matrix = acb_mat(arb_mat(matrix))
    try:
        values = matrix.eig(multiple=True)
    except ValueError:
        values = matrix.eig(algorithm="approx")
    found = [(abs(x), 0 in x.imag) for x in values]
    return sorted(found, key=lambda pair: -float(pair[0].mid()))
