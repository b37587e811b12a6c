# Configures and builds the plugin in the build folder of the checkout, and its tests where they were asked for, now or earlier.
# Needs ROOT, YADE_PREFIX and YADE_HEADERS, and "tests" if they are asked for; sets BUILD.
# shellcheck shell=bash

plugin_build() {
    local start=$SECONDS
    BUILD=${NONSMOOTH_BUILD:-$ROOT/build}
    mkdir -p "$BUILD" || die "the build folder $BUILD cannot be made"
    if grep -qs '^NONSMOOTH_TESTS:BOOL=ON' "$BUILD/CMakeCache.txt"; then tests=yes; fi
    # a build folder that was moved, or that knew another YADE or python, is configured afresh
    if ! plugin_configure && ! plugin_configure --fresh; then
        tail -n 30 "$BUILD/configure.log" >&2
        die "the plugin could not be configured; the whole log is $BUILD/configure.log"
    fi
    say "Building the plugin, as far as something changed (the first time $(plugin_minutes) minutes on two cores)"
    if ! (set -o pipefail; PATH=/usr/bin:/bin:/usr/sbin NINJA_STATUS='[%f/%t] ' ninja -C "$BUILD" 2>&1 | ninja_progress "$BUILD/build.log"); then
        grep -E -A12 'error|FAILED' "$BUILD/build.log" | head -n 60 >&2
        die "the plugin could not be built; the whole log is $BUILD/build.log"
    fi
    note "the plugin is ready after $((SECONDS - start)) s"
}

# How long the first build takes on two cores.
plugin_minutes() { if [ -n "${tests:-}" ]; then echo "3 to 5"; else echo "2 to 3"; fi; }

# /usr/bin first: no cmake or python of pyenv or conda
plugin_configure() {
    local with=OFF
    [ -z "${tests:-}" ] || with=ON
    PATH=/usr/bin:/bin:/usr/sbin cmake "$@" -G Ninja -S "$ROOT" -B "$BUILD" \
        "-DYADE_PREFIX=$YADE_PREFIX" "-DYADE_HEADERS=$YADE_HEADERS" \
        "-DNONSMOOTH_TESTS=$with" "-DNONSMOOTH_BENCHMARKS=$with" >"$BUILD/configure.log" 2>&1
}
