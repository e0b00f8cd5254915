#!/usr/bin/env python3
"""Equations 1 to 12 of the paper, recomputed sample by sample from a trace's columns, by code that shares nothing with the
program.
usage: equations.py PROGRAM SCENARIOS_FOLDER
Exit code 77 if python3-h5py, python3-numpy or python3-yaml is missing.

Shipped scenarios and some at their limits are run on both engines. For every equation the worst residual, its tolerance and the
reason for that tolerance are printed; so are the situations that must have occurred (feet that slid, motors at their limits ...).
Then the gate is tested itself: MUTANTS changes one constant, rule or cell at a time, and each must turn its line red.

The parts are beside this file, in paper/: robot.py (docks, kinematics, Newton and Euler), laws.py (eq. 1-6, 12, stops), gaits.py
(eq. 7-10, gaits), checks.py (columns against these; LINES lists the tolerances), steps.py (integrators and ledger). Eq. 11 and 13
to 15 are missing from the paper's text as the project has it; 16 to 19 are the caterpillar's couplings, a part of eq. 7."""
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
try:
    import h5py  # noqa: F401 (paper.trace reads with it)
    import numpy as np
    import yaml  # noqa: F401
except ImportError as error:
    print(f"left out: {error} (Debian: python3-h5py, python3-numpy, python3-yaml)")
    sys.exit(77)

from paper import checks, steps
from paper.trace import Run

HEAD = "gaitlab: 1\ntrace: {columns: ['*']}\n"
# Robot of four modules with a bend and a leg on each side. Its blocks have points and spheres on all sides.
SMALL = """robot:
  modules: mtran
  docks: [[1, 1, 4, 0, 1], [0, 2, 3, 0, 3], [2, 3, 5, 0, 1]]
"""
# The robot is thrown onto the ground, and its joints are driven into their limits. The joints alternately have P, PI, PD and PID
# controllers.
THROWN = HEAD + SMALL + """contact: {on: all}
initial:
  angles: [0.3, -0.2, 0.4, -0.5, 0.2, 0.1, 0.6, 1.5]
  speeds: 1
  base_velocity: [0.2, -0.3, 0.1]
  base_angular_velocity: [1, 2, -1]
"""
GAINS = """controller:
  type: pid
  Kp: [60, 40, 80, 50, 60, 40, 80, 50]
  Ki: [0, 300, 0, 200, 0, 500, 0, 400]
  Kd: [0, 0, 0.6, 0.4, 0, 0, 0.3, 0.8]
  N: [10, 10, 10, 5, 10, 10, 20, 10]
"""
LIMITS = THROWN + GAINS + """actuator:
  efficiency_model: directional
  u_max: [7.4, 5, 6, 7.4, 3, 7.4, 2, 7.4]
  i_max: [0.5, 1.2, 0.4, 1.2, 0.8, 1.2, 0.6, 0.3]
  efficiency: [0.7, 0.6, 0.7, 0.8, 0.7, 0.7, 0.5, 0.7]
cpg: {type: sine, frequency: [2.1, 2.1, 0.7, 2.1, 2.1, 2.1, 0.8, 0.8], amplitude: 1.5, offset: [0.8, -1, 1.2, 0, 0.2, 0.5, 1.2, 1.2], phase_lag: 0.7, model: {ramp: 0.1}}
duration: 1.5
"""
STEPS = THROWN + """cpg: {type: sine, frequency: 2, amplitude: 1.4, offset: [0, 0, 0, 0, 0, 0, 0, 3], phase_lag: 0.7}
duration: 0.15
"""
CHAIN = """robot: {base: fixed, modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0]]}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated}
duration: 6
"""
FREE = HEAD + CHAIN
LEGS = FREE.replace("modules: mtran, docks: [[1, 1, 4, 0, 0], [1, 2, 4, 1, 0]]", "modules: mtran, build: robots/hexapod.dat").replace(
    "duration: 6", "duration: 3")
# Runs by name: scenario (name of a shipped scenario, or text), overrides, checks.
RUNS = {
    "caterpillar, bullet": ("caterpillar", ["duration=1.5"], checks.ALL),
    "caterpillar, extrapolated": ("caterpillar", ["duration=4", "physics.engine=articulated", "physics.integrator=extrapolated"], checks.ALL),
    "equations in YAML": ("caterpillar-equations", ["duration=2", "physics.engine=articulated"], checks.ALL),
    "hexapod, bullet": ("hexapod", ["duration=1.5"], checks.ALL),
    "hexapod, adaptive": ("hexapod", ["duration=4", "physics.engine=articulated", "ground.friction=0.1"], checks.ALL),
    "rubble, adaptive": ("rubble", ["duration=4", "physics.engine=articulated", "ground.boxes.0.friction=0.3"], checks.ALL),
    "pendulum, rk4": ("pendulum", ["duration=3"], checks.ALL),
    "limits, adaptive": (LIMITS, ["physics.engine=articulated"], checks.ALL),
    "friction, adaptive": (LIMITS.replace("directional", "directional\n  dry_friction: [0.1, 0, 0.2, 0.05, 0.1, 0.3, 0.1, 0.2]\n"
                                          "  viscous_friction: 0.05"), ["physics.engine=articulated"], checks.ALL),
    "limits, bullet": (LIMITS, ["duration=0.6", "physics.step=5e-6"], checks.ALL),
    "Hertz, adaptive": (LIMITS, ["physics.engine=articulated", "controller.anti_windup=false", "contact.stiffness=4e5",
                                 "contact.exponent=1.5", "contact.damping=3e3", "contact.damping_exponent=0.5",
                                 "actuator.efficiency_model=paper", "actuator.rotor_inertia=1e-8"], checks.ALL),
    "torque": (THROWN + GAINS.replace("type: pid", "type: pid\n  unit: N m").replace("60, 40", "6, 4") + "duration: 1\n"
               "actuator: {type: torque, limit: 0.6}\ncpg: {type: sine, frequency: 1, amplitude: 0.6}\n",
               ["physics.engine=articulated"], checks.ALL),
    "servo": (THROWN + GAINS + "actuator: {type: servo, voltage: 7.4, stall_torque: [0.8, 1.5, 1.5, 1.5, 1.5, 1.5, 0.6, 1.5], "
              "no_load_speed: 3, stall_current: [0.6, 0, 0, 0, 0, 0, 0.5, 0], efficiency: [0, 0.5, 0, 0, 0, 0, 0, 0], rotor_inertia: 1e-4, "
              "load_friction: 0, dry_friction: 0, viscous_friction: 0, "
              "u_max: 6, i_max: {default: 0.5, m1/passive: 0.3}}\n"
              "cpg: {type: sine, frequency: 1, amplitude: 1.2}\nduration: 1\n", ["physics.engine=articulated"], checks.ALL),
    "servo, usual": (THROWN + GAINS + "actuator: {type: servo, voltage: 7.4, stall_torque: [1.5, 2, 1.5, 1.5, 1, 1.5, 1.5, 1.5], "
                     "no_load_speed: 3, efficiency: 0.6, u_max: 9}\n"
                     "cpg: {type: sine, frequency: 1, amplitude: 0.6}\nduration: 1\n", ["physics.engine=articulated"], checks.ALL),
    "servo, joint": (THROWN + GAINS + "actuator: {type: servo, voltage: 7.4, stall_torque: 1.5, no_load_speed: 3, "
                           "load_friction: 0.25, stall_torque_at: joint}\n"
                           "cpg: {type: sine, frequency: 1, amplitude: 0.6}\nduration: 1\n", ["physics.engine=articulated"], checks.ALL),
    "steps, bullet": (STEPS, ["trace.period=2.5e-5", "physics.step=2.5e-5", "actuator.rotor_inertia=1e-9"],
                      checks.ALL + (steps.steps,)),
    "steps, implicit": (STEPS, ["duration=0.6", "trace.period=5e-4", "physics.engine=articulated",
                                "physics.integrator=implicit", "actuator.i_max=0.4"],
                        checks.ALL + (steps.steps,)),
    "rk4, bullet": (STEPS, ["duration=0.06", "trace.period=4e-5", "physics.step=4e-5", "physics.integrator=rk4"], (steps.runge_kutta,)),
    "rk4, articulated": (STEPS, ["duration=0.06", "trace.period=4e-5", "physics.engine=articulated", "physics.step=4e-5",
                                 "physics.integrator=rk4", "actuator.rotor_inertia=1e-9"], (steps.runge_kutta,)),
    "phases, each its own": (FREE + "cpg: {frequency: [0.2, 0.3, 0.25, 0.25, 0.4, 0.3], amplitude: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], "
                             "offset: 0.1, phase_lag: [0, 1, 0.5, -0.4, 0.3, 2], step: 0.005, model: {coupling: 3, amplitude_weighted: true}}\n",
                             [], (checks.patterns, checks.motors)),
    "phases, round a circle": (FREE + "cpg: {couplings: [{from: 0, to: 1, weight: 2, phase_lag: 1}, {from: 1, to: 2, weight: 2, "
                               "phase_lag: 1}, {from: 2, to: 0, weight: 2, phase_lag: 1}, {from: m0/active, to: 3, weight: 1, phase_lag: 0.5}, "
                               "{from: 3, to: 4, weight: 4, phase_lag: -0.5}, {from: 4, to: 5, weight: 1, phase_lag: 2}]}\n",
                               [], (checks.patterns, checks.motors)),
    "phases, parent": (LEGS + "cpg: {frequency: 0.5, phase_lag: 0.7, couplings: parent}\n", [], (checks.patterns,)),
    "phases, siblings": (LEGS + "cpg: {frequency: 0.5, amplitude: 0.3, phase_lag: {default: 0.7, m5/passive: 0.2}, couplings: siblings}\n",
                         ["cpg.frequency={default: 0.5, m0/active: 0.3, m7/active: 0.8}"], (checks.patterns,)),
    "phases, all": (LEGS + "cpg: {phase_lag: 0.7, couplings: all, model: {coupling: 2}}\n",
                    ["cpg.frequency={default: 0.5, m0/active: 0.3, m7/active: 0.8}"], (checks.patterns,)),
    "amplitudes couple": (LEGS + "cpg: {type: kuramoto_amplitude, offset: 0.1, couplings: parent}\n",
                          ["cpg.frequency={default: 0.5, m0/active: 0.3, m7/active: 0.8}"], (checks.patterns,)),
    "Hopf": (LEGS + "cpg: {type: hopf, offset: -0.1, couplings: siblings}\n",
             ["cpg.frequency={default: 0.5, m0/active: 0.3, m7/active: 0.8}"], (checks.patterns,)),
    "splines": (FREE + "cpg: {type: keyframes, model: {ramp: 0.5, frames: [{time: 0, angles: 0.1}, {time: 0.7, angles: [0.5, 0, -0.5, 0.2, "
                "0.3, 0]}, {time: 1.1, angles: -0.2}, {time: 2, angles: 0.1}]}}\n", [], (checks.patterns, checks.motors)),
    "held": (FREE + "initial: {angles: 0.2}\n", ["duration=1"], (checks.patterns, checks.controllers, checks.motors, checks.bodies)),
}
# Situations that must have occurred. Otherwise a line could pass without samples.
MUST = (
    "motors below their limits", "motors at the voltage limit", "motors at the current limit", "directional gears driven backwards", "joints that stick",
    "integrals held by anti-windup", "integrals without anti-windup", "phases off the limit cycle", "stops that push",
    "stops that would pull", "points that stick", "points that slide", "spheres that stick", "spheres that slide",
    "contacts that would pull", "contacts on boxes", "Hertz contacts", "explicit steps", "Runge-Kutta steps", "implicit steps away from corners",
)


def scaled(*path, by):
    """Change that multiplies a constant of the scenario, or all entries of a list, by `by`."""

    def edit(run, rules):
        *way, last = path
        section = run.scenario
        for key in way:
            section = section[key]
        value = section[last]
        section[last] = [x * by for x in value] if isinstance(value, list) else value * by

    return edit


def rule(key, value):
    return lambda run, rules: rules.__setitem__(key, value)


def put(*path, value):
    def edit(run, rules):
        *way, last = path
        section = run.scenario
        for key in way:
            section = section[key]
        section[last] = value

    return edit


def cell(column, by):
    """Change that multiplies all numbers of a column by `by`."""

    def edit(run, rules):
        run.rows[:, run.index[column]] *= by

    return edit


def body(name, key, by):
    return scaled("robot", "types", "mtran", "bodies", name, key, by=by)


# Mutants: name, run, check, line that must fail, change.
MUTANTS = (
    ("R + 0.1 %", "hexapod, bullet", checks.motors, "eq. 1", scaled("actuator", "R", by=1.001)),
    ("Ks + 0.1 %", "hexapod, adaptive", checks.motors, "eq. 1", scaled("actuator", "Ks", by=1.001)),
    ("u_max + 0.1 %", "limits, adaptive", checks.motors, "eq. 1", scaled("actuator", "u_max", by=1.001)),
    ("i_max + 0.1 %", "limits, bullet", checks.motors, "eq. 1", scaled("actuator", "i_max", by=1.001)),
    ("Kt + 0.1 %", "caterpillar, bullet", checks.motors, "eq. 2", scaled("actuator", "Kt", by=1.001)),
    ("efficiency 0.7 both ways", "limits, adaptive", checks.motors, "eq. 2", put("actuator", "efficiency_model", value="paper")),
    ("stall_torque + 0.1 %", "servo", checks.motors, "eq. 2", scaled("actuator", "stall_torque", by=1.001)),
    ("no_load_speed + 0.1 %", "servo", checks.motors, "eq. 1", scaled("actuator", "no_load_speed", by=1.001)),
    ("dry_friction + 0.1 %", "friction, adaptive", checks.motors, "eq. 2, directional", scaled("actuator", "dry_friction", by=1.001)),
    ("viscous_friction + 0.1 %", "friction, adaptive", checks.motors, "eq. 2, directional", scaled("actuator", "viscous_friction", by=1.001)),
    ("less dry friction at rest", "friction, adaptive", checks.motors, "torque at rest", scaled("actuator", "dry_friction", by=0.5)),
    ("turn_speed + 1 %", "limits, bullet", checks.motors, "eq. 2, directional", scaled("actuator", "turn_speed", by=1.01)),
    ("Kp + 0.1 %", "limits, adaptive", checks.controllers, "eq. 3", scaled("controller", "Kp", by=1.001)),
    ("Ki + 0.1 %", "limits, adaptive", checks.controllers, "eq. 4", scaled("controller", "Ki", by=1.001)),
    ("anti-windup looks at this tick's error", "limits, adaptive", checks.controllers, "eq. 4", rule("anti-windup", "this")),
    ("anti-windup looks at this tick's error", "limits, bullet", checks.controllers, "eq. 4", rule("anti-windup", "this")),
    ("anti-windup off", "limits, adaptive", checks.controllers, "eq. 4", rule("anti-windup", "off")),
    ("anti-windup on", "Hertz, adaptive", checks.controllers, "eq. 4", put("controller", "anti_windup", value=True)),
    ("derivative's sign", "limits, adaptive", checks.controllers, "eq. 5", rule("derivative", -1)),
    ("N + 0.1 %", "limits, adaptive", checks.controllers, "eq. 5", scaled("controller", "N", by=1.001)),
    ("lag's sign", "caterpillar, bullet", checks.patterns, "eq. 7", scaled("cpg", "phase_lag", by=-1)),
    ("frequency + 0.1 %", "caterpillar, bullet", checks.patterns, "eq. 7", scaled("cpg", "frequency", by=1.001)),
    ("weight of a coupling + 0.1 %", "phases, each its own", checks.patterns, "eq. 7", scaled("cpg", "model", "coupling", by=1.001)),
    ("couplings not weighted by amplitudes", "phases, each its own", checks.patterns, "eq. 7",
     put("cpg", "model", "amplitude_weighted", value=False)),
    ("a_r + 0.1 %", "caterpillar, bullet", checks.patterns, "eq. 8", scaled("cpg", "model", "amplitude_rate", by=1.001)),
    ("offset + 1e-9", "phases, each its own", checks.patterns, "eq. 9", put("cpg", "offset", value=0.1 + 1e-9)),
    ("cos for sin", "caterpillar, bullet", checks.patterns, "eq. 10", rule("sin", np.cos)),
    ("lags of siblings + 0.1 %", "phases, siblings", checks.patterns, "eq. 7", scaled("cpg", "phase_lag", by=1.001)),
    ("coupling + 0.1 %", "amplitudes couple", checks.patterns, "cpg kuramoto_amplitude", scaled("cpg", "model", "coupling", by=1.001)),
    ("lag + 0.1 %", "Hopf", checks.patterns, "cpg hopf", scaled("cpg", "phase_lag", by=1.001)),
    ("tilt + 0.1 %", "hexapod, bullet", checks.patterns, "gait tripod", scaled("cpg", "model", "tilt", by=1.001)),
    ("ramp + 0.1 %", "hexapod, adaptive", checks.patterns, "gait tripod", scaled("cpg", "model", "ramp", by=1.001)),
    ("straight lines for splines", "splines", checks.patterns, "gait keyframes", put("cpg", "model", "interpolation", value="linear")),
    ("sphere's radius + 1 um", "caterpillar, bullet", checks.contacts, "eq. 12, penetration",
     lambda run, rules: [e.update(radius=e["radius"] + 1e-6) for e in run.scenario["robot"]["types"]["mtran"]["contacts"]["all"]
                         if "radius" in e]),
    ("Kn + 0.1 %", "hexapod, bullet", checks.contacts, "eq. 12, normal", scaled("contact", "stiffness", by=1.001)),
    ("Cd + 0.1 %", "hexapod, adaptive", checks.contacts, "eq. 12, normal", scaled("contact", "damping", by=1.001)),
    ("k + 0.1 %", "Hertz, adaptive", checks.contacts, "eq. 12, normal", scaled("contact", "exponent", by=1.001)),
    ("d + 0.1 %", "Hertz, adaptive", checks.contacts, "eq. 12, normal", scaled("contact", "damping_exponent", by=1.001)),
    ("f + 1 %", "hexapod, bullet", checks.contacts, "eq. 12, friction", scaled("ground", "friction", by=1.01)),
    ("v_lim + 1 %", "hexapod, adaptive", checks.contacts, "eq. 12, friction", scaled("contact", "slip_speed", by=1.01)),
    ("fn of one element + 1e-9 of it", "hexapod, adaptive", checks.contacts, "eq. 12, normal", cell("contact.0.fn", 1 + 1e-9)),
    ("friction of a box", "rubble, adaptive", checks.contacts, "eq. 12, friction",
     lambda run, rules: run.scenario["ground"]["boxes"][0].update(friction=0.31)),
    ("stop's stiffness + 0.1 %", "limits, adaptive", checks.stops, "hinge stop", rule("stop", {"stiffness": 50.05})),
    ("stop's damping + 0.1 %", "limits, bullet", checks.stops, "hinge stop", rule("stop", {"damping": 0.5005})),
    ("a dock turned by a quarter more", "hexapod, bullet", checks.bodies, "poses",
     lambda run, rules: run.scenario["robot"]["docks"][4].__setitem__(4, 2)),
    ("a link 0.1 % heavier", "hexapod, bullet", checks.bodies, "momentum", body("link", "mass", 1.001)),
    ("inertia of a block + 0.1 %", "limits, adaptive", checks.bodies, "angular momentum", body("active", "inertia", 1.001)),
    ("rotors forgotten", "steps, bullet", checks.bodies, "stored", put("actuator", "rotor_inertia", value=0)),
    ("gravity 9.80665", "steps, bullet", steps.steps, "motion, velocities", put("physics", "gravity", value=[0, 0, -9.80665])),
    ("inertia of a block + 0.1 %", "steps, bullet", steps.steps, "motion, velocities", body("passive", "inertia", 1.001)),
    ("explicit for implicit", "steps, implicit", steps.steps, "motion, velocities", put("physics", "integrator", value="semi_implicit")),
    ("f + 0.1 %", "rk4, bullet", steps.runge_kutta, "motion, rk4", scaled("ground", "friction", by=1.001)),
    ("a block 0.01 % heavier", "rk4, articulated", steps.runge_kutta, "motion, rk4", body("active", "mass", 1.0001)),
    ("Kn + 0.1 %", "steps, implicit", steps.steps, "motion, implicit", scaled("contact", "stiffness", by=1.001)),
    ("stops' work + 1e-6 of it", "steps, implicit", steps.steps, "ledger, stops", cell("energy.stops", 1 + 1e-6)),
    ("copper + 1e-9 of it", "steps, implicit", steps.steps, "ledger, motors", cell("energy.copper", 1 + 1e-9)),
    ("friction's work + 1e-6 of it", "steps, bullet", steps.steps, "ledger, ground", cell("energy.friction", 1 + 1e-6)),
)


def run_all(program, scenarios, folder):
    runs = {}
    for shared in ("modules", "robots"):
        (folder / shared).symlink_to(scenarios / shared)
    for number, (name, (scenario, overrides, _)) in enumerate(RUNS.items()):
        path = scenarios / f"{scenario}.yaml"
        if "\n" in scenario:
            path = folder / f"{number}.yaml"
            path.write_text(scenario)
        sets = [word for override in ["trace.columns=['*']"] + overrides for word in ("--set", override)]
        done = subprocess.run([program, "run", path, "--quiet", "--out", folder / f"run-{number}", *sets],
                              capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{name}: the program ends with {done.returncode}: {done.stderr}")
        runs[name] = Run(name, folder / f"run-{number}")
    return runs


def report(gate):
    bad = []
    for key, (what, tolerance, why) in checks.LINES.items():
        if key not in gate.worst:
            bad.append(f"{key}: no samples")
            continue
        verdict = "FAILED" if gate.red(key) else "ok"
        print(f"{verdict:7}{key:22}{gate.worst[key]:8.1e} <= {tolerance:<8.1e}{gate.count[key]:9} samples   {what}")
        print(f"       {'':22}{'worst in ' + gate.where[key] if gate.worst[key] else 'equal'}; tolerance: {why}")
        if gate.red(key):
            bad.append(f"{key}: {gate.worst[key]:.3g} > {tolerance:.3g} in {gate.where[key]}")
    print("\nmust have occurred, in samples: " + ", ".join(f"{key} {gate.seen.get(key, 0)}" for key in MUST))
    return bad + [f"never seen: {key}" for key in MUST if not gate.seen.get(key)]


def sharp(runs):
    bad = []
    print(f"\n{len(MUTANTS)} mutants, each of which must turn its line red:")
    for name, run, check, key, edit in MUTANTS:
        rules, gate = {}, checks.Gate()
        check(gate, runs[run].changed(lambda copy: edit(copy, rules)), rules)
        verdict = "red" if gate.red(key) else "MISSED"
        print(f"{verdict:7}{key:22}{gate.worst.get(key, 0):8.1e} >  {checks.LINES[key][1]:<8.1e}{name} ({run})")
        if not gate.red(key):
            bad.append(f"missed: {name} ({run})")
    return bad


def main():
    program, scenarios = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    with tempfile.TemporaryDirectory() as folder:
        runs = run_all(program, scenarios, pathlib.Path(folder))
    gate = checks.Gate()
    for name, (_, _, chosen) in RUNS.items():
        for check in chosen:
            check(gate, runs[name], {})
    bad = report(gate) + sharp(runs)
    for line in bad:
        print("FAILED", line)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
