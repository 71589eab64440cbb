#!/bin/bash
# tests/bindings/layout.sh COMMAND...: what COMMAND prints of the public structs, `struct size` and `struct.field offset` a line, is what
# the C compiler says of the headers. Without a command: of the C++ compilers.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bindings/interface.py --layout include >"$work/layout.c"
cc -std=c11 -Iinclude "$work/layout.c" -o "$work/layout"
"$work/layout" | sort >"$work/c"
compare() {
    if diff "$work/c" <("$@" | sort); then echo "$*: $(wc -l <"$work/c") sizes and offsets are those of C"; else
        echo "$*: other sizes or offsets than in C"
        return 1
    fi
}
if [ $# -gt 0 ]; then
    compare "$@"
else
    for compiler in g++ clang++; do
        "$compiler" -std=c++17 -Iinclude -x c++ "$work/layout.c" -o "$work/layout-$compiler"
        compare "$work/layout-$compiler"
    done
fi
