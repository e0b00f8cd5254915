#!/usr/bin/env python3
"""The verdict on a gait does not depend on the end of its run: 40 durations of 5 to 7 periods, for eight robots, standing and
dropped. Prints the words of each robot; exit code 1 if those of one differ.
usage: ends.py PROGRAM [SCENARIOS]"""
import collections
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SCENARIOS = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).resolve().parents[2] / "scenarios")
DURATIONS = 40
# Scenario and period of its gait, s.
ROBOTS = [("caterpillar", 4), ("hexapod", 2), ("library/ckbot-worm", 2), ("library/rofi-snake", 2), ("library/y1-snake", 2),
          ("library/yamor-worm", 2), ("library/revolve-spider", 2), ("library/dtto-caterpillar", 4)]


def words(scenario, duration, sets):
    with tempfile.TemporaryDirectory() as folder:
        run = pathlib.Path(folder) / "run"
        subprocess.run([PROGRAM, "run", SCENARIOS / f"{scenario}.yaml", "--no-report", "--no-retry", "--quiet", "--out", run, "--set",
                        "physics.engine=articulated", "--set", f"duration={duration:.4f}", *sets], capture_output=True, check=False)
        verdict = json.loads((run / "verdict.json").read_text())
        return verdict["verdict"], verdict["decided_by"] or ""


def main():
    runs = bad = 0
    with concurrent.futures.ThreadPoolExecutor() as pool:
        for scenario, period in ROBOTS:
            for start, sets in (("standing", []), ("dropped", ["--set", "robot.position=[0, 0, 0.15]"])):
                # The first second is for the ramp and the fall.
                ends = [1 + period * (5 + 2 * k / (DURATIONS - 1)) for k in range(DURATIONS)]
                found = collections.Counter(pool.map(lambda end: words(scenario, end, sets), ends))
                runs += len(ends)
                bad += len({word for word, _ in found}) > 1
                print(f"{scenario:28s}{start:10s}" + ", ".join(f"{n} {' by '.join(filter(None, w))}" for w, n in found.items()), flush=True)
    print(f"{runs} runs, {bad} robots whose word depends on the end of the run")
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
