#!/usr/bin/env bash
# Lemma 1 on HNUSS on 10^5 sets of knot intervals, with the smallest gap for each ratio; the tests have 3600.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export EIGENRING_LEMMA_1_SETS=20000
cargo test --release -p eigenring-nonuniform --test all the_ngon_has_the_spectrum_of_lemma_1 -- --nocapture
