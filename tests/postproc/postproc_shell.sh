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

# refused PATTERN ARGUMENTS...: exit 1, one line that matches, nothing written.
refused() {
  local pattern=$1 before
  shift
  : > out.txt > err.txt
  before=$(ls -A)
  run "$@"
  [ $? = 1 ] || fail "exit status is not 1 for: $*"
  [ "$(wc -l < err.txt)" = 1 ] || fail "not one line for $*: $(cat err.txt)"
  grep -q "^postproc: " err.txt || fail "message for $* is '$(cat err.txt)'"
  grep -q -e "$pattern" err.txt || fail "message for $* is '$(cat err.txt)', expected '$pattern'"
  [ "$(ls -A)" = "$before" ] || fail "output left behind by $*: $(ls -A)"
}
