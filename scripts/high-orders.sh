#!/usr/bin/env bash
# usage: scripts/high-orders.sh
#
# Spectra of all stored sets of orders 11 to 32 and valences 3 to 20 against 60 digits; the tests have those
# that take no more than a few seconds. The digits are in tests/data/high_orders.txt, and were found by a program of
# their own, tests/data/high_orders.py, which has Arb's balls do the linear algebra.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/help.sh"
cd "$(dirname "$0")/.."
EIGENRING_ALL_ORDERS=1 cargo test --release -p eigenring-spectral --test high_orders
