#!/bin/bash
# The volume program from end to end on a small noisy volume: results, and what it refuses. usage: volume.sh PROGRAM
# RUN: words in front of the program in its first run, such as valgrind's.
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$(dirname "$0")/../.."
fail() { echo "$1"; exit 1; }

# Digits and line ends: 24 x 20 x 16 bytes of 48..57 and, impassable, 10.
seq 1 5000 >"$folder/noise"
head -c 7680 "$folder/noise" >"$folder/noise.raw"
raw=(--raw 24 20 16 --raw-type uint8 --raw-spacing 1 1 1.5)
map='point 48 1; point 57 100'
${RUN:-} "$program" "$folder/noise.raw" "${raw[@]}" --map "$map" --place 5 --lloyd 3 --largest-part --width 90 --out "$folder/out" >"$folder/log" ||
    fail "the run failed: $(cat "$folder/log")"
for file in cells.png distances.png trace.png labels.nrrd distances.nrrd seeds.txt; do
    [ -s "$folder/out/$file" ] || fail "no $file"
done
grep -q 'labels the same' "$folder/log" || fail "no trace in: $(cat "$folder/log")"
[ "$(grep -vc '#' "$folder/out/seeds.txt")" = 5 ] || fail "not five seeds: $(cat "$folder/out/seeds.txt")"
head -c 400 "$folder/out/labels.nrrd" | grep -aq '^sizes: 24 20 16$' || fail "labels.nrrd has other sizes"

# What was written is a volume that the program reads: the cells again, each seed's label a material of its own.
"$program" "$folder/out/labels.nrrd" --map 'range 1 inf 1' --seeds "$folder/out/seeds.txt" --no-trace --out "$folder/again" >/dev/null ||
    fail "labels.nrrd is not read again"

# Weights of the seeds, the object deformed by them before and after a blade went through it, and the waves from the seeds.
"$program" "$folder/noise.raw" "${raw[@]}" --map "$map" --place 5 --lloyd 1 --largest-part --width 90 --no-trace --weights --weight-seeds 3 1 \
    --deform 1 2 1 20 3 -1 0 0 --cut 9.5 -1 -1 9.5 14 -1 11.5 -1 16 --cut-steps 3 --waves --out "$folder/moved" >"$folder/log" || fail "the weights: $(cat "$folder/log")"
for file in weights.png deform.png cut.png cutting.png waves.png waves-series.png weights.nrrd; do
    [ -s "$folder/moved/$file" ] || fail "no $file"
done
head -c 400 "$folder/moved/weights.nrrd" | grep -aq '^sizes: 5 24 20 16$' || fail "weights.nrrd has other sizes"
grep -q 'rows of weights changed.* the same)' "$folder/log" || fail "no cut of the weights in: $(cat "$folder/log")"
grep -q '[1-9][0-9]* edges in 3 steps, .* the same$' "$folder/log" || fail "no cut in: $(cat "$folder/log")"
grep -q 'iterations, a voxel active .* labels the same' "$folder/log" || fail "no waves in: $(cat "$folder/log")"
[ "$(grep -ac acTL "$folder/moved/cutting.png")" = 1 ] || fail "cutting.png is not animated"

# More seeds than a 32-bit word has room for by default.
"$program" "$folder/noise.raw" "${raw[@]}" --map "$map" --place 300 --lloyd 1 --word 32 --no-trace --out "$folder/many" >"$folder/log" ||
    fail "300 seeds: $(cat "$folder/log")"
grep -q '32 bits, 9 of them' "$folder/log" || fail "no word of 32 bits in: $(cat "$folder/log")"

# refuses TEXT WORDS...: the program fails, and says so with TEXT.
refuses() {
    local text=$1
    shift
    if "$program" "$@" --out "$folder/bad" >"$folder/log" 2>&1; then fail "accepted: $*"; fi
    grep -qF -- "$text" "$folder/log" || fail "no \"$text\" for: $* -- but $(cat "$folder/log")"
}
good=("$folder/noise.raw" "${raw[@]}" --map "$map")
refuses 'cannot open' "$folder/absent.mha" --map "$map" --place 5
refuses 'no known format' "$folder/noise.raw" --map "$map" --place 5
refuses 'take 23040 bytes, but the file holds 7680' "$folder/noise.raw" --raw 24 20 48 --raw-type uint8 --map "$map" --place 5
refuses 'raw_type is 0' "$folder/noise.raw" --raw 24 20 16 --map "$map" --place 5
refuses '--table or --map' "$folder/noise.raw" "${raw[@]}" --place 5
refuses '--seeds or --place' "${good[@]}"
refuses 'every voxel impassable' "$folder/noise.raw" "${raw[@]}" --map 'label 300 1' --place 5
refuses '"-1" is neither' "$folder/noise.raw" "${raw[@]}" --map 'label 48 -1' --place 5
refuses '"dot" is none of point, label, range' "$folder/noise.raw" "${raw[@]}" --map 'dot 48 1' --place 5
refuses 'entry 2: the point at 40 does not lie behind' "$folder/noise.raw" "${raw[@]}" --map 'point 50 1; point 40 1' --place 5
seeds() { printf '%s\n' "$@" >"$folder/seeds"; }
seeds '1 2' && refuses 'line 1: "1 2"' "${good[@]}" --seeds "$folder/seeds"
seeds '# none' '1 2 -3' && refuses 'line 2: "1 2 -3"' "${good[@]}" --seeds "$folder/seeds"
seeds '24 0 0' && refuses '(24, 0, 0), outside the grid' "${good[@]}" --seeds "$folder/seeds"
seeds '1 0 0' && refuses '(1, 0, 0), an impassable voxel' "${good[@]}" --seeds "$folder/seeds"
seeds '0 0 0 7' '2 0 0 7' && refuses 'has the id 7, which is taken' "${good[@]}" --seeds "$folder/seeds"
seeds '# none' && refuses 'no seed in the file' "${good[@]}" --seeds "$folder/seeds"
refuses 'count is 9999' "${good[@]}" --place 9999
refuses 'outside the volume' "${good[@]}" --place 2 --no-trace --slice 24 0 0
refuses 'no seed has the id 9' "${good[@]}" --place 2 --no-trace --weights --weight-seeds 9
refuses 'no seed has the id 7' "${good[@]}" --place 2 --no-trace --deform 7 1 1 0
refuses 'four numbers a seed, not 5' "${good[@]}" --place 2 --no-trace --deform 0 1 1 0 1
refuses '1.5 is no seed' "${good[@]}" --place 2 --no-trace --deform 1.5 1 1 0
refuses '--cut-steps requires --cut' "${good[@]}" --place 2 --no-trace --cut-steps 3
refuses 'inf is no place' "${good[@]}" --place 2 --no-trace --cut 0 0 0 1 1 inf 0 0 1
refuses '9 required' "${good[@]}" --place 2 --no-trace --cut 0 0 0 1 1 1
echo "the volume program: good"
