"""Planted faults, which must not be proven."""

from math import inf, nextafter

from flint import fmpq

from .certificates import check
from .exact import fraction
from .interval_faults import self_test as interval_self_test
from .schemes import OneRing
from .statements import PROVEN, REFUTED, UNDECIDED, statements
from .valences import SAMPLED, CatmullClark, DooSabin, prove, sampled


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
        (
            "a Jordan block at lambda^2",
            planted(4, "0", "3/8", "1/4", "1/4", "1/2", "1/8", "0", "1/2", "0"),
            "bounded_curvature",
            UNDECIDED,
        ),
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
    # all valences: each weight off by a thousandth, and what is proven of all at twenty of them, one by one
    off = fmpq(1, 1000)
    for name, weight in CatmullClark().weights.items():
        proven = prove(CatmullClark(**{name: weight + off}))[0]
        good &= not proven
        print(f"{'BAD' if proven else 'ok '}  all valences, {name} off by 1e-3: {'proven' if proven else 'not proven'}")
    for what, scheme in (("Catmull-Clark", CatmullClark()), ("Doo-Sabin", DooSabin())):
        proven, _, count = prove(scheme)
        good &= proven
        print(f"{'ok ' if proven else 'BAD'}  all valences, {what}: {'C1' if proven else 'not proven'} on {count} intervals")
    slow = prove(DooSabin(first=fmpq(2, 5)))[0]
    good &= not slow
    print(f"{'BAD' if slow else 'ok '}  all valences, an outer eigenvalue above lambda: {'proven' if slow else 'not proven'}")
    apart = [valence for valence in SAMPLED if not sampled(valence)]
    good &= not apart
    print(f"{'BAD' if apart else 'ok '}  all valences, Catmull-Clark at {len(SAMPLED)} valences up to {SAMPLED[-1]}: {apart or 'agrees'}")
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
    return interval_self_test() and good
