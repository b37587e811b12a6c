#!/usr/bin/env bash
# Sets everything up: Debian packages, YADE, the plugin. Can be called again at any time; what is there
# already is left alone. Usage: scripts/setup.sh [--tests] [--notebooks]
#
#   --tests               also what the tests and the documentation need; scripts/test.sh asks for it
#   --notebooks           also the programs that show notebooks (Debian's jupyter-notebook), see doc/notebooks.rst
#
#   YADE_TARBALL=FILE     the source tarball of YADE, where the Debian mirror does not serve it
#   YADE_PREFIX=FOLDER    a YADE install to use instead of the one that would be chosen
#   NONSMOOTH_BUILD=DIR   the build folder (build/ of the checkout)
set -euo pipefail

ROOT=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
for step in common packages yade estimate build; do
    # shellcheck source=/dev/null
    . "$ROOT/scripts/setup/$step.sh"
done

if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "$0"
    exit 0
fi
tests='' notebooks=''
for argument in "$@"; do
    case "$argument" in
        --tests) tests=yes ;;
        --notebooks) notebooks=yes ;;
        *) die "setup.sh takes no arguments but --tests and --notebooks, and was given: $*" ;;
    esac
done

# one set-up at a time: checkouts share the cache
mkdir -p "$(cache_dir)" || die "the cache folder $(cache_dir) cannot be made"
exec 9>"$(cache_dir)/lock"
flock -n 9 || { note "waiting for another set-up to end"; flock 9; }

setup_estimate
packages_install "${PACKAGES_PROJECT[@]}" ${tests:+"${PACKAGES_TESTS[@]}"} ${notebooks:+"${PACKAGES_NOTEBOOKS[@]}"}
[ -z "$tests" ] || packages_install_known "${PACKAGES_ORACLE[@]}"
yade_provide
plugin_build
note "YADE in $YADE_PREFIX, plugin in $BUILD: run scripts with scripts/yade-nonsmooth SCRIPT"
if [ -n "$notebooks" ]; then note "notebooks: PYTHONPATH=$ROOT/py jupyter notebook $ROOT/doc/notebooks"; fi
