"""Replay of logs of real machines: files of rows, a run of a scenario, the end of a gate."""
import csv, subprocess

import numpy as np


def read_columns(path):
    """Columns of a file of comma-separated numbers by name, without units; lines that begin with # are comments."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name.split()[0]: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def run(program, folder, out):
    """Runs s.yaml of the folder into its folder `out`. Returns the columns of the trace."""
    subprocess.run([program, "run", "s.yaml", "--out", out, "--no-report", "--quiet", "--format", "csv"], cwd=folder, check=True,
                   stderr=subprocess.DEVNULL)
    return read_columns(folder / out / "trace.csv")


def exit_code(wrong):
    """Prints what is wrong. Returns the exit code of the gate."""
    for one in wrong:
        print("WRONG", one)
    return 1 if wrong else 0
