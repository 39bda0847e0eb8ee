#!/usr/bin/env bash
# Lemma 1 on HNUSS on 10^5 sets of knot intervals, with the smallest gap for each ratio.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
cargo test --release -p eigenring-nonuniform --test all lemma_1_on_many_sets -- --ignored --nocapture
