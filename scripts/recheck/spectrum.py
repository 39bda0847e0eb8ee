"""Eigenvalues of the blocks of one-ring rules: quadratics, and those of the outer rings."""

from flint import arb, fmpq

from .exact import square_root


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
                beside = (b, x)
            else:
                a, d = rules.d2 + 2 * rules.e1 * c, rules.f3
                # w^k + 1 has the squared modulus 2 + 2 c
                beside = (rules.e2 * (2 + 2 * c), rules.f2 * (2 + 2 * c))
            product = b * x if k == 0 else rules.e2 * rules.f2 * (2 + 2 * c)
            # one zero beside the diagonal leaves its entries as eigenvalues, but perhaps a Jordan block
            if all(entry.is_zero() for entry in beside):
                self.diagonal.add(k)
            if product.is_zero():
                roots = sorted((Root(a), Root(d)), key=lambda root: -float(root.value.mid()))
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
