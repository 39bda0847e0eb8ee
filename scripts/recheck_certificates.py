#!/usr/bin/env python3
"""Checks stored certificates of one-ring schemes again, by other arithmetic and other algorithms.

Written from docs/certificates.md alone; shares no code with the program. Numbers are balls of Arb (python-flint)
at --precision bits, rational numbers and polynomials where something is an equality. The evidence inside a
certificate is not read: each status is derived here from the scheme and the valence, and compared.

Covered: Catmull-Clark, members of the lambda-scheme, and one-ring scheme files with numbers as weights; Catmull-Clark
and Doo-Sabin at all valences from one on; the
statements row_sums, hull, dominant, subdominant, regular, injective, bounded_curvature, non_degenerate, strict
and corner, with the numbers beside them. With knot intervals: HNUSS around a vertex, and for every valence and all
positive intervals, by its lemmas in exact numbers; NURSS and eigen-polyhedra, of which nothing is proven. Not covered,
and counted as such: gauss, other schemes, and certificates of ranges, of which --samples members are checked one by
one, which is no proof of a range.

Exit code 0: all that is covered agrees. 1: something differs, or is proven there and undecided here. 2: bad input.

  recheck_certificates.py                              results/certificates of the repository
  recheck_certificates.py N005.json my-folder          these
  recheck_certificates.py --self-test                  planted faults must not be proven
"""

import argparse
import json
import sys
from pathlib import Path

from recheck import BadInput

try:
    from flint import ctx

    from recheck.certificates import check
    from recheck.exact import IDENTITIES
    from recheck.faults import self_test
    from recheck.intervals import check as check_intervals
    from recheck.ranges import check_ranges
    from recheck.valences import check as check_valences
except ModuleNotFoundError as missing:
    # the help can be read without it
    if missing.name != "flint":
        raise
    ctx = None


def files_of(paths):
    for path in map(Path, paths):
        if path.is_dir():
            yield from sorted(path.rglob("*.json"))
        elif path.is_file():
            yield path
        else:
            raise BadInput(f"{path}: accepted is a certificate or a folder of them")


def main():
    usage = __doc__.split("\n\n", 1)
    parser = argparse.ArgumentParser(
        description=usage[0], epilog=usage[1], formatter_class=argparse.RawDescriptionHelpFormatter
    )
    results = Path(__file__).resolve().parent.parent / "results"
    parser.add_argument("paths", nargs="*", help="certificates, or folders of them")
    parser.add_argument("--precision", type=int, default=200, help="bits of the balls, 64 to 10000; by default 200")
    parser.add_argument("--self-test", action="store_true", help="check planted faults instead of certificates")
    parser.add_argument(
        "--samples", type=int, default=3, help="members looked at in each interval of the ranges, 0 to 1000; by default 3"
    )
    parser.add_argument("--quiet", action="store_true", help="only differences and the summary")
    arguments = parser.parse_args()
    if ctx is None:
        raise BadInput("python-flint is not installed: accepted is 'pip install python-flint'")
    if not 64 <= arguments.precision <= 10000:
        raise BadInput(f"--precision {arguments.precision}: accepted are 64 to 10000")
    if not 0 <= arguments.samples <= 1000:
        raise BadInput(f"--samples {arguments.samples}: accepted are 0 to 1000")
    ctx.prec = arguments.precision
    if not IDENTITIES:
        print("the closed forms of the lambda-scheme do not hold as identities")
        return 1
    if arguments.self_test:
        return 0 if self_test() else 1
    agree = differ = compared = 0
    left = {}
    for path in files_of(arguments.paths or [results / "certificates"]):
        try:
            document = json.loads(path.read_text())
            if "bernstein" in document:
                differences, count, reason = check_intervals(document)
            elif "from" in document:
                differences, count, reason = check_valences(document)
            elif "checks" not in document or "input" not in document:
                left["a range of parameters"] = left.get("a range of parameters", 0) + 1
                continue
            else:
                differences, count, reason = check(document)
        except (KeyError, TypeError, ValueError) as error:
            raise BadInput(f"{path}: {error}: accepted is a certificate of 'eigenring verify -o'") from error
        if reason:
            left[reason] = left.get(reason, 0) + 1
            continue
        compared += count
        agree, differ = (agree, differ + 1) if differences else (agree + 1, differ)
        for difference in differences:
            print(f"{path.parent.name}/{path.name}: {difference}")
        if not differences and not arguments.quiet:
            print(f"{path.parent.name}/{path.name}: {count} statements agree")
    print(f"{agree} certificates agree ({compared} statements), {differ} differ")
    for reason, count in left.items():
        print(f"{count} not covered: {reason}")
    if not arguments.paths and arguments.samples:
        differences, count = check_ranges(results / "certificates" / "ranges.csv", results, arguments.samples)
        for difference in differences:
            print(difference)
        print(f"{count} statuses of members of the ranges looked at, {len(differences)} differ")
        differ += len(differences)
    if agree + differ == 0:
        raise BadInput("no certificate is covered")
    return 1 if differ else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
