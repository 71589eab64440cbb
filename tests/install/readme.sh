#!/bin/bash
# The C program in README.md compiles as C99 and prints what it should: tests/install/readme.sh FOLDER_OF_THE_LIBRARY
set -euo pipefail
cd "$(dirname "$0")/../.."
library=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
awk '/^```c$/ {inside = 1; next} /^```$/ {inside = 0} inside' README.md >"$folder/readme.c"
cc -std=c99 -pedantic -Wall -Wextra -Werror -Iinclude "$folder/readme.c" -L"$library" -llocus -Wl,-rpath,"$PWD/$library" -o "$folder/readme"
"$folder/readme" | tee "$folder/printed"
printf '1 record near Paris\n0 1 6.5 1 0 \n' | diff - "$folder/printed"
