# SPDX-License-Identifier: GPL-2.0-or-later
# Common ground of the tests of postproc from outside, sourced with the program as first argument.
# shellcheck source=tests/from_outside.sh
source "$(dirname "${BASH_SOURCE[0]}")/../from_outside.sh" "$1"

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
# told PATTERN: a line of out.txt, its columns one blank apart.
told() { tr -s ' ' < out.txt | grep -q -- "$1"; }

# packed: the PE series of text in, header lines and rows step,time,pe, as the binary file out.
packed() {
  perl -F, -lane 'BEGIN { $\ = "" }
    if (/^#.* = /) { $header .= "$_\n" }
    elsif (/^[0-9]/) { $rows .= pack("q<d<", $F[0], $F[2]) }
    END { print "lsm-pe-series-1\n", pack("q<", length $header), $header, $rows }'
}
