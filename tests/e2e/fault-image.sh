#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Pictures of every fourth of 20 steps, and one by itself: fault-image.sh LMP SOURCE_DIR
set -u
lmp=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
fail() { echo "FAILED: $*" >&2; tail -n 20 out.txt >&2; exit 1; }
picture() {
  "$lmp" -in "$source/inputs/fault.in" -log none -var length 20 -var width 15 -var settle 100 -var steps 20 -var extra fault_image \
    -var pixels 400 -var high 300 "$@" >out.txt 2>&1 </dev/null || fail "$*"
}
picture -var prefix film -var from 102 -var to 118 -var every 4
[ "$(echo film.*.png)" = "$(printf " film.%09d.png" 102 106 110 114 118 | cut -c 2-)" ] || fail "pictures: $(echo *.png)"
picture -var prefix one -var from 110 -var to 111 -var every 9
[ "$(echo one.*.png)" = one.000000110.png ] || fail "pictures: $(echo *.png)"
for file in *.png; do
  [ "$(head -c 4 "$file" | tail -c 3)" = PNG ] && [ "$(stat -c %s "$file")" -gt 5000 ] || fail "$file is no picture"
done
