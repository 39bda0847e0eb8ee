#!/usr/bin/env bash
# The documentation site in target/site: pages of the repository, references of the commands and of the Python package,
# notebooks, results; links checked.
set -euo pipefail

if [[ "${1:-}" == --help ]]; then
    cat <<'END'
usage: scripts/site.sh

Builds the documentation site in target/site (CARGO_TARGET_DIR names another folder than target) and checks its
links. PYTHON names an interpreter with the package and its extra "site" (pip install '.[site]'), EIGENRING the
command (by default target/release/eigenring). Notebooks are shown with their results where they were executed
into target/notebooks, as .ci/python does. Says SKIPPED where mkdocs is not installed.
END
    exit 0
fi
[[ $# == 0 ]] || {
    printf 'error: unknown argument %s: accepted is --help\n' "$1" >&2
    exit 2
}
cd "$(dirname "${BASH_SOURCE[0]}")/.."
target="${CARGO_TARGET_DIR:-$PWD/target}"
python="${PYTHON:-python3}"
export PYTHONDONTWRITEBYTECODE=1 NO_MKDOCS_2_WARNING=1
"$python" -c "import eigenring, latex2mathml, material, mkdocs, tomllib" 2>/dev/null || {
    printf "SKIPPED: the site needs Python 3.11 or newer with the package and mkdocs: pip install '.[site]', and PYTHON names it\n"
    exit 0
}
"$python" scripts/site/pages.py gather "$target/site-pages"
"$python" -m mkdocs build --quiet --strict --clean --config-file "$target/site-pages/mkdocs.yml"
"$python" scripts/site/pages.py check "$target/site"
printf 'the site is %s\n' "$target/site/index.html"
