#!/usr/bin/env bash
# Builds the solver, the collider, packing and the bindings with AddressSanitizer and UndefinedBehaviorSanitizer and runs their tests, then the strip schedule with
# ThreadSanitizer. Nothing of YADE. Any report ends it with a status that is not 0.
# Usage: tests/sanitizers/run.sh BUILD   with BUILD a folder of its own, kept for the next time
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
[ $# -eq 1 ] || { sed -n '2,4s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
build=$1
export PATH=/usr/bin:/bin:/usr/sbin
compiler=${CXX:-g++}
flags="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all"

# -O1 is fast enough and keeps what the optimiser would take away; as many at a time as there are processors
cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$flags" -DNONSMOOTH_PLUGIN=OFF \
    -DNONSMOOTH_BENCHMARKS=OFF -DNONSMOOTH_CHECKS=OFF -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=OFF >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
ninja -C "$build" contact_tests nonsmooth_contact_module nonsmooth_slip_module nonsmooth_packing_module >"$build.log" 2>&1 || { tail -n 40 "$build.log"; exit 1; }

export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:abort_on_error=0 UBSAN_OPTIONS=print_stacktrace=1
echo "== solver, collider and packing: AddressSanitizer and UndefinedBehaviorSanitizer"
"$build/contact_tests" --gtest_brief=1

echo "== bindings: the same, in Python"
# the interpreter is not built with them, so their library comes first, and with it the C++ library whose exceptions it watches; Python itself leaves memory
preload="$("$compiler" -print-file-name=libasan.so) $("$compiler" -print-file-name=libstdc++.so.6)"
run_python() { env LD_PRELOAD="$preload" ASAN_OPTIONS="$ASAN_OPTIONS:detect_leaks=0" PYTHONPATH="$build/python" NONSMOOTH_FUZZ=60 /usr/bin/python3 "$@"; }
run_python -m pytest -q -p no:cacheprovider "$root/tests/bindings"
if /usr/bin/python3 -c "import hypothesis, h5py" 2>/dev/null; then
    run_python -m pytest -q -p no:cacheprovider "$root/tests/fuzz/test_problem_files.py"
else
    echo "python3-hypothesis or python3-h5py is not there: without damaged files"
fi

echo "== strip schedule: ThreadSanitizer"
"$compiler" -std=c++17 -O1 -g -fsanitize=thread -I"$root/pkg" "$root/tests/sanitizers/schedule_threads.cpp" "$root/pkg/contact/core/strip_schedule.cpp" \
    -pthread -o "$build/schedule_threads"
TSAN_OPTIONS=halt_on_error=1 "$build/schedule_threads"
echo "No sanitizer had anything to say."
