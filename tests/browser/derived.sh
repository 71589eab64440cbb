#!/bin/bash
# Are the committed files of the explorer's page that come from npm packages what tools/basemap/derive.mjs makes of them?
# tests/browser/derived.sh FOLDER: a scratch folder.
set -eu
folder=$1
page=examples/explorer/static
mkdir -p "$folder"
npm ci --prefix tools/basemap --no-audit --no-fund --silent
node tools/basemap/derive.mjs "$folder"
diff -r "$folder/vendor" $page/vendor
cmp "$folder/basemap.json" $page/basemap.json
for file in tools/basemap/package-lock.json tests/browser/package-lock.json; do
    if grep -q '"resolved"' $file; then
        echo "$file names the address of a registry"
        exit 1
    fi
done
