#!/bin/bash
# tools/ptxas_table.sh FILE...: what the compiler says of every kernel in the reports of ptxas -v, as a Markdown table: registers and
# bytes of spills of a thread, bytes of shared memory of a block, by GPU architecture.
set -euo pipefail
[ $# -gt 0 ] || { echo "usage: $0 FILE.ptxas..." >&2; exit 2; }
cat "$@" | awk '
    /Compiling entry function/ { split($0, part, "\x27"); name = part[2]; arch = part[4] }
    /bytes spill stores/ { stores = $5; loads = $9 }
    /Used [0-9]+ registers/ {
        registers = $0; sub(/.*Used /, "", registers); sub(/ registers.*/, "", registers)
        shared = 0
        if ($0 ~ /bytes smem/) { shared = $0; sub(/ bytes smem.*/, "", shared); sub(/.*[ ,]/, "", shared) }
        print name "\t" arch "\t" registers "\t" shared "\t" stores "\t" loads
    }' | c++filt | sed -E \
    -e 's/void locus::cuda::(item|block)_kernel<locus::device::/\1 /' -e 's/locus::device:://g' -e 's/ ?>\([^\t]*\)\t/\t/' -e 's/> >/>>/g' \
    -e 's/unsigned (int|char)/\1/g' -e 's/unsigned long/long/g' -e 's/\bint\b/32/g' -e 's/\blong\b/64/g' |
    grep -E '^(item|block) ' | sort -t "$(printf '\t')" -k2,2 -k1,1 -u |
    awk -F'\t' 'BEGIN { print "| kernel | GPU | registers | shared | spill stores | spill loads |"; print "|---|---|---|---|---|---|" }
        { printf "| `%s` | %s | %s | %s | %s | %s |\n", $1, $2, $3, $4, $5, $6 }'
