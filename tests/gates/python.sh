#!/usr/bin/env bash
# The literal Python code of docs/tutorials/optuna.md and docs/studies.md works: with Optuna, also after a kill and a restart, and with
# pandas.
# usage: python.sh PROGRAM
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
python=/usr/bin/python3 # Python of Debian
for module in optuna pandas; do
  "$python" -c "import $module" 2>/dev/null || { skip "python" "Python's module $module is missing (Debian: python3-$module)"; exit 77; }
done
source "$root/tests/gates/two_modules.sh"
command -v sqlite3 >/dev/null || { skip "python" "sqlite3 is missing (Debian: sqlite3)"; exit 77; }
PATH=$(dirname -- "$program"):$PATH
cd "$work"
# block WORD: prints the indented block of the tutorial that begins with WORD.
block() { awk -v word="$1" '/^    / && !on && !blank { on = index($0, word) == 5 } /^    / || (/^$/ && on) { if (on) print substr($0, 5); blank = 1; next } { on = blank = 0 }' "$root/docs/tutorials/optuna.md"; }
block gaitlab_study >study.yaml
block import >tune.py
ln -s "$root/scenarios" .

expect 0 "$python" tune.py
cp -- "$work/log" first
grep -q "cpg.phase_lag" first || bad "no best gait: $(<first)"
[[ $(count runs/optuna/study.db) == 40 ]] || bad "40 trials, $(count runs/optuna/study.db) rows"
expect 0 "$python" tune.py
cmp "$work/log" first || bad "started again with its seed, Optuna ends elsewhere"
[[ $(sqlite3 runs/optuna/study.db 'select sum(runs) from effort') == 40 ]] || bad "started again, runs are done again"
mv runs/optuna runs/whole
# A kill during a search of a thousand batches, which cannot end before the kill.
grep -q 'in range(5):' tune.py || fail "docs/tutorials/optuna.md does not ask for five batches"
sed 's/in range(5):/in range(1000):/' tune.py >endless.py
"$python" endless.py >"$work/log" 2>&1 &
process=$!
wait_for "$process" "eight rows" more_than 7 runs/optuna/study.db
kill -9 "$process"
wait "$process" 2>/dev/null || true
flock --timeout 1200 runs/optuna/lock true || bad "evaluate does not end though nobody asks any more"
more_than 7 runs/optuna/study.db || bad "killed, it lost rows"
expect 0 "$python" tune.py
cmp "$work/log" first || bad "killed and started again, Optuna ends elsewhere"
first_rows() { sqlite3 "runs/$1/study.db" 'select * from run order by run limit 40'; }
cmp <(first_rows whole) <(first_rows optuna) || bad "killed and started again, other rows"
[[ $(sqlite3 runs/optuna/study.db 'select sum(runs) from effort') == "$(count runs/optuna/study.db)" ]] || bad "killed and started again, runs are done again"
ok "Optuna, killed and started again: $(<first)"

line=$(sed -n 's/.*`\(pandas[.]read_sql(.*)\)`.*/\1/p' "$root/docs/studies.md")
[[ -n $line ]] || fail "docs/studies.md has no line of pandas"
cd runs/whole
expect 0 "$python" -c "import pandas, sqlite3; table = $line; print(len(table), table['cpg.phase_lag'].dtype, table['speed'].max() > 0)"
said "^40 float64 True"
ok "pandas reads the journal"
verdict
