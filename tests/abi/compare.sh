#!/bin/bash
# tests/abi/compare.sh [--renew] LIBRARY: compare the library's ABI, as the public headers show it, with the committed baseline
# tests/abi/NAME.MACHINE.abi; or write the baseline anew.
set -euo pipefail
renew=0
[ "$1" != --renew ] || { renew=1; shift; }
library=$1
folder=$(dirname "$0")
name=$(basename "$library")
baseline=$folder/${name%%.so*}.$(uname -m).abi
if [ $renew = 1 ]; then
    # Nothing of where and how it was built: the same library gives the same bytes.
    abidw --exported-interfaces-only --headers-dir include --drop-private-types --type-id-style hash --no-elf-needed \
        --no-corpus-path --no-comp-dir-path --no-show-locs \
        --out-file "$baseline" "$library"
    echo "wrote $baseline"
    exit 0
fi
if [ ! -e "$baseline" ]; then
    echo "no baseline for $(uname -m): nothing compared (make abi-baseline writes one)"
    [ "$(uname -m)" != x86_64 ]
    exit
fi
if abidiff --exported-interfaces-only --headers-dir2 include --drop-private-types --no-show-locs "$baseline" "$library"; then
    echo "$name: the ABI is that of $baseline"
else
    echo "The ABI is not that of $baseline. If the change is meant: see CONTRIBUTING.md, then run make abi-baseline."
    exit 1
fi
