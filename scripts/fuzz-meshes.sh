#!/usr/bin/env bash
# A million OBJ, OFF and PLY files with changed, repeated and cut off bytes: an answer or an error for each, no panic, and no
# more than 2 GB of memory. The tests read 256. The first argument is another number of files.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
cargo test --release -p eigenring-surface --test all --no-run
ulimit -v 2000000
export EIGENRING_FUZZ_CASES=${1:-1000000}
cargo test --release -p eigenring-surface --test all -- --test-threads 1 mutilated_files_do_not_panic
