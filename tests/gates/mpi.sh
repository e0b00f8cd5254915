#!/usr/bin/env bash
# Processes of mpirun simulate a study together. The rows are the same if any process is killed, and independent copies are refused.
# usage: mpi.sh PROGRAM (gaitlab-mpi must be in the folder of PROGRAM)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
mpi=$(dirname -- "$program")/gaitlab-mpi
for needed in mpirun sqlite3; do
  command -v "$needed" >/dev/null || { skip "mpi" "$needed is missing (Debian: openmpi-bin sqlite3)"; exit 77; }
done
[[ -x $mpi ]] || { skip "mpi" "gaitlab-mpi was not built (Debian: libopenmpi-dev)"; exit 77; }
mpirun --version 2>&1 | grep -q 'Open MPI' || { skip "mpi" "mpirun is not Open MPI's"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export TMPDIR=/tmp # for sockets, whose paths must be short

source "$root/tests/gates/two_modules.sh"
two_modules "$work" "method: {type: random}" "budget: {runs: 160}"
# ranks N PROGRAM ARGUMENT...: runs PROGRAM with N processes of mpirun.
ranks() { mpirun --oversubscribe -n "$1" "${@:2}"; }
sweep=("$mpi" sweep "$work/study.yaml" --quiet -j 1)
# same CASE FOLDER: compares the rows in FOLDER with those of the undisturbed study.
same() {
  if diff <(rows "$work/whole") <(rows "$2") >"$work/difference"; then ok "$1"; else bad "$1: $(head -n 4 "$work/difference")"; fi
  [[ $(sqlite3 "$2/study.db" 'pragma integrity_check') == ok ]] || bad "$1: the journal is damaged"
}

expect 0 "$program" sweep "$work/study.yaml" --quiet --out "$work/whole" -j 2
for n in 1 3; do
  expect 0 ranks $n "${sweep[@]}" --out "$work/mpi-$n"
  same "$n ranks" "$work/mpi-$n"
done

# A search, in which the points of a generation depend on the results of earlier generations.
sed '/cpg.type/d; s/^method:.*/method: {type: scbo, population: 8}/; s/^budget:.*/budget: {runs: 64}/' "$work/study.yaml" >"$work/search.yaml"
echo 'guards: none' >>"$work/search.yaml"
"$program" optimize "$work/search.yaml" --quiet --out "$work/search" -j 2 >"$work/log" 2>&1 && code=0 || code=$?
found=0
ranks 3 "$mpi" optimize "$work/search.yaml" --quiet --out "$work/search-3" >"$work/log" 2>&1 || found=$?
((code == found)) || { show_log; bad "optimize: exit code $code, with three ranks $found"; }
verified() { sqlite3 "$1/study.db" 'select * from verification'; }
cmp <(rows "$work/search"; verified "$work/search") <(rows "$work/search-3"; verified "$work/search-3") || bad "optimize with three ranks: other rows"
ok "a search by three ranks"

# killed FOLDER SIGNAL WHO: starts three ranks, sends a signal to mpirun or to a rank (by its number, from 1), and waits. The study has
# 100 000 runs, so that it cannot end before the signal.
begun() { [[ $(tr -s ' ' '\n' <"/proc/$1/task/$1/children" | grep -c .) == 3 ]] && more_than "$2" "$3/study.db"; }
killed() {
  local before who children=()
  before=$(count "$1/study.db")
  mpirun --oversubscribe -n 3 "${sweep[@]}" --out "$1" --runs 100000 >"$work/log" 2>&1 &
  local job=$!
  wait_for "$job" "three ranks and a row" begun "$job" "$before" "$1"
  read -ra children <"/proc/$job/task/$job/children" || true # read fails, because the file has no line end
  who=$job
  (($3 == 0)) || who=${children[$3 - 1]}
  kill "-$2" "$who"
  code=0
  wait "$job" || code=$?
}
for rank in 3 1; do
  killed "$work/killed" 9 "$rank"
  ((code != 0)) || bad "a rank was killed, and mpirun ended with 0"
  more_than 0 "$work/killed/study.db" || bad "a rank was killed: the rows are lost"
done
first() { rows "$1" | head -n 160; }
expect 0 ranks 3 "${sweep[@]}" --out "$work/killed"
cmp <(rows "$work/whole") <(first "$work/killed") || bad "ranks killed, then the same command: other rows"
[[ $(sqlite3 "$work/killed/study.db" 'pragma integrity_check') == ok ]] || bad "ranks killed: the journal is damaged"
ok "ranks killed, then the same command"

killed "$work/stopped" TERM 0
((code != 0)) || bad "SIGTERM: exit code 0"
said "continue with gaitlab sweep"
[[ $(sqlite3 "$work/stopped/study.db" 'select count(*) from attempt') == 0 ]] || bad "SIGTERM: runs that were stopped count as such that ended the process"
expect 0 "$program" sweep "$work/study.yaml" --quiet --out "$work/stopped" -j 2
cmp <(rows "$work/whole") <(first "$work/stopped") || bad "SIGTERM to mpirun, then one process: other rows"
ok "SIGTERM to mpirun, then one process"

# A plugin that ends its process. After two failed attempts, its run is a failed row.
ln -s "$root/scenarios/modules" "$work/modules"
cat >"$work/plugin.yaml" <<TEXT
gaitlab: 1
plugins: [$(plugin throws)]
robot: {modules: mtran, base: fixed}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated}
duration: 0.3
cpg: {type: throws, where: nowhere}
TEXT
for start in 1 2 3; do
  code=0
  ranks 2 "$mpi" sweep "$work/plugin.yaml" --quiet --grid cpg.where=nowhere,output,abort --out "$work/plugin" >"$work/log" 2>&1 || code=$?
  ((start == 3 ? code == 0 : code != 0)) || { show_log; bad "a plugin that ends the process, start $start: exit code $code"; }
done
[[ $(sqlite3 "$work/plugin/study.db" 'select outcome from run' | tr '\n' ' ') == "done plugin crashed " ]] || bad "a plugin that ends the process: other rows"
ok "a plugin that ends the process"

code=0
ranks 2 "$program" sweep "$work/study.yaml" --quiet --out "$work/copies" >"$work/log" 2>&1 || code=$?
((code == 2)) || bad "copies of gaitlab under mpirun: exit code $code"
said "gaitlab sweep: error: was started 2 times side by side (OMPI_COMM_WORLD_SIZE); expected once, as gaitlab-mpi under mpirun"
[[ ! -e $work/copies ]] || bad "copies of gaitlab under mpirun made a folder"
ok "copies of gaitlab are refused"

mkdir "$work/1"
sed 's/high: 1.2/high: 1.3/; s/scenario: /scenario: ..\//' "$work/study.yaml" >"$work/1/study.yaml"
mkdir "$work/0"
sed 's/scenario: /scenario: ..\//' "$work/study.yaml" >"$work/0/study.yaml"
code=0
ranks 2 bash -c "exec '$mpi' sweep '$work'/\$OMPI_COMM_WORLD_RANK/study.yaml --quiet --out '$work/other'" >"$work/log" 2>&1 || code=$?
((code == 2)) || bad "ranks with different files: exit code $code"
said "gaitlab-mpi: error: rank 1 on [^ ]* has another study than rank 0 on"
rm "$work/1/study.yaml"
code=0
ranks 2 bash -c "exec '$mpi' sweep '$work'/\$OMPI_COMM_WORLD_RANK/study.yaml --quiet --out '$work/other'" >"$work/log" 2>&1 || code=$?
((code == 2)) || bad "a rank without the file: exit code $code"
said "rank 1: error: .*/1/study.yaml: error: cannot be read"
[[ ! -e $work/other ]] || bad "ranks with different files made a folder"
ok "ranks with different files are told apart"
verdict
