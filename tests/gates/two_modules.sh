# shellcheck shell=bash disable=SC2154 # root: of prelude.sh
# Functions for gates: a small study (two modules, 0.4 s, three parameters, two replicates), and the rows of its journal.

rows() { sqlite3 "$1/study.db" 'select * from run order by run'; }
# count FILE: prints the number of rows of a journal, also while it is written. more_than N FILE: succeeds if it has more than N rows.
count() { { [[ -s $1 ]] && sqlite3 "$1" 'select count(*) from run' 2>/dev/null; } || echo 0; }
more_than() { (($(count "$2") > $1)); }

# two_modules FOLDER LINE...: writes two.yaml, and study.yaml with further lines.
two_modules() {
  cat >"$1/two.yaml" <<TEXT
gaitlab: 1
name: two
robot: {modules: $root/scenarios/modules/mtran.yaml, docks: [[1, 1, 4, 0, 0]]}
contact: {on: all}
physics: {engine: articulated}
cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.6, phase_lag: 1.2}
trace: {period: 0.01}
duration: 0.4
TEXT
  cat >"$1/study.yaml" <<TEXT
gaitlab_study: 1
name: two-random
scenario: two.yaml
parameters:
  cpg.frequency: {low: 0.5, high: 3, scale: log}
  cpg.amplitude: {low: 0.1, high: 1.2}
  cpg.type: {values: [phase_oscillator, hopf]}
replicates: {count: 2, vary: {ground.friction: {uniform: [0.4, 1]}}}
TEXT
  printf '%s\n' "${@:2}" >>"$1/study.yaml"
}
