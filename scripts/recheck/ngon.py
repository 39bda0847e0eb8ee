"""The n-gon of HNUSS around one vertex, in exact numbers: Lemmas 1 and 2, row sums, strictness."""

from flint import acb, acb_mat, arb, fmpq, fmpq_mpoly_ctx, fmpq_poly, fmpz_poly


class Cyclotomic:
    """Elements of Q(zeta_n) as polynomials in zeta, reduced."""

    def __init__(self, n):
        self.n = n
        self.modulus = fmpq_poly(fmpz_poly.cyclotomic(n))

    def power(self, k):
        return fmpq_poly([0] * (k % self.n) + [1]) % self.modulus

    def times(self, x, y):
        return (x * y) % self.modulus


def alpha_times_n(d):
    """n alpha_i: d_i/(d_i + d_(i+2)) d_(i+1)/(d_(i+1) + d_(i-1))."""
    n = len(d)
    at = lambda i: d[i % n]  # noqa: E731
    return [at(i) / (at(i) + at(i + 2)) * at(i + 1) / (at(i + 1) + at(i - 1)) for i in range(n)]


def beta(d):
    """The weights of the fixed point."""
    n = len(d)
    at = lambda i: d[i % n]  # noqa: E731
    over = [(at(i - 1) + at(i + 3)) * at(i + 2) + (at(i - 2) + at(i + 2)) * at(i - 1) for i in range(n)]
    under = sum(((at(j) + at(j + 2)) * (at(j - 1) + at(j + 3)) for j in range(n)), fmpq(0))
    return [x / under for x in over]


class NGon:
    """Q_n of intervals, exactly; faults of a test may replace the weights or the Fourier mode."""

    def __init__(self, d, alpha=None, weights=None, mode=1):
        self.d, self.n = d, len(d)
        self.field = Cyclotomic(self.n)
        self.alpha = alpha or alpha_times_n(d)
        self.beta = weights or beta(d)
        self.mode = mode

    def weight(self, i, j):
        """Q_ij = (delta_ij + beta_j)/2 + alpha_i (1 + 2 cos(2 pi (j-i)/n) - n delta_ij)."""
        wave = 1 + self.field.power(self.mode * (j - i)) + self.field.power(self.mode * (i - j))
        own = fmpq(int(i == j))
        return fmpq_poly([(own + self.beta[j]) / 2 - self.alpha[i] * own]) + self.alpha[i] / self.n * wave

    def rows_sum_to_one(self):
        zero = self.field.modulus * 0
        rows = (sum((self.weight(i, j) for j in range(self.n)), zero) for i in range(self.n))
        return all((row - 1) % self.field.modulus == 0 for row in rows)

    def polygon_is_halved(self):
        """Lemma 2 for the corners zeta^i, whose real and imaginary parts are the polygon's coordinates."""
        field, zero = self.field, self.field.modulus * 0
        centre = sum((b * field.power(j) for j, b in enumerate(self.beta)), zero)
        for i in range(self.n):
            image = sum((field.times(self.weight(i, j), field.power(j)) for j in range(self.n)), zero)
            if (2 * image - field.power(i) - centre) % field.modulus != 0:
                return False
        return True

    def gap(self):
        """By how much all eigenvalues after 1, 1/2, 1/2 stay below 1/2, at least: Lemma 1."""
        return min(min(min(a, 1 - a) for a in self.alpha), fmpq(1, 2))

    def is_strict(self):
        """Whether Lemma 1 leaves 1/2 double: n alpha in [0, 1], and at most three of them at either end."""
        ends = [sum(1 for a in self.alpha if a == end) for end in (0, 1)]
        return all(0 <= a <= 1 for a in self.alpha) and max(ends) <= 3

    def others(self):
        """The compression of diag(n alpha) to the Fourier modes other than 0 and +-1: Hermitian, its eigenvalues mu."""
        n, modes = self.n, [k for k in range(self.n) if k not in (0, 1, self.n - 1)]
        wave = [acb(arb.cos_pi_fmpq(fmpq(2 * k, n)), arb.sin_pi_fmpq(fmpq(2 * k, n))) for k in range(n)]
        alpha = [arb(a) for a in self.alpha]
        entry = lambda k, l: sum((a * wave[j * (l - k) % n] for j, a in enumerate(alpha)), acb(0)) / n  # noqa: E731
        return [[entry(k, l) for l in modes] for k in modes]

    def lies_within(self, low, high):
        """Whether all mu lie between two numbers: two Hermitian matrices are positive definite."""
        matrix = self.others()

        def positive(shift, sign):
            rows = [[sign * (x - (shift if i == j else 0)) for j, x in enumerate(row)] for i, row in enumerate(matrix)]
            for i, row in enumerate(rows):
                if not row[i].real > 0:
                    return False
                for other in rows[i + 1 :]:
                    share = other[i] / row[i]
                    other[:] = [x - share * y for x, y in zip(other, row)]
            return True

        return positive(low, 1) and positive(high, -1)

    def fourth(self):
        """The largest |1/2 - mu|, in few digits."""
        matrix = self.others()
        if not matrix:
            return 0.0
        values = acb_mat(matrix).eig(algorithm="approx")
        return max(abs(0.5 - float(x.real.mid())) for x in values)

    def corners_lie_in_cones(self):
        """Whether p = s v + t w with s, t > 0 at every corner of the regular polygon."""
        n = self.n
        at = lambda i: (arb.cos_pi_fmpq(fmpq(2 * (i % n), n)), arb.sin_pi_fmpq(fmpq(2 * (i % n), n)))  # noqa: E731
        centre = [sum((arb(b) * at(i)[k] for i, b in enumerate(self.beta)), arb(0)) for k in (0, 1)]

        def middle(i):
            own, other = arb(self.d[i % n]), arb(self.d[(i + 2) % n])
            return [(own * q + other * p) / (own + other) - c for p, q, c in zip(at(i), at(i + 1), centre)]

        cross = lambda x, y: x[0] * y[1] - x[1] * y[0]  # noqa: E731
        for i in range(n):
            v, w, p = middle(i - 1), middle(i), [x - c for x, c in zip(at(i), centre)]
            if not (cross(v, w) > 0 and cross(v, p) > 0 and cross(p, w) > 0):
                return False
        return True


def for_all_valences():
    """What Lemmas 1 and 2 need of every valence: beta sums to 1, and Pi is a projector on the modes 0 and +-1.

    From n = 9 on the products d_i d_j of beta's numerators and denominator fall into the same orbits under rotation
    as at 9, since indices differ by at most 4; below, each valence is looked at. Pi is a sum of three projectors
    zeta^k, of which two are orthogonal because a sum of all powers of a root of unity other than 1 vanishes.
    """
    for n in range(3, 10):
        ring = fmpq_mpoly_ctx.get([f"d{i}" for i in range(n)], "degrevlex")
        d = ring.gens()
        at = lambda i: d[i % n]  # noqa: B023, E731
        over = sum((at(i - 1) + at(i + 3)) * at(i + 2) + (at(i - 2) + at(i + 2)) * at(i - 1) for i in range(n))
        if over != sum((at(j) + at(j + 2)) * (at(j - 1) + at(j + 3)) for j in range(n)):
            return False
    return True
