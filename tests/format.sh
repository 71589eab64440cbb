#!/bin/bash
# The form of the sources: as clang-format has it, no file too long to read, no note to come back to, no path of one machine.
set -u
failed=0
code=(git ls-files '*.c' '*.h' '*.cpp' '*.hpp' '*.cu' '*.cuh')
text=("${code[@]}" '*.mk' '*.sh' '*.py' '*.js' '*.ts' '*.rs' '*.md' '*.txt' Makefile .ci/run)

"${code[@]}" -z | xargs -0 clang-format --dry-run --Werror --ferror-limit=1 || { echo "not as clang-format has it: make format"; failed=1; }
long=$("${code[@]}" '*.mk' '*.sh' '*.py' '*.js' '*.ts' '*.rs' | xargs wc -l | awk '$2 != "total" && $1 > 800')
[ -z "$long" ] || { echo "longer than 800 lines:"; echo "$long"; failed=1; }
notes=$("${text[@]}" | grep -vxF tests/format.sh | xargs grep -nE '\b(TODO|FIXME|XXX)\b|/work/|/home/[a-z]' || true)
[ -z "$notes" ] || { echo "notes to come back to, or paths of one machine:"; echo "$notes"; failed=1; }
exit $failed
