"""One-ring rules at a valence, from exact numbers, closed forms and scheme files."""

import tomllib

from flint import arb, fmpq

from .exact import IDENTITIES, fraction


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
