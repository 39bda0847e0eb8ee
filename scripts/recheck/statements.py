"""The status of each statement of a certificate, derived from the rules."""

from flint import arb, fmpq

from .maps import bezier, characteristic_net, jacobian, signs, turn
from .spectrum import Spectrum, largest

PROVEN, REFUTED, UNDECIDED = "proven", "refuted", "undecided"


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
