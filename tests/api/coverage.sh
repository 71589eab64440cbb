#!/bin/bash
# Every exported function that returns a status is refused a bad argument by some API test, every other one is called by some,
# and every public struct has its layout tested.
set -euo pipefail
cd "$(dirname "$0")/../.."
failed=0
sources=$(cat tests/api/*.c)
code=$(cat include/locus/*.h | perl -0777 -pe 's{/\*.*?\*/}{ }gs')
for function in $(sed -nE 's/^ *(locus_[a-z0-9_]+);.*/\1/p' src/*.map); do
    if grep -qE "LOCUS_API locus_status $function\(" <<<"$code"; then
        grep -qE "REFUSES\($function\(" <<<"$sources" || { echo "no test of bad arguments: $function"; failed=1; }
    else
        grep -qE "\b$function\(" <<<"$sources" || { echo "no test: $function"; failed=1; }
    fi
done
for struct in $(grep -oE 'typedef struct locus_[a-z0-9_]+ \{' <<<"$code" | awk '{print $3}'); do
    grep -qE "SIZE\($struct," <<<"$sources" || { echo "no test of the layout: $struct"; failed=1; }
done
exit $failed
