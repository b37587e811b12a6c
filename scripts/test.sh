#!/usr/bin/env bash
# Sets everything up and runs every test: the solver's, those in YADE, and the documentation's.
# Usage: scripts/test.sh [PYTEST ARGUMENTS]   with arguments, only the tests in YADE, e.g. -k segment
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
if [ "${1:-}" = --help ]; then sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}"; exit 0; fi

"$root/scripts/setup.sh" --tests
export NONSMOOTH_BUILD=${NONSMOOTH_BUILD:-$root/build}
if [ $# -gt 0 ]; then
    exec "$root/scripts/yade-nonsmooth" "$root/tests/yade/run_pytest.py" "$@"
fi

export PATH=/usr/bin:/bin:/usr/sbin CTEST_OUTPUT_ON_FAILURE=1
status=0
# The tests in YADE last and talking: they take longest, and their summary is what one wants to see.
ctest --test-dir "$NONSMOOTH_BUILD" -LE '^yade$' -j "$(nproc)" --no-tests=ignore --progress || status=1
ctest --test-dir "$NONSMOOTH_BUILD" -L '^yade$' -j "$(nproc)" --no-tests=error --verbose || status=1
# the last line says what nothing was held against (tests/yade/oracles.py: in CI that is an error)
without=
[ -x "$NONSMOOTH_BUILD/oracle/siconos_solve" ] || without=" NOT HELD: Siconos was not asked, its kept answers alone were (install libsiconos-numerics-dev)."
if [ "$status" -eq 0 ]; then echo "All tests passed.$without"; else echo "Some tests FAILED (see above).$without"; fi
exit "$status"
