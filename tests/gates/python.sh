#!/usr/bin/env bash
# What docs/tutorials/optuna.md and docs/studies.md do in Python, as it stands there: with Optuna, also killed and started again, and
# with pandas.
# usage: python.sh PROGRAM
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
python=/usr/bin/python3 # Debian's
for module in optuna pandas; do
  "$python" -c "import $module" 2>/dev/null || { skip "python" "Python's module $module is missing (Debian: python3-$module)"; exit 77; }
done
command -v sqlite3 >/dev/null || { skip "python" "sqlite3 is missing (Debian: sqlite3)"; exit 77; }
PATH=$(dirname -- "$program"):$PATH
cd "$work"
# block WORD: the indented block of the tutorial that begins with a word.
block() { awk -v word="$1" '/^    / && !on && !blank { on = index($0, word) == 5 } /^    / || (/^$/ && on) { if (on) print substr($0, 5); blank = 1; next } { on = blank = 0 }' "$root/docs/tutorials/optuna.md"; }
block gaitlab_study >study.yaml
block import >tune.py
ln -s "$root/scenarios" .

"$python" tune.py >first &
process=$!
for _ in $(seq 200); do
  [[ -s runs/optuna/study.db ]] && (($(sqlite3 runs/optuna/study.db 'select count(*) from run' 2>/dev/null || echo 0) >= 8)) && break
  sleep 0.1
done
kill -9 "$process" 2>/dev/null || bad "Optuna had ended before it could be killed"
wait "$process" 2>/dev/null || true
for _ in $(seq 100); do flock -n runs/optuna/lock true && break || sleep 0.1; done # it sees that nobody asks any more
expect 0 "$python" tune.py
cp -- "$work/log" second
[[ $(sqlite3 runs/optuna/study.db 'select count(*) from run') == 40 ]] || bad "40 trials, $(sqlite3 runs/optuna/study.db 'select count(*) from run') rows"
expect 0 "$python" tune.py
cmp "$work/log" second || bad "started again with its seed, Optuna ends elsewhere"
[[ $(sqlite3 runs/optuna/study.db 'select sum(runs) from effort') == 40 ]] || bad "started again, runs are done again"
grep -q "cpg.phase_lag" second || bad "no best gait: $(<second)"
ok "Optuna, killed and started again: $(<second)"

line=$(sed -n 's/.*`\(pandas[.]read_sql(.*)\)`.*/\1/p' "$root/docs/studies.md")
[[ -n $line ]] || fail "docs/studies.md has no line of pandas"
cd runs/optuna
expect 0 "$python" -c "import pandas, sqlite3; table = $line; print(len(table), table['cpg.phase_lag'].dtype, table['speed'].max() > 0)"
said "^40 float64 True"
ok "pandas reads the journal"
verdict
