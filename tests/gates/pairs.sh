#!/usr/bin/env bash
# If two processes write one target at the same time, the result is complete and from one process, and the other process has an error.
# usage: pairs.sh PROGRAM [N] (N is the number of pairs of each kind, 5 by default)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
pairs=${2:-5}
cd -- "$work"
run=("$program" run "$root/scenarios/pendulum.yaml" --quiet --set duration=2 --set trace.period=1e-3)
expect 0 "${run[@]}" --out a
expect 0 "${run[@]}" --set initial.angles=0.3 --out b
expect 0 "$program" export a --to csv a.csv
expect 0 "$program" export b --to csv b.csv

# both FIRST... -- SECOND...: runs both commands at the same time. Sets their exit codes `one` and `two`, and writes their outputs to
# first.log and second.log.
both() {
  local first=()
  while [[ $1 != -- ]]; do first+=("$1") && shift; done
  shift
  "${first[@]}" >first.log 2>&1 &
  local job=$!
  two=0
  "$@" >second.log 2>&1 || two=$?
  one=0
  wait "$job" || one=$?
}
# the_loser_is_told KIND: expects that one command ended with 0, and the other with 2 and a message.
the_loser_is_told() {
  if ((one == 0 && two == 2)); then [[ -s second.log ]] || bad "$1: the loser was told nothing"
  elif ((one == 2 && two == 0)); then [[ -s first.log ]] || bad "$1: the loser was told nothing"
  else bad "$1: exit codes $one and $two: $(cat first.log second.log)"
  fi
}

for ((i = 0; i < pairs; ++i)); do
  both "$program" export a --to csv "c-$i.csv" -- "$program" export b --to csv "c-$i.csv"
  the_loser_is_told export
  cmp -s "c-$i.csv" a.csv || cmp -s "c-$i.csv" b.csv || bad "export: a mixture"

  both "${run[@]}" --out "r-$i" -- "${run[@]}" --set initial.angles=0.3 --out "r-$i"
  the_loser_is_told run
  quietly "$program" rerun "r-$i" --verify || bad "run: the folder is not of one run"

  both "$program" new plugin cpg mine --out "n-$i" -- "$program" new plugin cpg other --out "n-$i"
  the_loser_is_told "new plugin"
  cp a/scenario.resolved.yaml s.yaml
  rm -rf s.golden
  both "$program" approve s.yaml --reason one -- "$program" approve s.yaml --reason two
  ((one == 0 || two == 0)) || bad "approve: exit codes $one and $two: $(cat first.log second.log)"
  quietly "$program" test s.yaml || bad "approve: the golden is a mixture"
done
# The refused processes leave no files.
left=$(find . -name '*.part' -o -name '.*.part')
[[ -z $left ]] || bad "left: $left"
ok "$pairs pairs each of export, run, new plugin and approve"
verdict
