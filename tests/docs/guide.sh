#!/bin/bash
# The programs of the guide: tests/docs/guide.sh FOLDER_OF_THE_LIBRARY. The C blocks of a page, joined in their order, compile as C99 and
# print what its text blocks say. Links between pages lead somewhere, and measurements are those of docs/benchmarks.md.
set -euo pipefail
cd "$(dirname "$0")/../.."
library=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
blocks() { awk -v fence="\`\`\`$1" '$0 == fence {inside = 1; next} $0 == "```" {inside = 0} inside' "$2"; }
failed=0
for page in docs/guide/*.md; do
    name=$(basename "$page" .md)
    blocks c "$page" >"$folder/$name.c"
    if [ -s "$folder/$name.c" ]; then
        cc -std=c99 -pedantic -Wall -Wextra -Werror -Iinclude "$folder/$name.c" -L"$library" \
            -Wl,--as-needed -llocus_cold -llocus -lm -Wl,-rpath,"$PWD/$library" -o "$folder/$name"
        (cd "$folder" && "./$name") >"$folder/printed"
        blocks text "$page" | diff - "$folder/printed" || { echo "$page: prints something else"; failed=1; }
        echo "$page: $(wc -l <"$folder/printed") lines printed"
    fi
    for link in $(grep -oE '\]\([^)#]+\)' "$page" | sed -E 's/^\]\(|\)$//g' | grep -v '^http' || true); do
        [ -e "docs/guide/$link" ] || { echo "$page: no such file: $link"; failed=1; }
    done
done
# Rows of measurements are those of docs/benchmarks.md.
while IFS= read -r row; do
    grep -qxF -- "$row" docs/benchmarks.md || { echo "docs/guide/performance.md: not in docs/benchmarks.md: $row"; failed=1; }
done < <(grep -E '^\| `[a-z]+\.' docs/guide/performance.md)
exit $failed
