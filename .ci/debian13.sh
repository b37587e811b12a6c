#!/usr/bin/env bash
# Holds what the documentation promises of Debian 13: builds the plugin for the stock YADE in a root of that release, runs the solver's tests,
# the documentation and the fast tests in YADE there, and compares a slope with that of this machine, byte by byte.
#
# Usage: .ci/debian13.sh [COMMAND [ARGUMENTS]]   with a command: runs only that in the root, in this checkout (read-only, at /checkout)
#
# The root lies in the cache (about 4 GB) and is made once. It is mounted into by a namespace of its own, so that no mount is left behind,
# however this ends. Where no root can be made, one line says that Debian 13 was not tried, and the status is 0.
set -euo pipefail

ROOT=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
. "$ROOT/scripts/setup/common.sh"
. "$ROOT/scripts/setup/packages.sh"
. "$ROOT/scripts/setup/yade.sh"

SUITE=trixie
root=$(cache_dir)/debian13
# tests in YADE that take seconds and go through every engine, the packing and the readers
FAST=(test_load test_contact_law test_bonds test_engine test_positions test_pinned_rows test_collider test_view test_pore_pressure test_section test_packing test_worlds)
DISKS=600

not_tried() { printf '\n!! Debian 13 was NOT tried: %s\n' "$*" >&2; exit 0; }

make_root() {
    local mirror
    mirror=$(yade_mirror)
    [ -n "$mirror" ] || not_tried "apt on this machine names no Debian mirror"
    say "Making a root of Debian 13 once, in the cache"
    rm -rf --one-file-system "$root.part"
    mmdebstrap --quiet --variant=minbase --include=ca-certificates,ccache "$SUITE" "$root.part" "$mirror" ||
        not_tried "mmdebstrap could not make a root from this machine's mirror (see above)"
    echo force-unsafe-io >"$root.part/etc/dpkg/dpkg.cfg.d/unsafe-io" # a root that can be made again need not survive a power cut
    mkdir -p "$root.part/checkout" "$root.part/results"
    rm -rf --one-file-system "$root"
    mv "$root.part" "$root"
}

# Runs a command in the root; all mounts go with its namespace.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --fork --kill-child --propagation private bash -euc '
        root=$1; checkout=$2; shift 2
        mount --bind "$checkout" "$root/checkout"
        mount -o remount,bind,ro "$root/checkout"
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount -t tmpfs tmpfs "$root/tmp"
        cp -L /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
        exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM="${TERM:-dumb}" NONSMOOTH_BUILD=/build CCACHE_DIR=/root/ccache \
            CMAKE_CXX_COMPILER_LAUNCHER=ccache chroot "$root" sh -c "cd /checkout && exec \"\$@\"" sh "$@"' bash "$root" "$ROOT" "$@"
}

[ "$(id -u)" -eq 0 ] || not_tried "a root of another release needs root"
command -v mmdebstrap >/dev/null 2>&1 || (packages_install mmdebstrap) || not_tried "there is no mmdebstrap, and apt cannot install it"
unshare --mount --pid --fork true 2>/dev/null || not_tried "this machine allows no mounts in a namespace of their own"
mkdir -p "$(cache_dir)"
exec 8>"$(cache_dir)/debian13.lock"
flock 8
[ -d "$root" ] || make_root

if [ $# -gt 0 ]; then inside "$@"; exit; fi

start=$SECONDS status=0
inside scripts/setup.sh --tests
say "Debian 13: the solver's tests and the documentation"
inside env CTEST_OUTPUT_ON_FAILURE=1 ctest --test-dir /build -L '^(contact|doc)$' -j "$(nproc)" --no-tests=error --progress || status=1
say "Debian 13: tests in YADE"
mapfile -t files < <(cd "$ROOT" && for name in "${FAST[@]}"; do find tests/yade -name "$name.py"; done)
[ "${#files[@]}" -eq "${#FAST[@]}" ] || { echo "FAST names a file of tests that is not there" >&2; status=1; }
inside scripts/yade-nonsmooth tests/yade/run_pytest.py "${files[@]}" || status=1

say "The same bits on both: a slope of $DISKS disks"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
rm -rf "$root/results/slope"
XDG_CACHE_HOME=$here "$ROOT/scripts/yade-nonsmooth" "$ROOT/scripts/jiufengershan.py" --no-figures --disks "$DISKS" --out "$here/slope" >"$here/log" 2>&1 ||
    { tail -n 20 "$here/log" >&2; status=1; }
inside env XDG_CACHE_HOME=/tmp scripts/yade-nonsmooth scripts/jiufengershan.py --no-figures --disks "$DISKS" --out /results/slope >"$here/log" 2>&1 ||
    { tail -n 20 "$here/log" >&2; status=1; }
for file in series.csv breaks.csv; do
    if cmp "$here/slope/$file" "$root/results/slope/$file"; then note "$file: the same bytes"; else status=1; fi
done

note "Debian 13 took $((SECONDS - start)) s"
if [ "$status" -eq 0 ]; then echo "Debian 13: all passed."; else echo "Debian 13: something FAILED (see above)."; fi
exit "$status"
