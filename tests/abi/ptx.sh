#!/bin/bash
# tests/abi/ptx.sh FILE.ptx...: the kernels compute what the host does, and read what others write: no floating-point operation that
# is fused, approximate or without denormal numbers, and no load through a cache that is not coherent.
set -euo pipefail
failed=0
none() { # what it is, pattern, file
    local found
    found=$(grep -nE "$2" "$3" | head -n 3 || true)
    [ -z "$found" ] || { printf '%s has %s:\n%s\n' "$3" "$1" "$found"; failed=1; }
}
for file in "$@"; do
    grep -q '^\.visible \.entry' "$file" || { echo "$file holds no kernel"; failed=1; }
    none "fused operations" '^\s*(@!?%p[0-9]+ )?(fma|mad)\.[a-z.]*f(32|64)' "$file"
    none "approximate operations" '\.(approx|full)\b' "$file"
    none "operations without denormal numbers" '\.ftz\b' "$file"
    none "loads through the read-only cache" 'ld\.global\.nc' "$file"
done
[ $failed = 0 ] && echo "$# files: $(cat "$@" | grep -c '^\.visible \.entry') kernels, no fused or approximate operation"
exit $failed
