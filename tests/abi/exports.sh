#!/bin/bash
# tests/abi/exports.sh LIBRARY MAP HEADER...: the functions that the library exports, its version script lists and the public
# headers declare are the same; it needs no other library than the C and C++ ones; and it calls nothing that prints or ends
# the process. LOCUS_MAY_NEED: further libraries it may need, as a regular expression.
set -euo pipefail
library=$1 map=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
nm -D --defined-only "$library" | awk '$2 != "A" {sub(/@.*/, "", $3); print $3}' | sort -u >"$work/exported"
sed -nE 's/^ *([a-z0-9_]+);.*/\1/p' "$map" | sort -u >"$work/listed"
"$(dirname "$0")/declared.sh" "$@" >"$work/declared"
compare() { # a file, what it is, another file, what that is
    local only
    only=$(comm -23 "$work/$1" "$work/$3")
    [ -z "$only" ] || { echo "$2, not $4:" $only; failed=1; }
}
compare exported "exported by $library" listed "listed in $map"
compare listed "listed in $map" exported "exported by $library"
compare listed "listed in $map" declared "declared in the headers"
compare declared "declared in the headers" listed "listed in $map"
needed=$(readelf -dW "$library" | sed -nE 's/.*\(NEEDED\).*\[(.*)\]/\1/p' |
    grep -vxE "libstdc\+\+\.so\.6|libm\.so\.6|libgcc_s\.so\.1|libc\.so\.6|ld-linux.*${LOCUS_MAY_NEED:+|$LOCUS_MAY_NEED}" || true)
[ -z "$needed" ] || { echo "$library needs other libraries:" $needed; failed=1; }
speaks=$(nm -D --undefined-only "$library" | awk '{sub(/@.*/, "", $2); print $2}' |
    grep -xE '(__)?v?f?printf(_chk)?|puts|fputs|putchar|fputc|putc|perror|stdout|stderr|abort|exit|_exit|_Exit|quick_exit|__assert_fail|_ZSt4c(out|err|log)' || true)
[ -z "$speaks" ] || { echo "$library may print or end the process:" $speaks; failed=1; }
[ $failed = 0 ] && echo "$library: $(wc -l <"$work/exported") functions, the same in library, version script and headers"
exit $failed
