#!/bin/bash
# tests/bindings/cpp.sh FOLDER_OF_THE_LIBRARY: the C++ types compile as C++17 and C++20 with both compilers, used as their unit tests
# use them, and without exceptions; the example program compiles against the headers alone and prints what it should.
set -euo pipefail
cd "$(dirname "$0")/../.."
library=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
warn=(-pedantic -Wall -Wextra -Werror -Wconversion -Wno-sign-conversion -Wshadow -Iinclude)
for compiler in g++ clang++; do
    for standard in c++17 c++20; do
        "$compiler" "${warn[@]}" -std=$standard examples/cpp/tour.cpp -L"$library" -llocus -Wl,-rpath,"$(realpath "$library")" -o "$work/tour"
        "$work/tour" >"$work/printed"
        sed 1d "$work/printed" | diff examples/cpp/tour.out - || { echo "examples/cpp/tour prints something else"; exit 1; }
        echo "$compiler -std=$standard: the example runs"
    done
    # The unit tests themselves are built as C++20.
    for file in tests/unit/cpp/*.cpp; do "$compiler" "${warn[@]}" -std=c++17 -fsyntax-only "$file"; done
    echo "$compiler -std=c++17: the unit tests compile"
    "$compiler" "${warn[@]}" -std=c++17 -fno-exceptions -x c++ - -L"$library" -llocus_cold -llocus -Wl,-rpath,"$(realpath "$library")" -o "$work/plain" <<'END'
#include <locus/cold.hpp>
#include <locus/locus.hpp>
#include <locus/records.hpp>
#include <locus/volume.hpp>
#include <cstdio>
int main() {
    locus::status status;
    const locus::graph graph(locus::graph_options(0, 1, 1), {}, &status);
    std::printf("%s\n", status.text().c_str());
    locus::pmq<> store({}, &status);
    store.count(locus::query<>().where([](const locus_point32 &) { return true; }), &status);
    const bool counted = status.ok();
    const locus::cold<> tier("/no/such/folder/tier.db", {}, &status);
    return !graph && counted && !tier && status.code() == LOCUS_E_IO ? 0 : 1;
}
END
    "$work/plain" | grep -q dims
    echo "$compiler: works without exceptions, by status"
done
