#!/bin/bash
# Every public header, alone and twice, under each standard of C and C++ it promises, with gcc and clang, without a warning. The C++
# headers, which take seconds, are for one standard each compiler's.
set -eu
warn=(-pedantic -Wall -Wextra -Werror -fsyntax-only -Iinclude)
failed=0
try() { # compiler language standard header
    printf '#include <%s>\n#include <%s>\n' "$4" "$4" | "$1" "${warn[@]}" -std=$3 -x "$2" - ||
        { echo "FAILED: $4 alone with $1 -std=$3"; failed=1; }
}
for path in include/locus/*; do
    header=${path#include/}
    try clang++ c++ c++17 "$header"
    try g++ c++ c++20 "$header"
    case $path in *.hpp) continue ;; esac
    try g++ c++ c++17 "$header"
    try clang++ c++ c++20 "$header"
    # A field added inside hidden padding would not change the size of the struct: there is none.
    try gcc c "c99 -Wpadded" "$header"
    for standard in c99 c11 c17; do
        try gcc c $standard "$header"
        try clang c $standard "$header"
    done
done
[ $failed = 0 ] && echo "headers: $(ls include/locus | wc -l), each alone under every standard"
exit $failed
