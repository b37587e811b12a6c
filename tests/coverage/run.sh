#!/usr/bin/env bash
# Which lines and branches the tests reach: of the C++ by gcovr, of the Python by coverage.py, also inside YADE and in processes that tests start.
# A number to look for holes with, not to reach: what a test reaches it need not hold (tests/mutants).
#
# Usage: tests/coverage/run.sh BUILD [PYTEST ARGUMENTS]
#   BUILD is the build folder of the checkout; tables are printed, pages with each line written to BUILD/coverage/{cpp,python}/index.html.
#   With arguments only these tests run in YADE. Takes as long as scripts/test.sh and another build.
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
[ $# -ge 1 ] && [ -f "$1/CMakeCache.txt" ] || { sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
main=$(cd "$1" && pwd); shift
work=$main/coverage build=$main/coverage/build
export PATH=/usr/bin:/bin:/usr/sbin
command -v gcovr >/dev/null && /usr/bin/python3 -c "import coverage" 2>/dev/null || { echo "install gcovr and python3-coverage first" >&2; exit 2; }
mkdir -p "$work"

known() { sed -n "s/^$1:[A-Z]*=//p" "$main/CMakeCache.txt"; }
# -O1 and nothing inlined, so that lines count where they are written
cmake -G Ninja -S "$root" -B "$build" -DYADE_PREFIX="$(known YADE_PREFIX)" -DYADE_HEADERS="$(known YADE_HEADERS)" -DCMAKE_BUILD_TYPE=Coverage \
    -DCMAKE_CXX_FLAGS_COVERAGE="-O1 -fno-inline --coverage -fprofile-update=atomic -include $root/tests/coverage/dump.hpp" -DCMAKE_SHARED_LINKER_FLAGS_COVERAGE=--coverage \
    -DCMAKE_MODULE_LINKER_FLAGS_COVERAGE=--coverage -DCMAKE_EXE_LINKER_FLAGS_COVERAGE=--coverage -DNONSMOOTH_BENCHMARKS=OFF -DNONSMOOTH_CHECKS=OFF \
    >"$work/build.log" 2>&1 || { cat "$work/build.log"; exit 1; }
ninja -C "$build" >"$work/build.log" 2>&1 || { tail -n 40 "$work/build.log"; exit 1; }
find "$build" -name '*.gcda' -delete

cat >"$work/settings" <<SETTINGS
[run]
branch = True
parallel = True
source = $root/py/nonsmooth
         $root/scripts
data_file = $work/data/python
[paths]
package = $root/py/nonsmooth
          */yade/nonsmooth
[report]
skip_covered = True
SETTINGS
rm -rf "$work/data"; mkdir -p "$work/data"
export COVERAGE_PROCESS_START=$work/settings NONSMOOTH_BUILD=$build
status=0
"$build/contact_tests" --gtest_brief=1 || status=1
export PYTHONPATH=$root/tests/coverage:$build/python
if [ $# -eq 0 ]; then
    /usr/bin/python3 -m pytest -q -p no:cacheprovider "$root/tests/bindings" "$root/tests/fuzz" || status=1
fi
PYTHONPATH=$root/tests/coverage "$root/scripts/yade-nonsmooth" "$root/tests/yade/run_pytest.py" -q "$@" || status=1

unset COVERAGE_PROCESS_START PYTHONPATH
python() { /usr/bin/python3 -m coverage "$@" --rcfile="$work/settings"; }
python combine -q
python html -q -d "$work/python"
python report
mkdir -p "$work/cpp"
gcovr -r "$root" --object-directory "$build" --filter "$root/pkg/" --exclude-throw-branches --html-details "$work/cpp/index.html" --print-summary "$build"
echo "Line by line: $work/cpp/index.html, $work/python/index.html"
exit "$status"
