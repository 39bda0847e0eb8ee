#!/usr/bin/env bash
# usage: scripts/formula-proofs.sh
#
# Families as formula files against the built-in ones, at every valence from 3 to 64: the same statements, statuses,
# margins and enclosures, to the last digit. Tests do it at seven valences. Needs a built command:
#
#     cargo build --release && scripts/formula-proofs.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/help.sh"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
eigenring=$(realpath "${CARGO_TARGET_DIR:-target}/release/eigenring")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# exit code 1 says that something is not proven, which the comparison sees; 2 is a mistake
proofs() { "$eigenring" verify --scheme "$1" -N 3..64 --format json || [[ $? == 1 ]]; }
for family in doo-sabin catmull-clark; do
    "$eigenring" new-scheme --like "$family" -o "$family.toml" 2>/dev/null
    proofs "file:$family.toml" >formulas.json
    proofs "$family" >built-in.json
    cmp formulas.json built-in.json
    count=$(grep -c '"valence"' built-in.json)
    [[ $count == 62 ]] || { echo "$family: $count certificates, and not 62" >&2; exit 1; }
    echo "$family: $count certificates agree; C1 is proven in $(grep -c '^    "status": "proven",$' built-in.json || true)"
done
