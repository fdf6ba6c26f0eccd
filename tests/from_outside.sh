# SPDX-License-Identifier: GPL-2.0-or-later
# Common ground of the tests from outside, sourced with the program as first argument: a folder of
# its own for the test, and ways to run the program there.
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
run() { "$program" "$@" > out.txt 2> err.txt; }
must_run() { run "$@" || fail "$* ended with $?: $(cat err.txt)"; }
