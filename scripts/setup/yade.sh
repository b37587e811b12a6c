# Provides YADE: an installed one with headers of its version, or a slim build kept in the cache.
# Sets YADE_PREFIX (the install) and YADE_HEADERS (its headers) for the build step.
# shellcheck shell=bash

YADE_VERSION=2025.2.0
YADE_SHA256=42702372251bf5e8f07a364bdf30533a1318947e4db90435b1f89293dc029156
YADE_SUITE=trixie   # the Debian release whose sources hold this version

YADE_OPTIONS=(
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=12
    -DDISABLE_ALL=ON -DENABLE_OPENMP=ON -DENABLE_VTK=ON -DENABLE_LOGGER=ON
    -DDISABLE_PKGS=fem,lbm,levelSet,pfv,potential,polyhedra,openfoam,image
    -DDISABLE_SAVE_TEMPS=1 -DNOSUFFIX=1 -DSUFFIX=)
YADE_SHORTENING=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../cmake" && pwd)/YadeSlim.cmake   # has part in the cache's key by what it says, not by where it stands

# The address of the machine's own Debian mirror.
yade_mirror() {
    apt-get indextargets --format '$(REPO_URI) $(ORIGIN) $(LABEL)' 'Created-By: Packages' |
        awk '$2 == "Debian" && $3 == "Debian" { print $1; exit }'
}

yade_checked() { printf '%s  %s\n' "$YADE_SHA256" "$1" | sha256sum --check --status; }

# Prints the path of the verified source tarball, fetching it where needed.
yade_tarball() {
    local file work mirror uri apt helper
    if [ -n "${YADE_TARBALL:-}" ]; then
        [ -r "$YADE_TARBALL" ] || die "YADE_TARBALL=$YADE_TARBALL cannot be read"
        yade_checked "$YADE_TARBALL" || die "YADE_TARBALL=$YADE_TARBALL is not YADE $YADE_VERSION (its SHA-256 is not $YADE_SHA256)"
        printf '%s\n' "$YADE_TARBALL"; return
    fi
    file=$(cache_dir)/yade_$YADE_VERSION.orig.tar.bz2
    if [ -f "$file" ] && yade_checked "$file"; then printf '%s\n' "$file"; return; fi

    mirror=$(yade_mirror)
    [ -n "$mirror" ] || die "apt on this machine names no Debian mirror: download yade_$YADE_VERSION.orig.tar.bz2 yourself and call again with YADE_TARBALL=/path/to/it"
    note "fetching the sources of YADE $YADE_VERSION (14 MB)"
    work=$(mktemp -d)
    mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$(cache_dir)"
    printf 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' "$mirror" "$YADE_SUITE" >"$work/source.list"
    apt=(-o "Dir::Etc::SourceList=$work/source.list" -o Dir::Etc::SourceParts=/dev/null
         -o "Dir::State::Lists=$work/lists" -o "Dir::Cache=$work/cache" -o APT::Sandbox::User=)
    apt-get "${apt[@]}" -qq update >&2 || die "the mirror does not serve the sources of $YADE_SUITE: get yade_$YADE_VERSION.orig.tar.bz2 yourself and call again with YADE_TARBALL=/path/to/it"
    uri=$(apt-get "${apt[@]}" source --print-uris "yade=$YADE_VERSION-1" 2>/dev/null |
        awk -F"'" '/orig\.tar\.bz2\x27/ { print $2; exit }')
    helper=/usr/lib/apt/apt-helper
    { [ -n "$uri" ] && "$helper" "${apt[@]}" download-file "$uri" "$file.part" "SHA256:$YADE_SHA256" >&2; } ||
        die "the mirror does not serve yade_$YADE_VERSION.orig.tar.bz2: get it yourself and call again with YADE_TARBALL=/path/to/it"
    yade_checked "$file.part" || die "the downloaded $file.part has a wrong SHA-256; remove it and try again"
    mv "$file.part" "$file"; rm -rf "$work"
    printf '%s\n' "$file"
}

# Prints the folder of the unpacked sources, which hold core/, lib/ and pkg/ as the headers include them.
yade_sources() {
    local folder tarball
    folder=$(cache_dir)/yade-$YADE_VERSION-source
    if [ ! -f "$folder/CMakeLists.txt" ]; then
        tarball=$(yade_tarball) || exit 1
        rm -rf "$folder.part"; mkdir -p "$folder.part"
        tar -xjf "$tarball" -C "$folder.part" --strip-components=1 || die "$tarball cannot be unpacked"
        rm -rf "$folder"; mv "$folder.part" "$folder"
    fi
    printf '%s\n' "$folder"
}

yade_python() { /usr/bin/python3 -c 'import sys; print("%d.%d" % sys.version_info[:2])'; }

# Where the slim YADE is or will be.
yade_slim_prefix() {
    local key
    key=$(printf '%s\n' "$YADE_VERSION" "$(yade_python)" "${YADE_OPTIONS[@]}" "$(cat "$YADE_SHORTENING")" | sha256sum | cut -c1-10)
    printf '%s/yade-%s-%s\n' "$(cache_dir)" "$YADE_VERSION" "$key"
}

# How many files of the slim YADE are compiled at a time: one a core, where memory holds them (4 GB each).
yade_jobs() {
    local cores fit
    cores=$(nproc)
    fit=$(awk '/^MemTotal:/ { print int($2 / 4e6) }' /proc/meminfo)
    [ "$fit" -ge 1 ] || fit=1
    if [ "$cores" -lt "$fit" ]; then echo "$cores"; else echo "$fit"; fi
}

# Builds the slim YADE into the cache, keyed by version and options; prints its prefix.
yade_slim() {
    local python prefix build sources start
    python=$(yade_python)
    prefix=$(yade_slim_prefix)
    if [ -f "$prefix/.complete" ]; then printf '%s\n' "$prefix"; return; fi

    packages_install "${PACKAGES_YADE_BUILD[@]}"
    sources=$(yade_sources) || exit 1
    build=$prefix-build
    say "Building YADE $YADE_VERSION once, into the cache (12 to 20 minutes on two cores)"
    start=$SECONDS
    mkdir -p "$build"
    # /usr/bin first, so that no other python (pyenv, conda) is picked up
    if ! PATH=/usr/bin:/bin:/usr/sbin cmake -G Ninja -S "$sources" -B "$build" "${YADE_OPTIONS[@]}" \
            "-DCMAKE_PROJECT_Yade_INCLUDE=$YADE_SHORTENING" "-DCMAKE_INSTALL_PREFIX=$prefix" "-DPYTHON_VERSION=$python" >"$build/configure.log" 2>&1; then
        tail -n 30 "$build/configure.log" >&2; die "YADE could not be configured; the whole log is $build/configure.log"
    fi
    if ! (set -o pipefail; PATH=/usr/bin:/bin:/usr/sbin NINJA_STATUS='[%f/%t] ' ninja -j "$(yade_jobs)" -C "$build" 2>&1 | ninja_progress "$build/build.log"); then
        tail -n 40 "$build/build.log" >&2; die "YADE could not be built; the whole log is $build/build.log"
    fi
    PATH=/usr/bin:/bin:/usr/sbin ninja -C "$build" install >"$build/install.log" 2>&1 ||
        { tail -n 20 "$build/install.log" >&2; die "YADE could not be installed into $prefix"; }
    touch "$prefix/.complete"
    rm -rf "$build"
    note "YADE is ready after $(((SECONDS - start) / 60)) min"
    printf '%s\n' "$prefix"
}

# The version a yade program says it has, or nothing.
yade_version() { "$1" --version 2>/dev/null | grep -oE '[0-9]{4}\.[0-9]+[.0-9a-z]*' | head -n 1; }

# Whether Debian's own YADE has the version that the headers are of.
yade_stock_fits() {
    local candidate
    [ "$(yade_version /usr/bin/yade)" = "$YADE_VERSION" ] && return
    candidate=$(apt-cache policy yade 2>/dev/null | awk '/Candidate:/ { print $2 }')
    [ "${candidate%-*}" = "$YADE_VERSION" ]
}

yade_provide() {
    local program
    if [ -n "${YADE_PREFIX:-}" ]; then
        program=$YADE_PREFIX/bin/yade
        [ -x "$program" ] || die "YADE_PREFIX=$YADE_PREFIX holds no bin/yade"
        [ "$(yade_version "$program")" = "$YADE_VERSION" ] ||
            die "YADE_PREFIX=$YADE_PREFIX holds YADE $(yade_version "$program"), but the headers at hand are of $YADE_VERSION: unset YADE_PREFIX to have $YADE_VERSION built"
    else
        if yade_stock_fits; then
            packages_install "${PACKAGES_YADE_STOCK[@]}"
            YADE_PREFIX=/usr
        else
            YADE_PREFIX=$(yade_slim) || exit 1
        fi
    fi
    YADE_HEADERS=$(yade_sources) || exit 1
    export YADE_PREFIX YADE_HEADERS
}
