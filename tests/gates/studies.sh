#!/usr/bin/env bash
# A study has the same rows with any number of threads, lanes and shards, and after signals and kill -9, and loses no rows.
# usage: studies.sh PROGRAM [KILLS] (KILLS is the number of kills of each kind, 6 by default; KILL_SEED, 1 by default, selects the moments)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
kills=${2:-6}
RANDOM=${KILL_SEED:-1}
command -v sqlite3 >/dev/null || { skip "studies" "sqlite3 is missing (Debian: sqlite3)"; exit 77; }

source "$root/tests/gates/two_modules.sh"
two_modules "$work" "method: {type: random}" "budget: {runs: 96}"

sweep() { "$program" sweep "$work/study.yaml" --quiet "$@"; }
# same CASE FOLDER: compares the rows in FOLDER with those of the undisturbed study.
same() {
  if diff <(rows "$work/whole") <(rows "$2") >"$work/difference"; then ok "$1"; else bad "$1: $(head -n 4 "$work/difference")"; fi
  [[ $(sqlite3 "$2/study.db" 'pragma integrity_check') == ok ]] || bad "$1: the journal is damaged"
}

cpu_time 0 sweep --out "$work/whole" -j 2
[[ $(rows "$work/whole" | wc -l) == 96 ]] || bad "96 runs, $(rows "$work/whole" | wc -l) rows"

for options in "-j 1" "-j 7" "--lanes 1" "--lanes 4 -j 2"; do
  # shellcheck disable=SC2086 # words
  expect 0 sweep --out "$work/now" $options
  same "$options" "$work/now"
  cmp -- "$work/whole/table.csv" "$work/now/table.csv" || bad "$options: table.csv"
  rm -rf -- "$work/now"
done

for index in 2 0 1; do expect 0 sweep --out "$work/shards" --shard "$index/3"; [[ $index != 0 ]] || expect 1 "$program" study merge "$work/shards"; done
expect 0 "$program" study merge "$work/shards"
expect 0 "$program" study merge "$work/shards"
same "three shards, merged twice" "$work/shards"

# Kills at random moments. Each start continues the killed study. The rows of a completed study are compared, and the next start begins
# with an empty folder.
kills "$kills"
while kills_left; do
  try_to_kill 0 $((took / 2)) "$program" sweep "$work/study.yaml" --quiet --out "$work/killed" -j 2 ||
    { same "killed $hits times, to its end" "$work/killed" && rm -r "$work/killed"; }
done
kills_told sweep
expect 0 sweep --out "$work/killed" -j 2
same "killed $hits times" "$work/killed"

# On SIGTERM the program prints how to continue, with exit code 1. The study has 100 000 runs, so that it cannot end before the signal.
"$program" sweep "$work/study.yaml" --quiet --out "$work/stopped" -j 1 --runs 100000 >"$work/log" 2>&1 &
process=$!
wait_for "$process" "a row" more_than 0 "$work/stopped/study.db"
kill -TERM "$process"
code=0
wait "$process" || code=$?
((code == 1)) || bad "SIGTERM: exit code $code"
said "continue with gaitlab sweep"
[[ $(sqlite3 "$work/stopped/study.db" 'select count(*) from attempt') == 0 ]] || bad "SIGTERM: a run that was stopped counts as one that ended the process"
expect 0 sweep --out "$work/stopped" -j 1
if cmp <(rows "$work/whole") <(rows "$work/stopped" | head -n 96); then ok "SIGTERM, then the same command"; else bad "SIGTERM: other rows"; fi

# A second process in the folder is refused.
exec 9>>"$work/whole/lock"
flock 9
expect 2 sweep --out "$work/whole"
said "is writing this study"
exec 9>&-
ok "a second process is refused"

# With a larger budget the study continues. A different study is refused.
sed -i 's/runs: 96/runs: 112/' "$work/study.yaml"
expect 0 sweep --out "$work/killed" -j 2
expect 0 sweep --out "$work/more" -j 2
diff <(rows "$work/killed") <(rows "$work/more") || bad "96 runs and then 112 are not 112 at once"
sed -i 's/high: 1.2/high: 1.3/' "$work/study.yaml"
expect 2 sweep --out "$work/more"
said "belongs to another study"
[[ $(rows "$work/more" | wc -l) == 112 ]] || bad "a study that was refused lost rows"
sed -i 's/high: 1.3/high: 1.2/' "$work/study.yaml"
ok "a larger budget goes on, another study is refused"

# Searches have the same runs, generations and verification with any threads and lanes and after kills. A larger budget continues them.
all_rows() { sqlite3 "$1/study.db" 'select * from run order by run; select * from search; select * from verification'; }
# searched CASE STUDY FOLDER EXPECTED OPTIONS...: runs a search with exit code EXPECTED, and compares its rows with those of FOLDER.
searched() {
  local name=$1 study=$2 folder=$3 code=$4
  shift 4
  expect "$code" "$program" optimize "$study" --quiet --out "$work/now" "$@"
  if diff <(all_rows "$folder") <(all_rows "$work/now") >"$work/difference"; then ok "$name"; else bad "$name: $(head -n 4 "$work/difference")"; fi
}
for kind in scbo cma_gp cma nsga2; do
  sed -n '1,/^parameters/p' "$work/study.yaml" | sed "s/two-random/two-$kind/" >"$work/$kind.yaml"
  cat >>"$work/$kind.yaml" <<TEXT
  cpg.frequency: {low: 0.5, high: 3, scale: log}
  cpg.amplitude: {low: 0.1, high: 1.2}
guards: none
verify: {best: 2, change: 0.2}
budget: {runs: 80}
TEXT
done
# Without guards, the best points exceed the rated speed, which a longer run cannot undo. They are found but not verified.
for kind in scbo cma_gp cma; do
  printf 'set: [actuator.speed_max=0.01]\nobjective: {maximize: speed}\nmethod: {type: %s, population: 8, instances: 2}\n' "$kind" >>"$work/$kind.yaml"
done
# The duration is three periods of the slowest gait, because points that cannot be judged are not verified.
sed -i 's/low: 0.5, high: 3/low: 1.5, high: 3/' "$work/nsga2.yaml"
printf 'set: [duration=2]\nobjective: [{minimize: torque.peak}, {maximize: distance}]\nmethod: {type: nsga2, population: 16}\n' >>"$work/nsga2.yaml"
for kind in scbo cma_gp cma nsga2; do
  ends=0 # expected exit code
  [[ $kind == nsga2 ]] || ends=3
  cpu_time "$ends" "$program" optimize "$work/$kind.yaml" --quiet --out "$work/$kind" -j 2
  [[ $(rows "$work/$kind" | wc -l) == 80 ]] || bad "$kind: 80 runs, $(rows "$work/$kind" | wc -l) rows"
  searched "$kind: -j 1 --lanes 1" "$work/$kind.yaml" "$work/$kind" "$ends" -j 1 --lanes 1
  rm -rf -- "$work/now"
  kills "$kills"
  while kills_left; do
    try_to_kill 0 $((took / 2)) "$program" optimize "$work/$kind.yaml" --quiet --out "$work/now" -j 2 ||
      { searched "$kind: killed $hits times, to its end" "$work/$kind.yaml" "$work/$kind" "$ends" && rm -r "$work/now"; }
  done
  kills_told "$kind"
  searched "$kind: killed $hits times" "$work/$kind.yaml" "$work/$kind" "$ends" -j 7
  rm -rf -- "$work/now"
  "$program" optimize "$work/$kind.yaml" --quiet --out "$work/now" --runs 50 >/dev/null 2>&1 || true # verification may fail
  searched "$kind: 50 runs and then 80" "$work/$kind.yaml" "$work/$kind" "$ends"
  rm -rf -- "$work/now"
done
[[ -s $work/nsga2/best/report.html && -s $work/nsga2/front.svg && -s $work/cma/convergence.svg ]] || bad "optimize: files are missing"
[[ ! -e $work/cma/best ]] || bad "optimize: a winner that was not verified has a folder"
[[ $(sqlite3 "$work/cma/study.db" 'select count(*) from verification where not verified and reason like "%the verdict is infeasible: %"') -ge 1 ]] ||
  bad "optimize: no reason why the winner was not verified"
expect 2 "$program" sweep "$work/cma.yaml"
said "use gaitlab optimize"

# The folder of the best point is replaced as a whole: if the disk becomes full, the previous folder remains.
best() { (cd -- "$work/nsga2/best" && find . -type f -exec sha256sum -- {} + | sort -k 2); }
best >"$work/best"
code=0
(ulimit -f 500 && exec "$program" optimize "$work/nsga2.yaml" --quiet --out "$work/nsga2") >"$work/log" 2>&1 || code=$? # blocks of 1 kB
((code == 1)) || bad "optimize on a full disk: exit code $code"
said "report.html: cannot be written"
said "nsga2/best: error: not written"
cmp -- "$work/best" <(best) || bad "optimize on a full disk: another best/"
expect 0 "$program" optimize "$work/nsga2.yaml" --quiet --out "$work/nsga2"
diff <(best | grep -v summary.json) <(grep -v summary.json "$work/best") || bad "optimize again: another best/"
[[ -z $(find "$work/nsga2" -name 'best.*') ]] || bad "optimize leaves $(ls "$work/nsga2")"
ok "optimize on a full disk: the folder of the best point stays"

# If the disk becomes full, rows of the journal are preserved, and the same command continues the study.
(
  ulimit -f 150 # blocks of 1 kB
  code=0
  sweep --out "$work/full" -j 1 >"$work/full.log" 2>&1 || code=$?
  echo "$code" >"$work/full.code"
)
if [[ $(<"$work/full.code") == 1 ]] && grep -q "cannot be written" "$work/full.log"; then ok "a full disk is told"; else bad "a full disk: exit code $(<"$work/full.code"), $(<"$work/full.log")"; fi
[[ $(sqlite3 "$work/full/study.db" 'pragma integrity_check') == ok ]] || bad "a full disk: the journal is damaged"
expect 0 sweep --out "$work/full" -j 2
diff <(rows "$work/full") <(rows "$work/more") || bad "after a full disk: other rows"
verdict
