# shellcheck shell=bash disable=SC2034,SC2154 # variables are for the scripts; program is theirs
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

# Nothing here is decided by a clock: a gate waits for a state, and kills at moments that are counted in CPU time, so that a machine that
# is slow, or does something else, too, changes nothing but how long it takes.

# wait_until PROCESS COMMAND...: until the command succeeds. 1: the process has ended before, or twenty minutes have gone by.
wait_until() {
  local process=$1 end=$((SECONDS + 1200))
  shift
  until "$@"; do
    if ! kill -0 "$process" 2>/dev/null || ((SECONDS > end)); then
      "$@" # it may have succeeded just before the end
      return
    fi
    sleep 0.05
  done
}
# wait_for PROCESS WHAT COMMAND...: the same; where it waits in vain the script ends.
wait_for() { wait_until "$1" "${@:3}" || { show_log; fail "waited in vain for $2"; }; }

# cpu_time CODE COMMAND...: sets `took`, the milliseconds of CPU time of a command that ends with this exit code.
cpu_time() {
  local TIMEFORMAT='%U %S' code=0 user system
  { time "${@:2}" >"$work/log" 2>&1; } 2>"$work/took" || code=$?
  ((code == $1)) || { show_log; fail "exit code $code, expected $1: ${*:2}"; }
  IFS=' ' read -r user system < <(tr -d '.,' <"$work/took")
  took=$((10#$user + 10#$system))
}

# kill_after MILLISECONDS COMMAND...: the kernel ends the command after so much CPU time of all its threads, as kill -9 does (the
# program does not catch SIGPROF). 1: it had ended before, with `code`.
kill_after() {
  code=0
  # shellcheck disable=SC2016 # words of Perl
  { perl -MTime::HiRes=setitimer,ITIMER_PROF -e 'setitimer(ITIMER_PROF, shift() / 1000); exec { $ARGV[0] } @ARGV or die' \
    "$@"; } >/dev/null 2>&1 || code=$?
  ((code == 128 + $(kill -l PROF)))
}

# A series of N kills, each of a program that runs: a try that came too late does not count, and at most ten times N are made.
#     kills N
#     while kills_left; do try_to_kill FROM TO COMMAND... || COMMAND had ended before; done    (FROM to TO: milliseconds)
#     kills_told WHAT
kills() { wanted=$1 hits=0 tries=0; }
kills_left() { ((hits < wanted && tries < 10 * wanted)); }
try_to_kill() {
  tries=$((tries + 1))
  kill_after $((1 + $1 + RANDOM * ($2 - $1) / 32768)) "${@:3}" || return
  hits=$((hits + 1))
}
kills_told() {
  local line="$1: killed $hits times while it ran, $((tries - hits)) of $tries tries came too late"
  if ((hits == wanted)); then ok "$line"; else bad "$line; expected $wanted kills"; fi
}

# plugin NAME: the library of tests/plugin_example/NAME.cpp in the build of $program.
plugin() { readlink -e -- "$(dirname -- "$program")/../plugins/$1.so" || fail "there is no plugin $1 beside $program"; }
# The runs of the plugin `waits` wait from `hold` to `release`.
hold() {
  export GAITLAB_HOLD=$work/hold
  mkdir -- "$GAITLAB_HOLD"
}
release() { mv -- "$GAITLAB_HOLD" "$(mktemp -u "$work/released.XXXXXX")"; } # at once, whoever writes into it
# kill_in_the_middle WHAT COMMAND...: by kill -9, while a run of it waits.
kill_in_the_middle() {
  local process
  code=0
  hold
  "${@:2}" >"$work/log" 2>&1 &
  process=$!
  wait_for "$process" "a run of $1" test -e "$GAITLAB_HOLD/$process"
  kill -9 "$process"
  wait "$process" 2>/dev/null || code=$?
  release
  ((code == 128 + 9)) || bad "$1: killed in the middle of a run, exit code $code"
}

# kill_at_call N COMMAND...: with tests/plugin_example/dies_at_call.cpp of $program's build, as by kill -9. 1: there is no call N.
kill_at_call() {
  code=0
  { env LD_PRELOAD="$(plugin dies_at_call)" GAITLAB_DIES_AT="$1" "${@:2}"; } >"$work/log" 2>&1 || code=$?
  ((code == 128 + 9))
}
