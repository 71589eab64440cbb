#!/bin/bash
# tests/bindings/coverage.sh: every function that the version scripts export is bound in every binding, or listed in that binding's
# left_out.txt with a reason (`function reason`); and what is listed there exists and is left out indeed.
set -euo pipefail
cd "$(dirname "$0")/../.."
failed=0
# The folder of a binding's left_out.txt, what a call looks like, and the sources written by hand: what was made from the headers names
# every function and binds none.
bindings() {
    echo 'bindings/cpp \bFUNCTION\b include/locus/*.hpp'
    echo 'bindings/python \.FUNCTION\b bindings/python/locus/*.py :!bindings/python/locus/_ffi.py'
    echo 'bindings/node \bFUNCTION\b bindings/node/lib/*.js :!bindings/node/lib/interface.js'
    echo 'bindings/rust \bFUNCTION\b bindings/rust/locus/src/*'
}
exported=$(sed -nE 's/^ *(locus_[a-z0-9_]+);.*/\1/p' src/*.map)
while read -r folder pattern sources; do
    [ -d "$folder" ] || continue
    files=$(git ls-files --cached --others --exclude-standard $sources)
    [ -n "$files" ] || { echo "$folder: no sources at $sources"; failed=1; continue; }
    code=$(cat $files | grep -vE '^ *(//|#|\*|/\*)')
    left_out=$folder/left_out.txt bound=0 left=0
    listed=$(grep -vE '^(#|$)' "$left_out" 2>/dev/null || true)
    for function in $exported; do
        used=$(grep -cE "${pattern/FUNCTION/$function}" <<<"$code" || true)
        if reason=$(grep -E "^$function( |$)" <<<"$listed"); then
            left=$((left + 1))
            [ "$used" = 0 ] || { echo "$folder: $function is bound, though $left_out lists it"; failed=1; }
            [[ $reason == *" "?* ]] || { echo "$folder: $left_out gives no reason for $function"; failed=1; }
        elif [ "$used" = 0 ]; then
            echo "$folder: $function is neither bound nor listed in $left_out with a reason"
            failed=1
        else
            bound=$((bound + 1))
        fi
    done
    for function in $(awk '{print $1}' <<<"$listed"); do
        grep -qxF "$function" <<<"$exported" || { echo "$folder: $left_out lists $function, which does not exist"; failed=1; }
    done
    echo "$folder: $bound functions bound, $left left out"
done < <(bindings)
exit $failed
