"""Certificates: their schemes, and what differs from what is derived."""

from flint import arb

from . import BadInput
from .exact import fraction
from .schemes import OneRing, one_ring_file
from .statements import PROVEN, UNDECIDED, statements


def rules_of(document):
    """The scheme of a certificate; None with a reason if it is not covered."""
    kind = document["input"]
    valence = document["valence"]
    if not isinstance(valence, int) or not 3 <= valence <= 1000:
        raise BadInput(f"valence {valence}: accepted are 3 to 1000")
    if "family" in kind and kind["family"] == {"spec": "catmull-clark"}:
        return OneRing.catmull_clark(valence), ""
    if "lambda" in kind:
        plane = kind["lambda"]
        lam, s, f2 = (fraction(plane[name]) for name in ("lambda", "s", "f2"))
        f3 = None if plane["f3"] is None else fraction(plane["f3"])
        if (f3 is None) != (valence == 4):
            raise BadInput("f3 is given exactly where the valence is not 4")
        return OneRing.lambda_member(valence, lam, s, f2, f3), ""
    if "file" in kind and "text" in kind["file"]:
        return one_ring_file(kind["file"]["text"], valence)
    return None, "no one-ring scheme that is known here"



def encloses(interval, ball):
    """Whether a stored interval and a ball have a common point: both hold the number."""
    low, high = interval
    return low is None or high is None or not (ball < arb(low) or ball > arb(high))


def check(document):
    """Differences between a certificate and what is derived here, and how many statements were compared."""
    rules, reason = rules_of(document)
    if rules is None:
        return [], 0, reason
    derived, differences, compared = statements(rules), [], 0
    for claim in document["checks"]:
        name, status = claim["name"], claim["status"]
        if name not in derived:
            continue
        compared += 1
        found = derived[name]
        if status == found.status:
            stored = claim.get("enclosure")
            if status == PROVEN and stored and found.value is not None and not encloses(stored, found.value):
                differences.append(f"{name}: {stored} does not hold {found.value}")
        elif status == UNDECIDED:
            differences.append(f"{name}: undecided there, {found.status} here")
        else:
            differences.append(f"{name}: {status} there, {found.status} here")
    return differences, compared, ""
