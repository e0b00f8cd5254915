#!/usr/bin/env python3
"""Torques of a real two-joint arm, whose motion is prescribed, by the model that its authors identified; nothing is fitted.

    tests/gates/arm.py PROGRAM

Two AK80-6 drive a double pendulum (tests/measured/double-pendulum: DFKI, BSD-3-Clause). The logged angles, smoothed without
delay by a Gaussian of -3 dB at 8 Hz, are the set points of a loop so stiff that its commands are the torques which this motion
needs. The logged torques, by the currents of the drives, are smoothed likewise. The friction of the authors' program is
b w + cf arctan(100 w), which is pi/2 cf where a joint turns. Needs numpy.
"""
import pathlib, sys, tempfile

import numpy as np

import replay

LOGS = pathlib.Path(__file__).resolve().parents[1] / "measured/double-pendulum"
CUT = 8  # Hz
ENDS = 0.3  # s, left out at both ends
ROW = 0.002  # s, as in the logs
FORMULA = 0.01  # N m: differences over 2 ms err by 0.3 % at 8 Hz, and the sign of a speed by a row at 0.5 N m
PERIOD = 1e-4  # s, of the loop
# N m, shoulder and elbow, that `gaitlab identify --of voltage` found in halves of the second log for the first, and vice versa
FITTED = [0.266, 0.134], [0.1824, 0.195]
GAINS = "Kp: 1e5, Ki: 0, Kd: 80, N: 1e6"  # V/rad, V s/rad; an error of 1e-5 rad gives 1 N m
MODULE = """gaitlab_module: 1
name: arm
bodies:
  base: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
  upper: {{mass: {m1}, com: [0, 0, -{r1}], inertia: [{i1}, {i1}, {i1}, 0, 0, 0]}}
  lower: {{mass: {m2}, com: [0, 0, -{r2}], inertia: [{i2}, {i2}, {i2}, 0, 0, 0]}}
hinges:
  - {{name: shoulder, parent: base, child: upper, axis: [0, 1, 0], range: free}}
  - {{name: elbow, parent: upper, child: lower, origin: [0, 0, -{l1}], axis: [0, 1, 0], range: free}}
"""
SCENARIO = """gaitlab: 1
robot: {{modules: ./arm.yaml, base: fixed, position: [0, 0, 1]}}
initial: {{angles: [{start[0]}, {start[1]}]}}
ground: {{type: none}}
contact: {{on: none}}
actuator:
  {{type: dc_motor, R: 1, Kt: 1, Ks: 0, gear: 1, efficiency: 1, u_max: 1e3, i_max: 1e3, rotor_inertia: {rotor},
   dry_friction: [{dry[0]}, {dry[1]}], viscous_friction: [{b1}, {b2}]}}
controller: {{type: pid, {gains}, period: {period}}}
cpg: {{type: table, model: {{file: ./angles.csv, repeat: false}}}}
physics: {{engine: articulated, gravity: [0, 0, -{g}], estimate: off}}
duration: {duration}
trace: {{period: {row}, columns: [t, joint.*]}}
"""


def smooth(x, dt):
    """Zero-phase Gaussian; the curve is continued beyond its ends by its mirror image through them."""
    sigma = np.sqrt(np.log(2)) / (2 * np.pi * CUT) / dt  # samples
    half = int(6 * sigma) + 1
    kernel = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma) ** 2)
    ends = np.concatenate([2 * x[0] - x[half:0:-1], x, 2 * x[-1] - x[-2:-half - 2:-1]])
    return np.convolve(ends, kernel / kernel.sum(), "valid")


def read_log(path):
    """Times, smoothed angles and torques, in even steps."""
    column = replay.read_columns(path)
    t = np.linspace(column["t"][0], column["t"][-1], len(column["t"]))
    even = {name: smooth(np.interp(t, column["t"], column[name]), t[1] - t[0]) for name in column}
    return t - t[0], [even["angle1"], even["angle2"]], [even["torque1"], even["torque2"]]


def by_formula(p, t, q):
    """Torques of a double pendulum without friction, from the textbook; q[1] is relative to the upper arm."""
    w = [np.gradient(x, t) for x in q]
    a = [np.gradient(x, t) for x in w]
    h = p["m2"] * p["l1"] * p["r2"]
    c, s = h * np.cos(q[1]), h * np.sin(q[1])
    rotor = p["gr"]**2 * p["Ir"]
    weight = p["g"] * p["m2"] * p["r2"] * np.sin(q[0] + q[1])
    first = ((p["I1"] + p["I2"] + p["m2"] * p["l1"]**2 + 2 * c + rotor) * a[0] + (p["I2"] + c) * a[1] - s * w[1] * (2 * w[0] + w[1])
             + p["g"] * (p["m1"] * p["r1"] + p["m2"] * p["l1"]) * np.sin(q[0]) + weight)
    second = (p["I2"] + c) * a[0] + (p["I2"] + rotor) * a[1] + s * w[0]**2 + weight
    return [first, second]


def track(program, folder, p, t, q, dry):
    """Torques of the motors for the motion q at the times t, N m."""
    folder.mkdir()
    (folder / "arm.yaml").write_text(
        MODULE.format(i1=p["I1"] - p["m1"] * p["r1"]**2, i2=p["I2"] - p["m2"] * p["r2"]**2, **p), encoding="utf-8")
    np.savetxt(folder / "angles.csv", np.column_stack([t, *q]), "%.17g", ",", header="time,0,1", comments="")
    (folder / "s.yaml").write_text(SCENARIO.format(
        start=[x[0] for x in q], dry=dry, rotor=p["gr"]**2 * p["Ir"], gains=GAINS, period=PERIOD, row=ROW,
        duration=f"{t[-1] // ROW * ROW:.3f}", **p), encoding="utf-8")
    trace = replay.run(program, folder, "run")
    return [np.interp(t, trace["t"], trace[f"joint.{j}.voltage_command"]) for j in range(2)]


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    lines = (LOGS / "authors-model-1.0.yml").read_text(encoding="utf-8").splitlines()
    p = {key: float(value) for key, value in (line.split(":") for line in lines)}
    logs = sorted(LOGS.glob("*.csv"))
    wrong = [] if len(logs) == 2 else [f"{len(logs)} logs; expected 2"]
    authors = np.array([p["cf1"], p["cf2"]])
    for name, dry_friction, most in (("none", [0 * authors] * 2, None), ("cf", [authors] * 2, 0.155),
                                     ("pi/2 cf", [np.pi / 2 * authors] * 2, 0.155), ("of the other log", FITTED, None)):
        errors, formula = [], []
        for log, dry in zip(logs, dry_friction):
            t, q, logged = read_log(log)
            kept = (t > ENDS) & (t < t[-1] - ENDS)
            with tempfile.TemporaryDirectory() as folder:
                torque = track(program, pathlib.Path(folder) / "arm", p, t, q, dry)
            errors += [np.abs(torque[j] - logged[j])[kept].mean() for j in range(2)]
            for j, bare in enumerate(by_formula(p, t, q)):
                w = np.gradient(q[j], t)
                formula.append(np.abs(torque[j] - bare - p["b1"] * w - dry[j] * np.sign(w))[kept].mean())
        print(f"dry friction {name:8} mean of four joints {np.mean(errors):.3f} N m ({', '.join(f'{x:.3f}' for x in errors)});"
              f" from the textbook {max(formula):.4f} N m")
        # 0.141 and 0.130 N m measured, 0.225 without friction; the bound is that of the issue.
        if most and not np.mean(errors) <= most:
            wrong.append(f"dry friction {name}: mean error {np.mean(errors):.3f} N m; expected at most {most}")
        wrong += replay.differs_from_page(f"dry friction {name}", [np.mean(errors), np.mean(errors[:2]), np.mean(errors[2:])], [1e-3] * 3)
        if name == "none" and not np.mean(errors) > 0.2:
            wrong.append(f"without friction: mean error {np.mean(errors):.3f} N m; expected above 0.2, as in these logs")
        if not max(formula) <= FORMULA:
            wrong.append(f"dry friction {name}: {max(formula):.4f} N m from the textbook's torques; expected at most {FORMULA}")
    return replay.exit_code(wrong)


if __name__ == "__main__":
    sys.exit(main())
