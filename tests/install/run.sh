#!/bin/bash
# make install into a scratch prefix and a DESTDIR, outside programs against it, make uninstall.
set -euo pipefail
here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# DESTDIR in front of a prefix, with a folder of libraries of its own kind; then a plain prefix.
for where in "$work/stage /opt/locus" " $work/prefix"; do
    root=${where% *} prefix=${where#* }
    variables=(DESTDIR="$root" PREFIX="$prefix")
    [ -z "$root" ] || variables+=(LIBDIR="$prefix/lib/of-this-machine")
    $MAKE --no-print-directory install "${variables[@]}"
    if grep -rlF "$PWD/" "$root$prefix"; then
        echo "these installed files name the build folder"
        exit 1
    fi
    "$here/programs.sh" "$root" "$prefix" "$work/programs${root:+-staged}"
    $MAKE --no-print-directory uninstall "${variables[@]}"
    left=$(find "$root$prefix" ! -type d -o -iname '*locus' ! -path "$root$prefix")
    [ -z "$left" ] || { echo "left behind: $left"; exit 1; }
done
