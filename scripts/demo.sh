#!/usr/bin/env bash
# Sets everything up, runs the rain-triggered avalanche of Jiufengershan, and says where the results are.
#
# Usage: scripts/demo.sh [--out DIR] [--disks N] [--full] [--threads T]
#   --out DIR      where the results go (out/jiufengershan of the checkout)
#   --disks N      about how many disks (3000: one or two minutes once built)
#   --full         disks of the paper's sizes, about 21,000 (4 to 9 minutes)
#   --threads T    how many threads (all cores)
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
usage() { sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"; }
fail() { printf 'demo.sh: %s (see --help)\n' "$*" >&2; exit 2; }

out=$root/out/jiufengershan
disks=3000
arguments=()
while [ $# -gt 0 ]; do
    case "$1" in
        -h | --help) usage; exit 0 ;;
        --full) disks=; shift ;;
        --out | --disks | --threads)
            [ $# -ge 2 ] || fail "$1 needs a value"
            case "$1" in
                --out) out=$2 ;;
                --disks) disks=$2 ;;
                --threads) arguments+=(--threads "$2") ;;
            esac
            shift 2 ;;
        *) fail "unknown argument '$1'" ;;
    esac
done
case "$disks" in *[!0-9]*) fail "--disks wants a number, not '$disks'" ;; esac
[ -z "$disks" ] || arguments+=(--disks "$disks")
mkdir -p "$out" 2>/dev/null && [ -w "$out" ] || fail "the results folder $out cannot be written; choose another with --out DIR"
out=$(cd "$out" && pwd)

"$root/scripts/setup.sh"
"$root/scripts/yade-nonsmooth" "$root/scripts/jiufengershan.py" "${arguments[@]}" --out "$out"
printf '\nThe results are in %s\n' "$out"
