#!/usr/bin/env bash
# The gate of docs/determinism.md: the bytes of trace, resolved scenario, verdict and page do not depend on the environment.
# usage: determinism.sh PROGRAM [SCENARIO]; exit code 0 if all cases are equal or skipped (with a message), 1 if a case differs
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
scenario=$(readlink -f -- "${2:-$root/scenarios/caterpillar.yaml}")
arguments=(run "$scenario" --set duration=3)

# same CASE FOLDER: compares the run in FOLDER with the reference.
same() {
  local file
  for file in trace.h5 scenario.resolved.yaml verdict.json report.html; do
    cmp -- "$work/reference/$file" "$2/$file" || { bad "$1: $file differs"; return 0; }
  done
  ok "$1"
}

# once CASE COMMAND...: runs `COMMAND... program run ... --out FOLDER` and compares the run with the reference.
once() {
  local name=$1 out
  shift
  out=$(mktemp -d "$work/run-XXXX")
  if quietly "$@" "$program" "${arguments[@]}" --quiet --out "$out"; then same "$name" "$out"; else bad "$name: the run failed"; fi
}

other_folder() {
  mkdir -p "$work/some where/else"
  (cd -- "$work/some where/else" && "$program" "${arguments[@]}" --quiet --out "deep/er" >/dev/null)
  same "another working folder" "$work/some where/else/deep/er"
}

# All installed locales, and a German locale (decimal comma), which this function builds if localedef has its source.
locales() {
  local name made=$work/locales
  for name in C $(locale -a | grep -vx C); do once "LC_ALL=$name" env LC_ALL="$name"; done
  mkdir -p "$made"
  if command -v localedef >/dev/null && localedef -i de_DE -f UTF-8 "$made/de_DE.UTF-8" >/dev/null 2>&1 &&
    [[ $(LOCPATH=$made LC_ALL=de_DE.UTF-8 locale decimal_point) == , ]]; then
    # Leak detection is off, because with LOCPATH a library of HDF5 (newlocale of libp11-kit) leaks 44 bytes before main.
    once "LC_ALL=de_DE.UTF-8, a decimal comma" \
      env LOCPATH="$made" LC_ALL=de_DE.UTF-8 ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
  else
    skip "a locale with a decimal comma" "localedef cannot make de_DE.UTF-8 (Debian: package locales)"
  fi
}

# A run with a progress bar and a summary on the terminal, which --quiet would omit.
terminal() {
  local out=$work/terminal command
  if ! command -v script >/dev/null || ! script -qec 'test -t 1 && test -t 2' /dev/null </dev/null >/dev/null 2>&1; then
    skip "on a terminal" "script(1) is missing or gives none (Debian: package bsdutils)"
    return 0
  fi
  printf -v command '%q ' "$program" "${arguments[@]}" --out "$out"
  script -qec "$command" /dev/null </dev/null >"$work/screen"
  grep -q '\[#' "$work/screen" || bad "on a terminal: it showed no bar, so it saw no terminal"
  same "on a terminal" "$out"
  colours
}

# Output has colours only on a terminal, and only if NO_COLOR is empty or not set (https://no-color.org).
colours() {
  local command before=$failed
  printf -v command '%q ' "$program" report "$work/reference"
  # coloured COMMAND: succeeds if the output of COMMAND on a terminal has colours.
  coloured() { script -qec "$1" /dev/null </dev/null | grep $'\033\\[3[123]m' >/dev/null; }
  coloured "$command" || bad "on a terminal: no colours"
  coloured "env NO_COLOR= $command" || bad "on a terminal with an empty NO_COLOR: no colours"
  if coloured "env NO_COLOR=1 $command"; then bad "on a terminal with NO_COLOR=1: colours"; fi
  if coloured "$command | cat"; then bad "in a pipe: colours"; fi
  ((failed > before)) || ok "colours on a terminal alone, without NO_COLOR"
}

address_space() {
  if ! command -v setarch >/dev/null || ! setarch -R true 2>/dev/null; then
    skip "address space not randomised" "setarch -R is missing or not allowed here"
    return 0
  fi
  once "address space not randomised" setarch -R
  local setting
  setting=$(cat /proc/sys/kernel/randomize_va_space 2>/dev/null || true)
  [[ $setting == 2 ]] || skip "address space randomised" "kernel.randomize_va_space is '$setting', not 2"
}

rerun() {
  local text
  "$program" rerun "$work/reference" --quiet --out "$work/again" >/dev/null
  "$program" report "$work/again" --page "$work/again/report.html" >/dev/null
  same "rerun from the run folder" "$work/again"
  if ! text=$("$program" rerun "$work/reference" --verify) || [[ $text != *bit-equal* ]]; then
    printf '%s\n' "$text"
    bad "rerun --verify: not bit-equal"
  else
    ok "rerun --verify"
  fi
}

# Approved goldens, and the output and files of `gaitlab test` (also of a failed gait), are the same with one and two threads.
jobs() {
  local j name goldens
  for j in 1 2; do
    goldens=$work/jobs-$j/goldens
    mkdir -p "$goldens"
    for name in a b; do
      sed "s/^name: .*/name: $name/; s/^duration: .*/duration: 0.2/; s/accuracy: 0.01$/accuracy: 0.001/" "$work/reference/scenario.resolved.yaml" >"$goldens/$name.yaml"
      quietly "$program" approve "$goldens/$name.yaml" -j "$j" --reason "determinism.sh" || { bad "approve failed"; return 0; }
    done
    sed -i 's/amplitude: 0.6$/amplitude: 0.5/' "$goldens/b.yaml"
    (cd -- "$work/jobs-$j" && "$program" test goldens -j "$j" --junit junit.xml >out 2>err) && bad "test -j $j: b should fail"
  done
  sed -i -E 's/ time="[0-9.]+"//' "$work"/jobs-?/junit.xml  # removes computing times
  [[ -d $work/jobs-1/runs ]] || bad "test: no figure of what failed"
  if diff -r "$work/jobs-1" "$work/jobs-2"; then
    ok "gaitlab approve and test -j 1 and -j 2 (goldens, table, figure, XML)"
  else
    bad "gaitlab approve or test differ with -j 1 and -j 2"
  fi
}

expect 0 "$program" "${arguments[@]}" --quiet --out "$work/reference"
once "run twice"
once "an almost empty environment" env -i
once "another umask and open files" bash -c 'umask 077; exec 7</dev/null 8</dev/null; exec "$@"' bash
other_folder
locales
terminal
address_space
rerun
jobs
verdict
