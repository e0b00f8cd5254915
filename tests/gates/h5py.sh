#!/usr/bin/env bash
# A trace read by h5py with the lines of docs/conventions.md as they stand there, against the same trace as CSV.
# usage: h5py.sh PROGRAM     (exit code 77: no h5py here)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
for python in /usr/bin/python3 python3; do
  "$python" -c 'import h5py' 2>/dev/null && break
  python=
done
[[ -n $python ]] || { skip "a trace in h5py" "no python3 with h5py (Debian: python3-h5py)"; exit 77; }

cd -- "$work"
expect 0 "$program" run "$root/scenarios/caterpillar.yaml" --set duration=0.2 --seed 7 --out runs/walk --quiet
expect 0 "$program" export runs/walk --to csv trace.csv

# The indented block that imports h5py.
awk '/^    import h5py/ { inside = 1 } inside && /^[^ ]/ { exit } inside { print substr($0, 5) }' "$root/docs/conventions.md" >recipe.py
cat >>recipe.py <<'TEXT'

import csv
with open("trace.csv") as file:
    head, *rows = list(csv.reader(file))
assert list(columns) == head, "the columns' names"
assert trace.shape == (len(rows), len(head)) == (41, 161), trace.shape
assert [[float(cell) for cell in row] for row in rows] == trace.tolist(), "every number, every bit"
assert units["joint.3.torque"] == "N m" and units["t"] == "s" and units["base.z"] == "m"
assert all(definitions[name] for name in columns)
assert seed == 7 and build.startswith("0.") and scenario.startswith("gaitlab: 1\nname: caterpillar")
assert torque.min() < 0 and len(torque) == len(t)
TEXT
"$python" recipe.py
ok "h5py reads names, units, definitions, origin and every bit"
