#!/bin/bash
# tests/install/programs.sh ROOT PREFIX WORK: build and run the outside programs against the installation in ROOT/PREFIX, by
# pkg-config and by CMake, shared and static.
set -euo pipefail
root=$1 prefix=$2 work=$3
source=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$work"
libdir=$(dirname "$(find "$root$prefix" -name liblocus.so)")
export PKG_CONFIG_PATH=$libdir/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root LD_LIBRARY_PATH=$libdir
version=$(pkg-config --modversion locus)
warn=(-Wall -Wextra -pedantic -Werror)

# The program is shared if it needs our libraries and static if it does not.
run() { # shared|static program
    "$2" >/dev/null || { echo "$2 failed"; exit 1; }
    local needed
    needed=$(readelf -dW "$2" | grep -c 'NEEDED.*liblocus' || true)
    if [ "$1" = shared ]; then [ "$needed" -gt 0 ]; else [ "$needed" = 0 ]; fi || { echo "$2 is not $1"; exit 1; }
    echo "works: ${2#"$work"/} ($1, Locus $version)"
}
build() { # name compiler language source packages...
    local name=$1 compiler=$2 language=$3 file=$4 flags
    shift 4
    flags=$(pkg-config --cflags "$@")
    "$compiler" "${warn[@]}" -x "$language" "$file" -x none $flags $(pkg-config --libs "$@") -o "$work/$name"
    run shared "$work/$name"
    "$compiler" "${warn[@]}" -x "$language" "$file" -x none $flags \
        $(pkg-config --static --libs "$@" | sed -E 's/-l(locus[a-z_]*)/-l:lib\1.a/g') -o "$work/$name-static"
    run static "$work/$name-static"
}
build pkg-c gcc c "$source/outside.c" locus
build pkg-cpp g++ c++ "$source/outside.c" locus
build pkg-io gcc c "$source/outside_io.c" locus locus_io
build pkg-cold gcc c "$source/outside_cold.c" locus_cold

# An ordinary prefix is searched; a libraries' folder that CMake does not know has to be named.
found=-DCMAKE_PREFIX_PATH=$root$prefix
[ "$libdir" = "$root$prefix/lib" ] || found=-DLocus_DIR=$libdir/cmake/Locus
cmake -S "$source" -B "$work/cmake" "$found" -DWANTED_VERSION="$version" >"$work/cmake.log" 2>&1 ||
    { cat "$work/cmake.log"; exit 1; }
cmake --build "$work/cmake" >"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; exit 1; }
for program in outside_c outside_cpp outside_io_c outside_cold_c; do
    run shared "$work/cmake/${program}_shared"
    run static "$work/cmake/${program}_static"
done
if cmake -S "$source" -B "$work/newer" "$found" -DWANTED_VERSION=99.0.0 >"$work/newer.log" 2>&1; then
    echo "find_package takes $version for 99.0.0"
    exit 1
fi
