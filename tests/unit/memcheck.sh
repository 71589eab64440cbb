#!/bin/bash
# tests/unit/memcheck.sh PROGRAM MILLISECONDS VALGRIND...: run under Valgrind, which takes some 30 times as long, the shortest of the
# GoogleTest program's tests: those that together take the given time without it. Suites whose names end in Memory replace
# operator new, which Valgrind does too: they are left out. So are those whose threads wait for each other all the time, which
# Valgrind runs one at a time: they take a thousand times as long, and the other sanitizers run them.
set -euo pipefail
program=$1 budget=$2
shift 2
timed=$("$program" --gtest_filter='-*Memory.*:*ThreadsAtTheSameTime:CudaLanes.*' | sed -nE 's/^\[       OK \] ([^ ,]+).* \(([0-9]+) ms\)$/\2 \1/p' | sort -n)
chosen=$(awk -v budget="$budget" '(sum += $1 + 1) <= budget || NR == 1 {printf "%s:", $2}' <<<"$timed")
echo "$(tr -cd : <<<"$chosen" | wc -c) of $(wc -l <<<"$timed") tests"
"$@" "$program" --gtest_brief=1 --gtest_filter="$chosen"
