#!/usr/bin/env python3
"""A servo of the library against 16 logs of a real one: by its data sheet and the usual losses, and fitted to eight of them.

    tests/gates/measured.py PROGRAM

An XL330-M288-T lifts 0.49 kg at 0.1 m (tests/measured/xl330: Rhoban/bam, Apache-2.0). The servo and its firmware are those of the
library (scenarios/servos); its goals, the gain P and the time at which its torque is switched off are those of each log. The numbers of
the section `measured` are computed again from trace and log. The errors of the fitted servo are those that its file states. Needs numpy.
"""
import json, pathlib, re, shutil, sys, tempfile

import numpy as np

import replay

SERVOS = pathlib.Path(__file__).resolve().parents[2] / "scenarios/servos"
LOGS = pathlib.Path(__file__).resolve().parents[1] / "measured/xl330"
SUPPLY = 7.3  # V, mean of the logs
MASS, ARM, LENGTH = 0.49, 0.018, 0.1  # kg, kg, m
MODULE = """gaitlab_module: 1
name: lever
bodies:
  base: {{mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}
  arm: {{mass: {mass}, com: [0, 0, {com}], inertia: [{about}, {about}, 1e-6, 0, 0, 0]}}
hinges: [{{name: hinge, parent: base, child: arm, axis: [0, 1, 0], range: free}}]
"""
SCENARIO = """gaitlab: 1
robot: {{modules: ./lever.yaml, base: fixed, position: [0, 0, 1]}}
initial: {{angles: {start}}}
ground: {{type: none}}
contact: {{on: none}}
actuator: {{type: servo, model: {servo}, {more}u_max: {supply}}}
controller: {{type: rc_servo, model: {servo}, P: {gain}, period: 0.001}}
cpg: {{type: table, model: {{file: log.csv, time: t, columns: {{0: goal}}, interpolation: linear, repeat: false}}}}
measured: {{file: log.csv, columns: {{m0/hinge: {{angle: angle, duty: {{column: pwm, scale: 885}}}}}}, "on": "on"}}
physics: {{engine: articulated, estimate: off}}
duration: {duration}
trace: {{period: 0.002, columns: [t, joint.*]}}
"""


def cubic(t, rows, values, slopes):
    """Values at the times t of the cubics through values and slopes at the rows (Hermite)."""
    k = np.clip(np.searchsorted(rows, t, side="right") - 1, 0, len(rows) - 2)
    h = rows[k + 1] - rows[k]
    s = np.clip((t - rows[k]) / h, 0, 1)
    r = 1 - s
    return values[k] * r**2 * (1 + 2 * s) + values[k + 1] * s**2 * (3 - 2 * s) + h * s * r * (slopes[k] * r - slopes[k + 1] * s)


def replayed(program, folder, log, servo, more):
    """Mean error of the angle, rad; shares of the time at the limit, simulated and logged; last simulated angle, rad; failed ones of the checks `voltage` and `current`."""
    logged = replay.read_columns(log)
    t, angle, pwm = logged["t"] - logged["t"][0], logged["angle"], logged["pwm"]
    gain = int(log.name.split("-")[0][2:])
    mass, moment = MASS + ARM, MASS * LENGTH**2 + ARM * LENGTH**2 / 3
    com = (MASS + ARM / 2) * LENGTH / mass
    shutil.copy(log, folder / "log.csv")
    (folder / "lever.yaml").write_text(MODULE.format(mass=mass, com=-com, about=moment - mass * com**2), encoding="utf-8")
    (folder / "s.yaml").write_text(SCENARIO.format(servo=servo, more=more, start=angle[0], supply=SUPPLY, gain=gain, duration=repr(float(t[-1]))), encoding="utf-8")
    trace = replay.run(program, folder, log.stem)
    simulated = cubic(t, trace["t"], trace["joint.0.angle"], trace["joint.0.speed"])
    # A duty is the command in force: that of the row at the time, or else of the next one.
    command = trace["joint.0.voltage_command"][np.searchsorted(trace["t"], t - 1e-9)]
    duty = np.clip(command / SUPPLY, -1, 1)
    said = json.loads((folder / log.stem / "summary.json").read_text(encoding="utf-8"))["measured"]
    for what, own, other in (("mae", np.abs(simulated - angle).mean(), said["angle"]["mae"]),
                             ("peak", np.abs(simulated - angle).max(), said["angle"]["peak"]),
                             ("rms", np.sqrt(((simulated - angle) ** 2).mean()), said["angle"]["rms"]),
                             ("duty mae", np.abs(duty - pwm / 885).mean(), said["duty"]["mae"]),
                             ("limit.logged", (np.abs(pwm) >= 0.999 * 885).mean(), said["limit"]["logged"])):
        assert abs(own - other) <= 1e-12, f"{log.stem}: measured {what} {other}, by numpy {own}"
    checks = {one["id"]: one["status"] for one in json.loads((folder / log.stem / "verdict.json").read_text(encoding="utf-8"))["checks"]}
    fails = sorted(name for name in ("voltage", "current") if checks[name] == "fail")
    return said["angle"]["mae"], said["limit"]["simulated"], said["limit"]["logged"], simulated[-1], fails


def replay_all(program, servo, more=""):
    """What replayed() returns, by the name of the log."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for log in sorted(LOGS.glob("kp*.csv")):
            found[log.stem] = replayed(program, pathlib.Path(folder), log, servo, more)
    return found


def means(found):
    """Mean errors of all logs, of those at gains 100 and 400, of the others, and of the drops, mrad."""
    of = {name: 1000 * one[0] for name, one in found.items()}
    fitted = [error for name, error in of.items() if name[:5] in ("kp100", "kp400")]
    others = [error for name, error in of.items() if name[:5] not in ("kp100", "kp400")]
    return [float(np.mean(some)) for some in (list(of.values()), fitted, others, [error for name, error in of.items() if "drop" in name])]


def check_fitted(fitted, held_out):
    """Differences of the errors of the fitted servo, mrad, from those in its file."""
    text = (SERVOS / "xl330-m288-fitted.yaml").read_text(encoding="utf-8")
    stated = {key: float(re.search(rf"^  {key}: ([\d.]+)", text, re.M)[1]) for key in ("error", "held_out")}
    # The arm is one body here and a ball on an arm in the bench of the fit, with the same moments to 1 %; stated are three digits.
    return [f"{what} {own / 1000:.4f} rad; expected {stated[what]} within 1 mrad"
            for what, own in (("error", fitted), ("held_out", held_out)) if abs(own / 1000 - stated[what]) > 1e-3]


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    wrong = []
    rows = {"usual losses": ["xl330-m288"], "data sheet alone": ["xl330-m288", "dry_friction: 0, viscous_friction: 0, load_friction: 0, rotor_inertia: 0, "], "identified": ["xl330-m288-fitted"]}
    found = {name: replay_all(program, *servo) for name, servo in rows.items()}
    for name, (error, limit, logged, last, fails) in found["usual losses"].items():
        print(f"{name:28} {1000 * error:6.1f} mrad   at the limit {limit:.2f}, logged {logged:.2f}   end {last:+.3f} rad   fails {', '.join(fails) or '-'}")
        if "drop" not in name and (("kp800" in name and not fails) or ("kp100" in name and fails)):
            wrong.append(f"{name}: failed checks {fails}; expected one of voltage and current at gain 800, and none at gain 100")
        if "kp800" in name and abs(limit - logged) > 0.1:
            wrong.append(f"{name}: {limit:.2f} of the time at the limit, {logged:.2f} logged; expected within 0.1")
        if "drop" in name and abs(last) > 0.02:
            wrong.append(f"{name}: an arm without current ends at {last:.3f} rad; expected at rest within 0.02")
    if len(found["usual losses"]) != 16:
        wrong.append(f"{len(found['usual losses'])} logs; expected 16")
    for name, one in found.items():
        errors = means(one)
        limits = [one[log][1] for log in one if "kp800" in log]
        print(f"{name:18} {', '.join(f'{error:.1f}' for error in errors)} mrad: all logs, gains 100 and 400, others, drops; "
              f"at the limit at gain 800 {', '.join(f'{limit:.2f}' for limit in limits)}")
        # The page has these digits.
        wrong += replay.differs_from_page(name, [*errors, *limits], [0.06] * 4 + [0.006] * 4)
    everything, fitted, held_out, drops = means(found["usual losses"])
    # 43.1 and 52.9 mrad measured (42.9 and 52.0 with torque off at the later of two rows); the bounds are those of the issue.
    if not everything <= 48:
        wrong.append(f"mean error {everything:.1f} mrad; expected at most 48")
    if not drops <= 60:
        wrong.append(f"mean error of drops {drops:.1f} mrad; expected at most 60")
    wrong += check_fitted(*means(found["identified"])[1:3])
    return replay.exit_code(wrong)


if __name__ == "__main__":
    sys.exit(main())
