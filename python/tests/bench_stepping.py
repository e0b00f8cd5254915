"""Speed of stepping from Python, in simulated seconds per CPU second of one thread, its share beyond the same ticks in C++, and the
error of fast steps.

bench_stepping.py [SCENARIO [ENVIRONMENTS]]: PYTHONPATH names the built package.
"""
import os
import sys
import time
import warnings

os.environ["OMP_NUM_THREADS"] = "1"
import numpy as np  # noqa: E402: the number of threads is read at import

import gaitlab  # noqa: E402

name, count = [*sys.argv[1:], *["hexapod", "256"][len(sys.argv) - 1:]]
n, seconds = int(count), 1.5
warnings.simplefilter("ignore", gaitlab.Warning)
scenario = gaitlab.Scenario(name, {"physics.engine": "articulated", "duration": seconds + 3})
poses = gaitlab.run(scenario, loads=False).poses
driven = [scenario.joints.index(joint) for joint in scenario.start().joints]
walk = np.array([poses[f"joint.{j}.setpoint"][1:] for j in driven]).T
ticks = int(seconds / (poses["t"][1] - poses["t"][0]))


def cpu(noise, smooth, shift, **settings):
    """CPU time of the episode. Set points are those of the run, with noise (rad), each environment `shift` ticks later than the last."""
    envs = gaitlab.start(scenario, n, **{"record": False, **settings})
    at = np.arange(n) * shift % (len(walk) - ticks)
    random, drift = np.random.default_rng(1), np.zeros((n, len(driven)))
    begin = time.process_time()
    for k in range(ticks):
        drift = smooth * drift + noise * np.sqrt(1 - smooth**2) * random.standard_normal(drift.shape)
        envs.step(walk[k + at] + drift)
    return time.process_time() - begin


rows = (
    ("the same set points", 0, 0, 0, {}),
    ("each in another phase", 0, 0, 7, {}),
    ("each in another phase, recorded", 0, 0, 7, {"record": True}),
    ("smooth noise of 0.03 rad", 0.03, 0.95, 0, {}),
    ("white noise of 0.05 rad per tick", 0.05, 0, 0, {}),
    ("fast: each in another phase", 0, 0, 7, {"fast": True}),
    ("fast: white noise of 0.05 rad per tick", 0.05, 0, 0, {"fast": True}),
)
for label, noise, smooth, shift, settings in rows:
    taken = cpu(noise, smooth, shift, **settings)
    print(f"{label:40} {n * seconds / taken:8.1f} sim s/CPU s {n * ticks / taken:8.0f} steps/s", flush=True)
begin = time.process_time()
gaitlab.rollouts(scenario, [{"seed": k + 1, "duration": seconds} for k in range(64)], threads=1, estimate_every=0, quantities=["speed"])
print(f"{'rollouts, one quantity, no estimate':40} {64 * seconds / (time.process_time() - begin):8.1f} sim s/CPU s")


def walked(**physics):
    """Speed (m/s) and torques (N m, joints x rows) of a run of 6 s."""
    settings = {"physics": {"engine": "articulated", **physics}, "duration": 6, "trace.period": float(period)}
    run = gaitlab.run(gaitlab.Scenario(name, settings), loads=False)
    return run.summary["speed"], np.array([run.trace[f"joint.{j}.torque"] for j in driven])


period = poses["t"][1] - poses["t"][0]  # of control
exact, fast = walked(accuracy=0.001), walked(integrator="implicit", step=float(period / np.ceil(period / 0.0025 - 1e-9)))
error = np.sqrt(((exact[1] - fast[1]) ** 2).mean(axis=1)) / np.abs(exact[1]).max(axis=1)
print(f"fast steps: speed {100 * (fast[0] / exact[0] - 1):+.2f} %, torques (RMS) up to {100 * error.max():.1f} % of a joint's peak")


def held(environments, every, total):
    envs = gaitlab.start(scenario.with_({"duration": 100}), environments, every=every, record=False)
    action = np.tile(walk[0], (environments, 1))
    begin = time.process_time()
    for _ in range(total // every):
        envs.step(action)
    return time.process_time() - begin


for environments, total in ((n, 60), (1, 600)):
    pairs = [(held(environments, 1, total), held(environments, total, total)) for _ in range(6)]  # interleaved
    print(f"{environments} environments: steps from Python take {np.median([a / b for a, b in pairs]):.3f} of the same ticks in C++")
