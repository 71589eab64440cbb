#!/bin/sh
# Make sure that the Debian packages of the named jobs are installed: tools/packages.sh JOB...
# Prints what is missing and why, installs it with apt-get (through sudo where not root), and fails clearly elsewhere.
set -eu
list=$(dirname "$0")/packages.txt
missing=""
# One at a time: a parallel make may ask for several jobs at once.
if [ -z "${LOCUS_PACKAGES_LOCKED:-}" ] && command -v flock >/dev/null 2>&1; then
    LOCUS_PACKAGES_LOCKED=1 exec flock "$list" "$0" "$@"
fi
for job in "$@"; do
    grep -q "^$job " "$list" || { echo "packages: no job '$job' in $list" >&2; exit 2; }
done
jobs=$(printf '%s|' "$@" | sed 's/|$//')
wanted=$(grep -E "^($jobs) " "$list")
# What is installed, under its own name and under those it provides (a nodejs may bring npm along).
have=$(dpkg-query -W -f='${db:Status-Status} ${Package}, ${Provides}\n' 2>/dev/null | sed -n 's/^installed //p' | tr ',' '\n' |
    awk '{print $1}' || true)
tell() { printf '%s\n' "$wanted" | awk -v p="$1" '$2 == p {$1 = ""; print "  -" $0; exit}'; }
for package in $(printf '%s\n' "$wanted" | awk '{print $2}' | sort -u); do
    printf '%s\n' "$have" | grep -qxF "$package" || missing="$missing $package"
done
[ -n "$missing" ] || exit 0
echo "Packages needed for $* that are not installed:"
for package in $missing; do tell "$package"; done
if ! command -v apt-get >/dev/null 2>&1; then
    echo "This is not a Debian system: please install what these Debian packages hold, then run make again with SKIP_PACKAGES=1." >&2
    echo "(The library alone builds with a C++20 compiler and make: make lib SIMD=scalar)" >&2
    exit 1
fi
root=""
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null 2>&1 || { echo "Not root and no sudo: run 'apt-get install$missing' as root, then make again." >&2; exit 1; }
    root=sudo
fi
echo "Installing them with apt-get ..."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
get() { $root env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=400 -o Acquire::Retries=3 -y -q "$@" >"$log" 2>&1; }
# The package lists may be old or absent: try as it is, then once more with fresh lists.
# shellcheck disable=SC2086
if ! get --no-install-recommends install $missing; then
    get update || { tail -n 20 "$log" >&2; echo "packages: apt-get update failed" >&2; exit 1; }
    get --no-install-recommends install $missing || { tail -n 20 "$log" >&2; echo "packages: apt-get could not install:$missing" >&2; exit 1; }
fi
echo "Installed:$missing"
