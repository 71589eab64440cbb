#!/bin/bash
# The functions that the given public headers declare with LOCUS_API, one a line, sorted.
set -euo pipefail
# Comments and preprocessor lines away; a declaration is what stands between LOCUS_API and its opening parenthesis.
cat "$@" | perl -0777 -ne 's{/\*.*?\*/|//[^\n]*}{ }gs; s{^\s*#.*$}{}gm; print "$1\n" while /\bLOCUS_API\b[^(;]*?(\w+)\s*\(/g' | sort -u
