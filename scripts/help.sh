# Sourced by scripts, after their comment: --help prints that comment, and other options are refused.
case "${1:-}" in
--help)
    sed -n '2,${/^#/!q;s/^# \{0,1\}//p}' "${BASH_SOURCE[1]}"
    exit
    ;;
-*)
    echo "unknown option $1: see $(basename "${BASH_SOURCE[1]}") --help" >&2
    exit 2
    ;;
esac
