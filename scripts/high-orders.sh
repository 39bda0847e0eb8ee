#!/usr/bin/env bash
# Spectra of all stored sets of orders 11 to 32 and valences 3 to 20 against 60 digits; the tests have those
# that take no more than a few seconds.
set -euo pipefail
cd "$(dirname "$0")/.."
EIGENRING_ALL_ORDERS=1 cargo test --release -p eigenring-spectral --test high_orders
