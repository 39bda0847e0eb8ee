"""The characteristic map: its net, Bernstein coefficients of its Jacobian, the turns of its boundary."""

from flint import acb, acb_mat, arb, fmpq

from .spectrum import folded, regular_row, ring

# How often a patch is halved in both directions before its Jacobian counts as undecided; empirical.
DEPTH = 12


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
