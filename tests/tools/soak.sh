#!/usr/bin/env bash
# Tests that the memory of a long process does not grow. A study of the caterpillar runs in each engine, and its memory and open files
# are measured every ten seconds. After the first fifth, the memory may grow by 2 MB, and by 1.5 kB per run up to 20 000 runs, whose rows
# are kept to answer equal points. One additional file may be open, because a run reads its scenario and its module types.
# usage: tests/tools/soak.sh PROGRAM [MINUTES] (default 60 per engine, one engine after the other; the table goes to stdout)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
minutes=${2:-60}

for engine in articulated bullet; do
  cat >"$work/$engine.yaml" <<TEXT
gaitlab_study: 1
name: soak
scenario: $root/scenarios/caterpillar.yaml
set: [physics.engine=$engine, duration=6]
parameters:
  cpg.frequency: {low: 0.1, high: 1, scale: log}
  cpg.amplitude: {low: 0.1, high: 1.2}
  cpg.type: {values: [phase_oscillator, hopf]}
method: {type: random}
budget: {runs: 1000000}
TEXT
  folder=$work/$engine
  runs() { sqlite3 "$folder/study.db" 'select count(*) from run' 2>/dev/null || echo 0; }
  "$program" sweep "$work/$engine.yaml" --quiet --out "$folder" -j 1 >"$work/log" 2>&1 &
  process=$!
  memory=0 files=0 runs_then=0 most_memory=0 most_files=0
  samples=$((minutes * 6))
  for ((k = 1; k <= samples; ++k)); do
    sleep 10
    now=$(awk '/^VmRSS/ { print $2 }' "/proc/$process/status") || { show_log; fail "$engine: the study ended by itself"; }
    open=$(find "/proc/$process/fd" -mindepth 1 | wc -l)
    if ((k * 5 <= samples)); then
      ((memory >= now)) || memory=$now
      ((files >= open)) || files=$open
      runs_then=$(runs)
    fi
    ((most_memory >= now)) || most_memory=$now
    ((most_files >= open)) || most_files=$open
  done
  kill -TERM "$process"
  wait "$process" || true
  ended=$(runs)
  kept=$(((ended < 20000 ? ended : 20000) - (runs_then < 20000 ? runs_then : 20000)))
  line="$engine: $minutes minutes, $ended runs of 6 s; memory $memory kB, then at most $most_memory kB; $most_files open files"
  if ((most_memory - memory > 2048 + kept * 3 / 2 || most_files > files + 1)); then bad "$line (of which $files at the start)"; else ok "$line"; fi
done
verdict
