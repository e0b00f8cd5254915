# shellcheck shell=bash disable=SC2034,SC2154 # scripts use the variables, and set `program`
# Common start of all scripts in tests/gates and tests/tools: strict mode, the folder of the project, a temporary folder that is removed
# at the end, and functions that report results.
set -euo pipefail

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
failed=0 skipped=0

# Prints the comment at the head of the script, and ends the script.
usage() {
  sed -n '2,/^[^#]/s/^# //p' "$0" >&2
  exit 2
}

ok() { printf 'ok       %s\n' "$*"; }
# Messages go to stderr, so that they also appear from within $(...).
bad() {
  failed=$((failed + 1))
  printf 'BAD      %s\n' "$*" >&2
}
# skip WHAT WHY: reports a skipped case.
skip() {
  skipped=$((skipped + 1))
  printf 'SKIPPED  %s: NOT TESTED: %s\n' "$1" "$2" >&2
}
# Last line of scripts that continue after a failure.
verdict() {
  printf '%d bad, %d skipped\n' "$failed" "$skipped"
  ((failed == 0))
}

# Reports a failure and ends the script.
fail() {
  bad "$@"
  exit 1
}

# Prints the output of the last command of `quietly` or `expect`.
show_log() { tail -n 100 -- "$work/log" >&2; }
# quietly COMMAND...: returns the exit code of COMMAND. The output is printed only if the exit code is not 0.
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
# said PATTERN: the output of the last of these commands must contain PATTERN, with any line breaks.
said() { tr -s '\n ' ' ' <"$work/log" | grep -- "$1" >/dev/null || { show_log; fail "did not say '$1'"; }; }

# replace FILE BY: replaces FILE atomically. `mv` alone would copy if $work is on a different file system.
replace() { cp -- "$2" "$1.part" && mv -- "$1.part" "$1"; }

# Gates do not depend on real time. They wait for a state, and kill at moments that are measured in CPU time, so that a slow or busy
# machine only makes them longer.

# wait_until PROCESS COMMAND...: waits until COMMAND succeeds. Returns 1 if the process has ended before, or after twenty minutes.
wait_until() {
  local process=$1 end=$((SECONDS + 1200))
  shift
  until "$@"; do
    if ! kill -0 "$process" 2>/dev/null || ((SECONDS > end)); then
      "$@" # the state may have occurred just before the process ended
      return
    fi
    sleep 0.05
  done
}
# wait_for PROCESS WHAT COMMAND...: waits until COMMAND succeeds, and ends the script with a failure if it does not.
wait_for() { wait_until "$1" "${@:3}" || { show_log; fail "waited in vain for $2"; }; }

# cpu_time CODE COMMAND...: sets `took`, the milliseconds of CPU time of a command that ends with this exit code.
cpu_time() {
  local TIMEFORMAT='%U %S' code=0 user system
  { time "${@:2}" >"$work/log" 2>&1; } 2>"$work/took" || code=$?
  ((code == $1)) || { show_log; fail "exit code $code, expected $1: ${*:2}"; }
  IFS=' ' read -r user system < <(tr -d '.,' <"$work/took")
  took=$((10#$user + 10#$system))
}

# kill_after MILLISECONDS COMMAND...: the kernel ends COMMAND after this CPU time of all its threads, like kill -9 (the program does not
# catch SIGPROF). Returns 1 if COMMAND has ended before, with the exit code `code`.
kill_after() {
  code=0
  # shellcheck disable=SC2016 # words of Perl
  { perl -MTime::HiRes=setitimer,ITIMER_PROF -e 'setitimer(ITIMER_PROF, shift() / 1000); exec { $ARGV[0] } @ARGV or die' \
    "$@"; } >/dev/null 2>&1 || code=$?
  ((code == 128 + $(kill -l PROF)))
}

# A series of N kills of running programs. A kill that is too late does not count, and there are at most 10 N attempts.
#     kills N
#     while kills_left; do try_to_kill FROM TO COMMAND... || COMMAND had ended before; done    (FROM and TO are in milliseconds)
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

# plugin NAME: prints the path of the library of tests/plugin_example/NAME.cpp in the build of $program.
plugin() { readlink -e -- "$(dirname -- "$program")/../plugins/$1.so" || fail "there is no plugin $1 beside $program"; }
# The runs of the plugin `waits` wait from `hold` to `release`.
hold() {
  export GAITLAB_HOLD=$work/hold
  mkdir -- "$GAITLAB_HOLD"
}
release() { mv -- "$GAITLAB_HOLD" "$(mktemp -u "$work/released.XXXXXX")"; } # atomic, also if a process writes into the folder
# kill_in_the_middle WHAT COMMAND...: ends COMMAND by kill -9 while one of its runs waits.
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

# kill_at_call N COMMAND...: ends COMMAND, like kill -9, at call N that changes a file, by tests/plugin_example/dies_at_call.cpp of
# $program's build. Returns 1 if there are fewer than N calls.
kill_at_call() {
  code=0
  { env LD_PRELOAD="$(plugin dies_at_call)" GAITLAB_DIES_AT="$1" "${@:2}"; } >"$work/log" 2>&1 || code=$?
  ((code == 128 + 9))
}
# fail_at_call N once|on COMMAND...: runs COMMAND whose call N that changes a file fails (EIO), or all of them from N on (ENOSPC).
fail_at_call() {
  local on=()
  code=0
  [[ $2 == once ]] || on=(GAITLAB_FAILS_ON=1)
  env LD_PRELOAD="$(plugin dies_at_call)" GAITLAB_FAILS_AT="$1" "${on[@]}" "${@:3}" >"$work/log" 2>&1 || code=$?
}
