#!/bin/bash
# tools/packaging/deb.sh STAGE PACKAGE VERSION: make the Debian package of what `make install` has put into the folder STAGE.
set -euo pipefail
stage=$1 package=$2 version=$3
here=$(realpath "$(dirname "$0")")
find "$stage" -name '*.so.*' -type f -exec strip --strip-unneeded {} +
find "$stage" -name '*.a' -exec strip --strip-debug {} +
doc=$stage/usr/share/doc/liblocus
install -d "$doc" "$stage/DEBIAN"
install -m 644 LICENSE "$doc/copyright"
gzip -9n <CHANGELOG.md >"$doc/changelog.gz"

# dpkg-shlibdeps wants to stand in a source package; a file debian/control is enough of one.
source=$(mktemp -d)
trap 'rm -rf "$source"' EXIT
mkdir "$source/debian"
printf 'Source: locus\n\nPackage: liblocus\nArchitecture: any\n' >"$source/debian/control"
mapfile -t libraries < <(find "$(realpath "$stage")" -name '*.so.*' -type f)
depends=$(cd "$source" && dpkg-shlibdeps -O "${libraries[@]/#/-e}" 2>"$source/messages" | sed -n 's/^shlibs:Depends=//p') ||
    { cat "$source/messages" >&2; exit 1; }
sed -e "s|@VERSION@|$version|" -e "s|@ARCHITECTURE@|$(dpkg --print-architecture)|" -e "s|@DEPENDS@|$depends|" \
    -e "s|@MAINTAINER@|${DEBFULLNAME:-The Locus developers} <${DEBEMAIL:-locus@localhost}>|" "$here/control.in" >"$stage/DEBIAN/control"
echo "activate-noawait ldconfig" >"$stage/DEBIAN/triggers"
(cd "$stage" && find usr -type f -print0 | sort -z | xargs -0 md5sum >DEBIAN/md5sums)
chmod -R u=rwX,go=rX "$stage"
dpkg-deb --root-owner-group --build "$stage" "$package" >/dev/null
