#!/usr/bin/env bash
# usage: scripts/starting-points.sh [N]
#
# The table of a valence (5, or the one that is given) tuned from the local minima of the grid and from all its
# points: the same objective at each lambda. The tests have six lambdas of it.
#
# Ends with 1 if a difference is above 1e-6 of the objective; the tables themselves go to a temporary folder, and nothing is
# left behind.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/help.sh"
cd "$(dirname "$0")/.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
for starts in 10x10 full; do
    cargo run --release -q -p eigenring -- tables -N "${1:-5}" --starts "$starts" --out "$out/$starts"
done
python3 - "$out" <<'END'
import csv, sys
grid, full = (list(csv.DictReader(open(f"{sys.argv[1]}/{starts}/lambda/samples.csv"))) for starts in ("10x10", "full"))
assert len(grid) == len(full)
worst = max(abs(float(a["E"]) - float(b["E"])) / float(a["E"]) for a, b in zip(grid, full))
print(f"{len(grid)} lambdas, largest relative difference of E: {worst:.1e}")
sys.exit(worst > 1e-6)
END
