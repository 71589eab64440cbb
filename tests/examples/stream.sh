#!/bin/bash
# The program `stream` from end to end, good input and bad: tests/examples/stream.sh PROGRAM
set -u
stream=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

# expect STATUS NAME COMMAND...: run it; its output goes to $folder/NAME.out, errors to .err
expect() {
    local wanted=$1 name=$2 status=0
    shift 2
    "$@" >"$folder/$name.out" 2>"$folder/$name.err" || status=$?
    if [ $status != "$wanted" ]; then
        echo "FAIL $name: status $status, not $wanted"
        cat "$folder/$name.out" "$folder/$name.err"
        failed=1
    fi
}
# says NAME PATTERN: it is in the output or the errors
says() {
    grep -Eq -- "$2" "$folder/$1.out" "$folder/$1.err" && return
    echo "FAIL $1: nothing like '$2' in its output:"
    cat "$folder/$1.out" "$folder/$1.err"
    failed=1
}
is() { [ "$@" ] || { echo "FAIL: not $*"; failed=1; }; }
png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || { echo "FAIL: $1 is no PNG"; failed=1; }; }

# The simulated stream, twice: the same pictures.
for run in one two; do
    expect 0 $run "$stream" --posts 3000 --frames 2 --zoom paris --out "$folder/$run"
    for picture in world zoom window frames/frame-0001 frames/frame-0002; do png "$folder/$run/$picture.png"; done
done
says one 'Insertion +[0-9].* records/s'
says one 'Pauses +p50 .*longest'
says one 'Memory +[0-9]'
says one 'Planted bursts'
says one 'The best around Paris, FR'
is "$(wc -l <"$folder/one/events.csv")" = 13
cmp "$folder/one/world.png" "$folder/two/world.png" || failed=1
cmp "$folder/one/window.png" "$folder/two/window.png" || failed=1
# The layouts differ in speed alone.
for layout in ring array array-explicit; do
    expect 0 $layout "$stream" --posts 3000 --frames 0 --zoom paris --layout $layout --out "$folder/$layout"
    cmp "$folder/one/world.png" "$folder/$layout/world.png" || failed=1
done

# The bursts, and no others, are found; the window is saved and loaded, and asked together with what had left it.
kept() { expect 0 "$1" "$stream" --posts 700000 --hours 6 --window 2 --events 3 --no-pictures --zoom paris --keep --out "$folder/kept"; }
kept kept
says kept 'Alerts +3 of 3 planted bursts found, 0 alerts beside them'
says kept '^ +2026-03-21 .* alert after +[0-9]+ min '
says kept '^Database   (never waited for|waited for [0-9]+ times, .* in all, longest .*; with that .* records/s)'
says kept 'score 0\.[0-9]+ +[0-9.]+ km  2026-03-21 0[0-9:]+  .'
says kept '^Restart +[0-9,]+ records \(.*saved in .* and loaded in .*; [0-9,]+ older ones in SQLite'
says kept '^Both tiers [0-9,]+ records within 30 km around Paris, FR'
figure() { sed -nE "s/.*$1.*/\\1/p" "$folder/kept.out" | tr -d ,; }
is "$(figure '^Window +([0-9,]+) records live')" = "$(figure '^Restart +([0-9,]+) records')"
is "$(figure ' live, ([0-9,]+) evicted')" = "$(figure '; ([0-9,]+) older ones')"
kept again # anew, in the same folder
is "$(grep -c '^Both tiers' "$folder/again.out")" = 1

# CSV with bad lines: counted and shown, or refused.
{
    echo 'when,north,east,note'
    for i in $(seq 0 99); do echo "$((1700000000 + i)),48.1$i,11.5$i,\"note, $i\""; done
    echo '1700000100,91,11,too far north'
    echo '1700000101,abc,11,no number'
    echo '1700000102,48'
    echo '1700000103,48.2,11.6,the last'
} >"$folder/bad.csv"
columns="--time when --lat north --lon east --text note --frames 2"
expect 0 count "$stream" --csv "$folder/bad.csv" $columns --out "$folder/count"
says count '^Records +101 in'
says count '3 bad lines left out'
says count "line 102: 'north' is 91, outside -90..90"
says count "line 104: only 2 of the 4 fields"
says count '48\.2000 +11\.6000  the last'
expect 1 refuse "$stream" --csv "$folder/bad.csv" $columns --bad-lines refuse --out "$folder/refuse"
says refuse '^Records +100 in'
says refuse "stopped early.*line 102: 'north' is 91"
zstd -q "$folder/bad.csv" -o "$folder/bad.csv.zst" 2>/dev/null && {
    expect 0 packed "$stream" --csv "$folder/bad.csv.zst" $columns --out "$folder/packed"
    says packed '^Records +101 in'
}
expect 1 column "$stream" --csv "$folder/bad.csv" --no-pictures --out "$folder/column"
says column "no column 'time'"

# JSON on standard input; an endless line; a text too long; times that run back and far ahead.
{
    printf '{"time":1700000000,"lat":1,"lon":2,"text":"'
    head -c 200000 /dev/zero | tr '\0' x
    printf '"}\n{"time":1700000001,"lat":1,"lon":2,"text":"%s"}\n' "$(head -c 150 /dev/zero | tr '\0' y)"
    for i in $(seq 1 50); do echo "{\"time\":$((1700000100 - i)),\"lat\":1,\"lon\":2,\"text\":\"back $i\"}"; done
    echo '{"time":2700000000,"lat":1,"lon":2,"text":"far ahead"}'
} >"$folder/input.json"
expect 0 json "$stream" --json - --no-pictures --out "$folder/json" <"$folder/input.json"
says json '^Records +52 in'
says json 'line 1: longer than 65536 bytes'
says json '1 texts longer than 140 bytes, cut'
says json '1 had times far ahead'
says json '52 records live, 0 evicted; the clock is 2023-11-14 22:14:59 UTC'

# Nothing at all.
expect 0 empty "$stream" --csv - --out "$folder/empty" </dev/null
says empty 'The stream is empty'
png "$folder/empty/world.png"
expect 1 missing "$stream" --csv "$folder/none.csv" --out "$folder/missing"
says missing 'cannot open .*none.csv: No such file'

# A disk that is full: the stream is absorbed, the error says which picture, nothing half-written stays.
full() { (trap '' XFSZ; ulimit -f 16; "$stream" "$@" >"$folder/full.txt" 2>"$folder/full2.txt"; echo $? >"$folder/full.rc") ; }
full --posts 3000 --frames 2 --out "$folder/full"
is "$(cat "$folder/full.rc")" = 1
grep -q 'cannot write .*frame-0001.png: File too large' "$folder/full2.txt" || { cat "$folder/full2.txt"; failed=1; }
grep -q '^Insertion' "$folder/full.txt" || failed=1
is -z "$(find "$folder/full" -type f)"

full --posts 60000 --window 1 --no-pictures --keep --out "$folder/full"
is "$(cat "$folder/full.rc")" = 1
grep -Eq 'locus_cold_(open|flush).*(File too large|disk)' "$folder/full2.txt" || { cat "$folder/full2.txt"; failed=1; }

"$stream" --posts 100 --no-pictures >/dev/full 2>"$folder/full3.txt" && { echo "FAIL: a full standard output"; failed=1; }
grep -q 'cannot write the summary' "$folder/full3.txt" || failed=1

# The command line.
expect 0 help "$stream" --help
says help '--bad-lines'
expect 2 option "$stream" --no-such-option
expect 2 range "$stream" --posts -5
expect 1 place "$stream" --zoom Nowhereville --posts 10 --out "$folder/place"
says place 'no such place'
expect 1 folder "$stream" --posts 10 --out /dev/null/x
says folder 'cannot make /dev/null/x'
[ $failed = 0 ] && echo "stream: all as it should be"
exit $failed
