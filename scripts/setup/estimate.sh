# Says before anything begins how long a first set-up takes: minutes on two cores, seen on bare Debian 12 and 13.
# shellcheck shell=bash

setup_estimate() {
    local low=0 high=0 parts=() python=yes
    [ -x /usr/bin/python3 ] || python=
    if [ -n "$(packages_missing "${PACKAGES_PROJECT[@]}" ${tests:+"${PACKAGES_TESTS[@]}"} ${notebooks:+"${PACKAGES_NOTEBOOKS[@]}"})" ]; then low=2 high=8 parts+=("Debian packages"); fi
    # on a bare system apt has no lists yet, and the release tells
    if [ -z "${YADE_PREFIX:-}" ] && ! yade_stock_fits && ! grep -qs '^VERSION_CODENAME=trixie' /etc/os-release; then
        if [ -z "$python" ] || [ ! -f "$(yade_slim_prefix)/.complete" ]; then low=$((low + 12)) high=$((high + 20)) parts+=("a slim YADE"); fi
    fi
    if [ ! -f "${NONSMOOTH_BUILD:-$ROOT/build}/build.ninja" ]; then low=$((low + 3)) high=$((high + 5)) parts+=("the plugin"); fi
    [ "${#parts[@]}" -gt 0 ] || return 0
    say "Setting up, $low to $high minutes on two cores: $(printf '%s, ' "${parts[@]}" | sed 's/, $//')"
}
