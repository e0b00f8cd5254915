#!/usr/bin/env bash
# A trace read by h5py with the literal code of docs/files.md equals the same trace as CSV. Then forged traces are tested.
# usage: h5py.sh PROGRAM     (exit code 77 if h5py is not available; FLIPS is the number of files with flipped bits, 40 by default)
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

# The indented block of docs/files.md that imports h5py.
awk '/^    import h5py/ { inside = 1 } inside && /^[^ ]/ { exit } inside { print substr($0, 5) }' "$root/docs/files.md" >recipe.py
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

import struct
def words(bytes, state=14695981039346656037):
    for word in (len(bytes), *struct.unpack(f"<{(len(bytes) + 7) // 8}Q", bytes + b"\0" * (-len(bytes) % 8))):
        state = (state ^ word) * 1099511628211 % 2**64
        state ^= state >> 32
    return state
whole = open("runs/walk/trace.h5", "rb").read()
assert whole[:512].decode().split("on: ")[1].startswith(f"{words(whole[512:]):016x}\n"), "the hash of the file"
names = words(b"".join(name.encode() + b"\0" for name in columns))
import json
trace_hash = f"1-{words(trace.astype('<f8').tobytes(), names):016x}"
assert json.load(open("runs/walk/summary.json"))["trace_hash"] == trace_hash, "the hash of the trace"

with h5py.File("runs/walk/trace.h5") as file:
    assert file.attrs["checksum"].decode() == trace_hash
    table = file["recording/ticks"]
    ticks = dict(zip((name.decode() for name in table.attrs["columns"]), table[:].T))
assert ticks["t"][-1] == t[-1] and max(ticks["joint.3.torque_peak"]) >= max(abs(torque))
TEXT
"$python" recipe.py
ok "h5py reads names, units, definitions, origin, tables and every bit; both hashes are those of docs/files.md"
mkdir forged && cd forged
if "$python" "$root/tests/gates/forged.py" "$program" ../runs/walk/trace.h5 "${FLIPS:-40}"; then ok "forged traces are refused"; else bad "forged traces"; fi
verdict
