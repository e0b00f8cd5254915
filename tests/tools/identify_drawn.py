#!/usr/bin/env python3
"""Logs of drawn servos with known numbers, and how well `gaitlab identify` finds them: a row per key over all servos.

    tests/tools/identify_drawn.py PROGRAM [SERVOS] [FIRST]

A servo is drawn around a data sheet: stall torque and no-load speed within 20 %, rotor inertia within a factor of 1.5, dry friction 2 to
8 %, viscous friction 5 to 20 %, load friction 0.08 to 0.25. Eight logs of 6 s, at two gains: sin t^2, a sum of sines, lift and drop
(without torque at the end), slow up and down (a load is lowered). 12 bit, 200 Hz, each row up to 5 ms late. Takes a minute of CPU time per servo;
not a part of CI. Needs numpy.
"""
import json, pathlib, random, re, subprocess, sys, tempfile

import numpy as np

SHEET = {"stall_torque": 0.52, "no_load_speed": 10.786}
MODULE = """gaitlab_module: 1
name: lever
bodies:
  base: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}
  arm: {mass: 0.25, com: [0, 0, -0.1], inertia: [4e-5, 4e-5, 1e-6, 0, 0, 0]}
hinges: [{name: hinge, parent: base, child: arm, axis: [0, 1, 0], range: free}]
"""
BENCH = """gaitlab: 1
robot: {{modules: ./lever.yaml, base: fixed, position: [0, 0, 1]}}
ground: {{type: none}}
contact: {{"on": none}}
actuator: {{type: servo, voltage: 5, stall_torque: {stall_torque}, no_load_speed: {no_load_speed}, u_max: 7.3{more}}}
controller: {{type: rc_servo, unit: dynamixel_x, P: 400, latency: 0.007, period: 0.001}}
cpg: {{type: table, model: {{file: log.csv, time: t, columns: {{m0/hinge: goal}}, interpolation: linear, repeat: false}}}}
{measured}physics: {{engine: articulated, estimate: off}}
duration: 6
trace: {{period: 0.001, columns: [t, joint.*]}}
"""
MEASURED = 'measured: {file: log.csv, "on": "on", columns: {m0/hinge: {angle: angle, duty: duty}}}\n'
TIMES = np.arange(0, 6.0005, 0.001)
GOALS = {"square": 1.2 * np.sin(0.6 * TIMES**2), "sines": 0.8 * np.sin(2.1 * TIMES) + 0.5 * np.sin(7.3 * TIMES),
         "drop": np.clip(1.6 * TIMES / 2, 0, 1.6), "slow": 0.7 * (1 - np.cos(2 * np.pi * TIMES / 5))}


def drawn(seed):
    """Numbers of a servo."""
    rng = random.Random(seed)
    torque, speed = (SHEET[key] * rng.uniform(0.8, 1.2) for key in ("stall_torque", "no_load_speed"))
    return {"stall_torque": torque, "no_load_speed": speed, "rotor_inertia": 0.03 * torque / speed * 1.5 ** rng.uniform(-1, 1),
            "dry_friction": torque * rng.uniform(0.02, 0.08), "viscous_friction": torque / speed * rng.uniform(0.05, 0.20),
            "load_friction": rng.uniform(0.08, 0.25)}


def write_logs(program, folder, servo, seed, duty=True):
    """Runs the servo and writes its logs and their table."""
    rng = np.random.default_rng(seed)
    table = ["file,controller.P"]
    for gain in (200, 800):
        for name, goal in GOALS.items():
            on = np.where((TIMES < 4) | (name != "drop"), 1, 0)
            (folder / "log.csv").write_text("t,goal\n" + "".join(f"{t:.4f},{g:.6f}\n" for t, g in zip(TIMES, goal)), encoding="utf-8")
            more = "".join(f", {key}: {value!r}" for key, value in servo.items() if key not in SHEET)
            text = BENCH.format(stall_torque=servo["stall_torque"], no_load_speed=servo["no_load_speed"], more=more, measured="")
            if name == "drop":
                text += "at: [{t: 4, fault: {joint: m0/hinge, kind: open}}]\n"
            (folder / "true.yaml").write_text(text.replace("P: 400", f"P: {gain}"), encoding="utf-8")
            run = folder / f"true-{gain}-{name}"
            subprocess.run([program, "run", "true.yaml", "--set", "physics.accuracy=0.001", "--out", run.name, "--format", "csv", "--no-report", "--quiet"],
                           cwd=folder, check=True, capture_output=True)
            trace = np.genfromtxt(run / "trace.csv", delimiter=",", names=True, comments="#")
            rows = np.minimum(np.arange(0, 6000, 5) + rng.integers(0, 5, 1200), len(trace) - 1)
            columns = {n: trace[n] for n in trace.dtype.names}
            angle = np.round(columns["joint0angle"][rows] * 4096 / 2 / np.pi) * 2 * np.pi / 4096
            pwm = np.clip(columns["joint0voltage_command"][rows] / 7.3, -1, 1)
            head = "t,goal,angle,on" + (",duty" if duty else "")
            lines = [f"{TIMES[r]:.4f},{goal[r]:.6f},{a:.6f},{on[r]}" + (f",{p:.4f}" if duty else "") for r, a, p in zip(rows, angle, pwm)]
            (folder / f"{gain}-{name}.csv").write_text("\n".join([head, *lines]) + "\n", encoding="utf-8")
            table.append(f"{gain}-{name}.csv,{gain}")
    (folder / "logs.csv").write_text("\n".join(table) + "\n", encoding="utf-8")
    measured = MEASURED if duty else MEASURED.replace(", duty: duty", "")
    (folder / "bench.yaml").write_text(BENCH.format(more="", measured=measured, **SHEET), encoding="utf-8")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    servos, first = (int(a) for a in (sys.argv[2:4] + ["20", "1"])[:2]) if len(sys.argv) > 3 else (int((sys.argv[2:] or ["20"])[0]), 1)
    found = {}
    for seed in range(first, first + servos):
        servo = drawn(seed)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "lever.yaml").write_text(MODULE, encoding="utf-8")
            write_logs(program, folder, servo, seed)
            fit = [f"--fit=actuator.{key}" for key in servo]
            made = subprocess.run([program, "identify", "bench.yaml", "logs.csv", "--share", "0", *fit, "-j2"], cwd=folder, capture_output=True, text=True)
            if made.returncode:
                sys.exit(made.stderr)
            agreed = re.search(r"(\d+) of (\d+) starts", made.stdout)[0]
            error = re.search(r"fitted logs +\d+ +\S+ mrad +(\S+)", made.stdout)[1]
            line = []
            for key, value in servo.items():
                row = re.search(rf"actuator\.{key} +(\S+) +(\S+) to (\S+)", made.stdout)
                fitted, low, high = (float(one) for one in row.groups())
                found.setdefault(key, []).append((fitted / value - 1, low <= value <= high))
                line.append(f"{100 * (fitted / value - 1):+.1f}{' ' if low <= value <= high else '!'}")
            print(f"{seed:3} {error:>5} mrad {agreed:18} " + " ".join(f"{one:>8}" for one in line), flush=True)
    for key, rows in found.items():
        errors = np.abs([one for one, _ in rows])
        print(f"{key:18} median {100 * np.median(errors):.1f} %, largest {100 * errors.max():.1f} %, within its interval {sum(inside for _, inside in rows)} of {len(rows)}")
    pooled = [inside for rows in found.values() for _, inside in rows]
    print(f"within intervals: {100 * np.mean(pooled):.0f} %")


if __name__ == "__main__":
    main()
