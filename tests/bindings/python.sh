#!/bin/bash
# tests/bindings/python.sh: the Python package's tests, its structs against C, and an installation by pip, off the network.
# PYTHON, LOCUS_LIBRARY, LOCUS_IO_LIBRARY and LOCUS_COLD_LIBRARY say with what.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PYTHONPATH=$PWD/bindings/python
(cd bindings/python && "$PYTHON" -m pytest)
tests/bindings/layout.sh "$PYTHON" bindings/python/tests/layout.py

# pip leaves its build folders in the source: give it a copy.
cp -r bindings/python "$work/source"
unset PYTHONPATH
"$PYTHON" -m pip install --quiet --no-build-isolation --no-deps --no-index --disable-pip-version-check --root-user-action ignore \
    --target "$work/site" "$work/source"
cd "$work"
PYTHONPATH=$work/site "$PYTHON" -c '
import locus, pathlib, sys
folder = pathlib.Path(locus.__file__).parent
assert str(folder) == sys.argv[1] + "/site/locus", folder
assert (folder / "py.typed").exists()
print("installed by pip:", locus.version())' "$work"
