"""Compares gaitlab.rollouts with `gaitlab sweep` on the same points: bits and CPU time.

bench.py [ENGINE [DURATION [POINTS [ROUNDS]]]]: PYTHONPATH names the built package.
"""
import os
import resource
import sys
import tempfile
import warnings

import numpy as np

import gaitlab
from common import ROOT, called

engine, duration, points, rounds = [*sys.argv[1:], *["articulated", "4", "1000", "3"][len(sys.argv) - 1:]]
side = max(k for k in range(1, int(int(points) ** 0.5) + 1) if int(points) % k == 0)
warnings.simplefilter("ignore", gaitlab.Warning)


def seconds(whose):
    used = resource.getrusage(whose)
    return used.ru_utime + used.ru_stime


def one_round(folder):
    with open(os.path.join(folder, "study.yaml"), "w") as file:
        file.write(f"gaitlab_study: 1\nscenario: {ROOT}/scenarios/caterpillar.yaml\nestimate_every: 0\nset: [physics.engine={engine}, duration={duration}]\n"
                   f"method: {{type: grid}}\nparameters:\n  cpg.phase_lag: {{low: -1.6, high: 1.6, count: {side}}}\n"
                   f"  cpg.amplitude: {{low: 0.2, high: 0.8, count: {int(points) // side}}}\n")
    before = seconds(resource.RUSAGE_CHILDREN)
    called("sweep", "study.yaml", "--quiet", "--out", "swept", "-j", "2", folder=folder)
    swept = seconds(resource.RUSAGE_CHILDREN) - before
    journal = gaitlab.study(os.path.join(folder, "swept"))
    rows = journal.points
    column = dict(zip(journal.quantities["name"], journal.quantities["column_name"]))
    asked = [{key: row[key] for key in ("cpg.phase_lag", "cpg.amplitude")} for row in rows.to_dict("records")]
    for lanes in (0, 1)[: 2 if folder.endswith("0") else 1]:
        before = seconds(resource.RUSAGE_SELF)
        scenario = gaitlab.Scenario("caterpillar", {"physics.engine": engine, "duration": float(duration)})
        table = gaitlab.rollouts(scenario, asked, threads=2, lanes=lanes, estimate_every=0)
        mine = seconds(resource.RUSAGE_SELF) - before
        equal = sum(int(((x == y) | (np.isnan(x) & np.isnan(y))).sum())
                    for x, y in ((table[name], rows[column[name]].to_numpy(float)) for name in table))
        print(f"{len(asked)} runs, lanes {lanes}: sweep {swept:.2f} s, rollouts {mine:.2f} s of CPU, ratio {mine / swept:.3f}; "
              f"{equal} of {table.values.size} numbers equal", flush=True)


with tempfile.TemporaryDirectory() as work:
    for number in range(int(rounds)):
        folder = os.path.join(work, f"round{number}")
        os.mkdir(folder)
        one_round(folder)
