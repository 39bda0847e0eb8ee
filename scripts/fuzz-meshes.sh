#!/usr/bin/env bash
# usage: scripts/fuzz-meshes.sh [FILES]
#
# A million OBJ, OFF and PLY files, or as many as are given, with changed, repeated and cut off bytes: an answer or an error
# for each, no panic, and no more than 2 GB of memory. The tests read 256; this runs the same test with
# EIGENRING_FUZZ_CASES set, on one thread.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/help.sh"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
cargo test --release -p eigenring-surface --test all --no-run
ulimit -v 2000000
export EIGENRING_FUZZ_CASES=${1:-1000000}
cargo test --release -p eigenring-surface --test all -- --test-threads 1 mutilated_files_do_not_panic
