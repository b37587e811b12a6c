#!/usr/bin/env bash
# Formats the sources: C++ by clang-format 14, Python by black 23, as Debian 12 has them; lines of 120 at most. With --check nothing is changed, and
# the status is 1 where something would be; 77 where these versions are not there.
# Usage: scripts/format.sh [--check]
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
check=${1:-}
case "$check" in '' | --check) ;; *) sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}"; [ "$check" = --help ]; exit ;; esac

missing() { echo "not formatted: $1 is not there (apt install ${1%% *} on Debian 12)" >&2; exit 77; }
case "$(clang-format --version 2>/dev/null)" in *"version 14."*) ;; *) missing "clang-format 14" ;; esac
case "$(black --version 2>/dev/null)" in "black, 23."*) ;; *) missing "black 23" ;; esac

sources() { find "$@" -type f -not -path '*/__pycache__/*' -print0 | sort -z; }
mapfile -d '' cpp < <(sources pkg tests \( -name "*.hpp" -o -name "*.cpp" -o -name "*.tpp" \))
# not what pages print as it is, nor the tables of mutants
mapfile -d '' python < <(sources py scripts tests cmake doc/ext doc/conf.py -name '*.py' -not -path 'scripts/examples/*' -not -path 'tests/mutants/mutants/*')
status=0
if [ "$check" ]; then how=(--dry-run -Werror); else how=(-i); fi
clang-format "${how[@]}" "${cpp[@]}" || status=1
black --quiet ${check:+--check} --skip-magic-trailing-comma --line-length 120 "${python[@]}" || status=1
[ "$status" -eq 0 ] || echo "run scripts/format.sh" >&2
exit "$status"
