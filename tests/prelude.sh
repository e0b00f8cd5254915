# shellcheck shell=bash disable=SC2034 # variables are for the scripts
# What every script of tests/gates and tests/tools begins with: strict mode, the folder of the project, a folder that is gone at the
# end, and one way to say what was found.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
failed=0 skipped=0

# The comment at the head of the script.
usage() {
  sed -n '2,/^[^#]/s/^# //p' "$0" >&2
  exit 2
}

ok() { printf 'ok       %s\n' "$*"; }
# On stderr: seen from within $(...), too.
bad() {
  failed=$((failed + 1))
  printf 'BAD      %s\n' "$*" >&2
}
# skip WHAT WHY
skip() {
  skipped=$((skipped + 1))
  printf 'SKIPPED  %s: NOT TESTED: %s\n' "$1" "$2" >&2
}
# For scripts that go on after what is bad: their last line.
verdict() {
  printf '%d bad, %d skipped\n' "$failed" "$skipped"
  ((failed == 0))
}

# For scripts that end at what is bad.
fail() {
  bad "$@"
  exit 1
}

# What the last command of `quietly` or `expect` said.
show_log() { tail -n 100 -- "$work/log" >&2; }
# quietly COMMAND...: its exit code; what it says is shown where that is not 0.
quietly() {
  local code=0
  "$@" >"$work/log" 2>&1 || code=$?
  ((code == 0)) || show_log
  return "$code"
}
# expect CODE COMMAND...: any other exit code ends the script.
expect() {
  local code=0
  "${@:2}" >"$work/log" 2>&1 || code=$?
  ((code == $1)) || { show_log; fail "exit code $code, expected $1: ${*:2}"; }
}
# said PATTERN: the last of these commands must have said so, wherever it broke its lines.
said() { tr -s '\n ' ' ' <"$work/log" | grep -- "$1" >/dev/null || { show_log; fail "did not say '$1'"; }; }

# replace FILE BY: changes the file whole or not at all; `mv` alone would copy where $work is on another disk.
replace() { cp -- "$2" "$1.part" && mv -- "$1.part" "$1"; }
