# Debian packages: what the project needs, and installing what is missing.
# shellcheck shell=bash

# To build the plugin and the solver, and to run scenarios.
PACKAGES_PROJECT=(
    g++ cmake ninja-build pkg-config ca-certificates python3 python3-dev
    libboost-all-dev libeigen3-dev zlib1g-dev libhdf5-dev pybind11-dev
    python3-numpy python3-scipy python3-matplotlib python3-shapely python3-yaml python3-jsonschema
    python3-tqdm python3-tabulate python3-pandas python3-h5py python3-h5py-serial python3-meshio python3-docutils python3-jinja2 python3-pil
    python3-ipython ffmpeg gmsh)

# To build and run the tests, and to build the documentation with its notebooks (setup.sh --tests).
PACKAGES_TESTS=(
    libgtest-dev libbenchmark-dev python3-pytest python3-hypothesis python3-iapws
    python3-sphinx furo python3-sphinx-copybutton python3-sphinxcontrib.bibtex python3-nbsphinx python3-nbconvert python3-ipykernel pandoc)

# To configure, build and run the slim YADE.
PACKAGES_YADE_BUILD=(
    bzip2 libvtk9-dev libgts-dev libbz2-dev python3-ipython python3-pygraphviz python3-minieigen
    python3-mpi4py python3-mpmath python3-pil python3-tk python3-xlib python3-pyqt5 python3-sphinx
    python3-pyqt5.qtsvg python3-bibtexparser python3-future)

# To compile against the headers of Debian's own YADE, whose feature macros ask for them.
PACKAGES_YADE_STOCK=(
    yade bzip2 libvtk9-dev libgts-dev libbz2-dev libmpfrc++-dev libmpc-dev libopenmpi-dev
    libmpfr-dev libgmp-dev libopengl-dev libglu1-mesa-dev freeglut3-dev)

# To show notebooks in a browser and to run their cells (setup.sh --notebooks).
PACKAGES_NOTEBOOKS=(jupyter-notebook python3-ipykernel python3-nbconvert)

# Other solvers that the tests compare with (setup.sh --tests), where the distribution has them: Debian 13 has no Siconos.
PACKAGES_ORACLE=(libsiconos-numerics-dev freefem++)

# To compile the solver for another processor, in .ci/run: 56 MB to fetch, 200 MB on the disk, so no user needs it.
PACKAGES_CROSS=(g++-aarch64-linux-gnu)

# To hold the files of a campaign for a cluster against runs done here, in .ci/run: 670 MB on the disk with what it needs.
PACKAGES_CAMPAIGN=(snakemake)

# To hold the sources to their format, in .ci/run; scripts/format.sh wants the versions of Debian 12.
PACKAGES_FORMAT=(clang-format black)

# Installs those of the packages that apt knows, and leaves out the others.
packages_install_known() {
    local name known=()
    for name in "$@"; do
        if [ -z "$(packages_missing "$name")" ] || apt-cache show "$name" >/dev/null 2>&1; then known+=("$name"); fi
    done
    [ "${#known[@]}" -eq 0 ] || packages_install "${known[@]}"
}

packages_missing() {
    local name
    for name in "$@"; do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || printf '%s\n' "$name"
    done
}

packages_install() {
    local missing log
    mapfile -t missing < <(packages_missing "$@")
    [ "${#missing[@]}" -eq 0 ] && return 0
    log=$(mktemp)
    say "Installing ${#missing[@]} Debian packages and what they need (2 to 12 minutes): ${missing[*]}"
    as_root apt-get update -qq >"$log" 2>&1 || { cat "$log" >&2; die "apt-get update failed: is the package mirror reachable?"; }
    # apt's progress comes on descriptor 3, made behind sudo, which would close it; what packages print goes into a file and not into
    # the same pipe: apt makes that one non-blocking, and a package whose script finds it full fails
    # shellcheck disable=SC2016
    if ! (set -o pipefail; as_root env DEBIAN_FRONTEND=noninteractive sh -c \
            'log=$1; shift; exec apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 -o APT::Status-Fd=3 "$@" 3>&1 >"$log" 2>&1 </dev/null' \
            sh "$log" "${missing[@]}" | apt_progress); then
        tail -n 20 "$log" >&2
        die "these packages could not be installed: ${missing[*]} (log: $log)"
    fi
    rm -f "$log"
}

# Shows how far apt is, from its "dlstatus:…:PERCENT:…" and "pmstatus:…:PERCENT:…" lines.
apt_progress() {
    local start=$SECONDS printed=-60 every=15 begin="" end="\n" line what percent
    [ -t 2 ] && every=1 begin="\r" end=""
    while IFS= read -r line; do
        case "$line" in dlstatus:*) what=downloading ;; pmstatus:*) what="installing " ;; *) continue ;; esac
        [ $((SECONDS - printed)) -ge "$every" ] || continue
        printed=$SECONDS
        percent=${line#*:*:}
        # shellcheck disable=SC2059
        printf "$begin   %s %3d %%, %d:%02d spent   $end" "$what" "${percent%%[.:]*}" \
            $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60)) >&2
    done
    [ -z "$begin" ] || printf '\n' >&2
}
