#!/usr/bin/env bash
# Builds the engines with AddressSanitizer and runs random programs (tests/yade/random_programs.py) under it. Any report about the engines ends it with a status that
# is not 0; what YADE and Python keep to the end is theirs, and is not asked for.
# Usage: tests/sanitizers/programs.sh BUILD [PROGRAMS [FIRST]]   with BUILD a folder of its own, kept for the next time; PROGRAMS: 100
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
[ $# -ge 1 ] || { sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
build=$1
export PATH=/usr/bin:/bin:/usr/sbin
compiler=${CXX:-g++}
known() { sed -n "s/^$1:[A-Z]*=//p" "$root/build/CMakeCache.txt"; }
[ -r "$root/build/CMakeCache.txt" ] || { echo "build the plugin first: scripts/setup.sh --tests" >&2; exit 1; }

cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="-O1 -g1 -fno-omit-frame-pointer -fsanitize=address" -DYADE_PREFIX="$(known YADE_PREFIX)" -DYADE_HEADERS="$(known YADE_HEADERS)" \
    -DNONSMOOTH_BENCHMARKS=OFF -DNONSMOOTH_CHECKS=OFF -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=OFF >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
ninja -C "$build" >"$build.log" 2>&1 || { tail -n 40 "$build.log"; exit 1; }

# the interpreter is not built with it, so its library comes first, and with it the C++ library whose exceptions it watches
preload="$("$compiler" -print-file-name=libasan.so) $("$compiler" -print-file-name=libstdc++.so.6)"
# YADE throws and catches exceptions across libraries that are not built with it, and its allocations end by other names than they began with
options=detect_leaks=0:abort_on_error=0:exitcode=99:alloc_dealloc_mismatch=0:detect_odr_violation=0
env LD_PRELOAD="$preload" ASAN_OPTIONS="$options" GLIBC_TUNABLES= /usr/bin/python3 "$build/prefix/bin/yade" -n -x -j2 \
    "$root/tests/yade/random_programs.py" --programs "${2:-100}" --first "${3:-0}"
