#!/bin/bash
# tests/install/deb.sh PACKAGE: install the package into a scratch root, build the outside programs against it, remove it.
set -euo pipefail
package=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/admin/updates" "$root/admin/info" "$root/root"
touch "$root/admin/status" "$root/admin/available"
# What it depends on is installed on this machine, not in the scratch root.
scratch() { PATH=$PATH:/sbin:/usr/sbin dpkg --admindir="$root/admin" --instdir="$root/root" --force-not-root --force-depends --log=/dev/null "$@"; }
dpkg-deb --field "$package"
for dependency in $(dpkg-deb --field "$package" Depends | sed 's/([^)]*)//g; s/,//g'); do
    dpkg-query -W -f='${db:Status-Status}\n' "$dependency" | grep -qx installed || { echo "depends on $dependency, which is not here"; exit 1; }
done
scratch --install "$package" 2>&1
"$(dirname "$0")/programs.sh" "$root/root" /usr "$root/programs"
scratch --purge liblocus 2>&1
left=$(find "$root/root" ! -type d)
[ -z "$left" ] || { echo "left behind: $left"; exit 1; }
