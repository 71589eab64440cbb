#!/bin/bash
# tests/bindings/node.sh FOLDER: the Node.js package's tests, its structs against C, the tour with its picture into FOLDER, and an
# installation of the package as npm packs it. LOCUS_LIBRARY, LOCUS_IO_LIBRARY and LOCUS_COLD_LIBRARY say with what; bindings/node/node_modules is there.
set -euo pipefail
cd "$(dirname "$0")/../.."
pictures=$(mkdir -p "$1" && realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
node --test bindings/node/tests/*.test.js
tests/bindings/layout.sh node bindings/node/tests/layout.js
node bindings/node/examples/tour.js "$pictures/tour.png"
[ "$(head -c 8 "$pictures/tour.png" | tail -c 7)" = "$(printf 'PNG\r\n\032\n')" ] || { echo "the tour's picture is none"; exit 1; }

# What npm packs is whole: with the dependencies beside it, it is found by its name, in a worker too.
(cd bindings/node && npm pack --silent --pack-destination "$work" >/dev/null)
mkdir -p "$work/node_modules/locus"
tar -xzf "$work"/locus-*.tgz -C "$work/node_modules/locus" --strip-components=1
cp -r bindings/node/node_modules/koffi bindings/node/node_modules/@koromix "$work/node_modules"
cd "$work"
node --input-type=module -e '
import { Store, version } from "locus";
import { existsSync } from "node:fs";
if (await new Store().count() !== 0 || !existsSync("node_modules/locus/lib/index.d.ts")) process.exit(1);
console.log("installed from its pack:", version());'
