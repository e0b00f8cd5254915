"""Replay of logs of real machines: files of rows, a run of a scenario, the end of a gate."""
import csv, pathlib, re, subprocess

import numpy as np


def read_columns(path):
    """Columns of a file of comma-separated numbers by name, without units; lines that begin with # are comments."""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    names = next(csv.reader(lines[:1]))
    return dict(zip((name.split()[0] for name in names), np.loadtxt(lines[1:], delimiter=",", ndmin=2).T))


def run(program, folder, out):
    """Runs s.yaml of the folder into its folder `out`. Returns the columns of the trace."""
    subprocess.run([program, "run", "s.yaml", "--out", out, "--no-report", "--quiet", "--format", "csv"], cwd=folder, check=True,
                   stderr=subprocess.DEVNULL)
    return read_columns(folder / out / "trace.csv")


def differs_from_page(name, values, tolerances):
    """Differences from the numbers in the row of docs/measured.md whose first cell begins with the name, as texts."""
    page = (pathlib.Path(__file__).resolve().parents[2] / "docs/measured.md").read_text(encoding="utf-8")
    row = next((line for line in page.splitlines() if line.startswith("| " + name)), "")
    stated = [float(one) for one in re.findall(r"\d+\.?\d*", "|".join(row.split("|")[2:]))]
    if len(stated) != len(values):
        return [f"docs/measured.md has {len(stated)} numbers in the row '{name}'; expected {len(values)}"]
    return [f"docs/measured.md, row '{name}': {one}; measured {value:.4g}"
            for one, value, most in zip(stated, values, tolerances) if abs(one - value) > most]


def exit_code(wrong):
    """Prints what is wrong. Returns the exit code of the gate."""
    for one in wrong:
        print("WRONG", one)
    return 1 if wrong else 0
