#!/usr/bin/env bash
# Compiles the solver, the collider and packing for aarch64, warnings being errors: no header or instruction of one kind of processor may be needed. It does not run them.
# Usage: tests/aarch64/compile.sh COMPILER FOLDER HDF5_HEADERS   with FOLDER for what is made
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
[ $# -eq 3 ] || { sed -n '2,3s/^# //p' "${BASH_SOURCE[0]}" >&2; exit 2; }
mkdir -p "$2"
cd "$root"
for source in pkg/contact/core/*.cpp pkg/contact/plane/*.cpp pkg/contact/space/*.cpp pkg/neighbours/*.cpp pkg/packing/*.cpp; do
    "$1" -std=c++17 -O1 -ffp-contract=off -fopenmp -Wall -Wextra -Werror -Wno-psabi -Ipkg -isystem "$3" -c "$source" -o "$2/$(echo "$source" | tr / _).o"
done
for header in pkg/contact/*/*.hpp; do # functions that no source of the solver calls
    echo "#include <${header#pkg/}>" | "$1" -std=c++17 -ffp-contract=off -fopenmp -Wall -Wextra -Werror -Wno-psabi -Ipkg -isystem "$3" -x c++ -fsyntax-only -
done
echo "$(find "$2" -name '*.o' | wc -l) sources compiled for $("$1" -dumpmachine)"
