#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Puts the LAMMPS source tarball of the reference version into a folder through apt, without
# touching the machine's own apt configuration: private lists, private cache, and one deb-src
# line made of the machine's own Debian mirror and the suite that holds the version.
#
# usage: fetch-lammps.sh FOLDER FILE SUITE
set -euo pipefail
if [ $# -ne 3 ]; then
  echo "usage: $0 FOLDER FILE SUITE" >&2
  exit 2
fi
mkdir -p "$1"
dir=$(cd "$1" && pwd)
file=$2
suite=$3
fail() {
  echo "fetch-lammps: $*" >&2
  exit 1
}

command -v apt-get >/dev/null || fail "apt-get not found"
helper=/usr/lib/apt/apt-helper
[ -x $helper ] || fail "$helper not found"

# First mirror of the machine that carries the base distribution (security archives do not).
mirror=$(
  shopt -s nullglob
  {
    for f in /etc/apt/sources.list.d/*.sources; do
      awk 'BEGIN { RS = ""; FS = "\n" }
        { uri = ""; types = ""; comp = ""
          for (i = 1; i <= NF; i++) {
            if ($i ~ /^[ \t]*#/) continue
            if ($i ~ /^Types:/) types = substr($i, 7)
            if ($i ~ /^URIs:/) uri = substr($i, 6)
            if ($i ~ /^Components:/) comp = substr($i, 12)
          }
          n = split(uri, u, /[ \t]+/)
          if (types ~ /deb/ && comp ~ /main/)
            for (i = 1; i <= n; i++) if (u[i] != "") print u[i] }' "$f"
    done
    for f in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
      [ -r "$f" ] || continue
      awk '/^[ \t]*deb(-src)?[ \t]/ && / main/ {
          sub(/^[ \t]*deb(-src)?[ \t]+/, ""); sub(/^\[[^]]*\][ \t]*/, ""); print $1 }' "$f"
    done
  } | grep -v -e security -e '^cdrom:' | head -n 1 || true
)
[ -n "$mirror" ] || fail "no Debian mirror found in /etc/apt/sources.list or sources.list.d"

work=$(mktemp -d "$dir/apt.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/lists/partial" "$work/cache/archives/partial"
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
signed=""
[ -r $keyring ] && signed="[signed-by=$keyring] "
echo "deb-src ${signed}$mirror $suite main" >"$work/src.list"
cat >"$work/apt.conf" <<EOF
Dir::State::Lists "$work/lists";
Dir::State::status "/dev/null";
Dir::Etc::sourcelist "$work/src.list";
Dir::Etc::sourceparts "/dev/null";
Dir::Cache "$work/cache";
APT::Sandbox::User "$(id -un)";
Acquire::Languages "none";
Acquire::Retries "3";
EOF
export APT_CONFIG=$work/apt.conf
apt-get -q -q update </dev/null >&2 || fail "apt-get update failed for suite $suite"
line=$(apt-get source --print-uris lammps </dev/null 2>/dev/null | grep '\.orig\.tar\.' |
  grep -v '\.asc' | head -n 1) || true
[ -n "$line" ] || fail "suite $suite of the machine's mirror has no source package lammps"
url=$(sed "s/^'\([^']*\)'.*/\1/" <<<"$line")
sum=$(sed -n 's/.*\(SHA256:[0-9a-f]*\).*/\1/p' <<<"$line")
[ -n "$sum" ] || fail "the mirror gives no SHA256 for the LAMMPS source"
# The helper checks the sum; the name changes only when the file is whole.
$helper download-file "$url" "$work/part" "$sum" </dev/null >&2 || fail "download failed: $url"
mv "$work/part" "$dir/$file"
