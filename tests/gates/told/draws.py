"""Runs whose sentences are checked: shipped robots, robots of the library, and random robots, with random gaits, limits and ratings.
A seed makes them reproducible.

A draft run shows what happens; ratings and limits are then drawn around that, so that each fails in some runs, warns in others
and is kept in others. The file that runs is the draft's resolved scenario with these, as JSON, which is YAML."""
import json
import pathlib
import random

import numpy as np
import yaml

from yaml12 import Loader
from told.motors import grown, peaks
from told.record import LIMITS, Record
from told.verdict import Judged

FAST = ["physics.engine=articulated"]
TREE = """gaitlab: 1
name: {name}
robot: {{modules: mtran, docks: {docks}}}
contact: {{on: all}}
cpg: {{type: {cpg}, frequency: 1, amplitude: 0.4, phase_lag: {lag}}}
duration: 4
"""
# Runs by name: scenario (file of the folder, or text), settings, and limits that are not random.
RUNS = {
    "caterpillar": ("caterpillar", FAST + ["duration=12"]),
    "caterpillar, little current": ("caterpillar", FAST + ["duration=12", "actuator.i_max=0.33"]),
    "caterpillar, bullet": ("caterpillar", ["duration=3.2", "cpg.frequency=1", "cpg.amplitude=0.5"]),
    "caterpillar, wild": ("caterpillar", FAST + ["duration=6", "cpg.frequency=0.6", "cpg.amplitude=1.7"]),
    "caterpillar, dropped": ("caterpillar", FAST + ["duration=4", "cpg.frequency=0.9", "robot.position=[0, 0, 0.3]"]),
    "caterpillar, on its nose": ("caterpillar", FAST + ["duration=4", "cpg.frequency=1", "robot.position=[0, 0, 0.45]",
        "robot.orientation=[0, -1.4, 0]"]),
    "equations": ("caterpillar-equations", FAST + ["duration=12"]),
    "equations that end": ("caterpillar-equations", FAST + ["duration=3",
        "cpg.model={output: \"offset + if(t < 1.2, 0.3*sin(4*t), log(-1))\"}"]),
    "hexapod": ("hexapod", FAST + ["duration=6"]),
    "hexapod, fast": ("hexapod", FAST + ["duration=4", "cpg.frequency=1.2", "cpg.amplitude=0.6"]),
    "hexapod, bullet": ("hexapod", ["duration=1.6", "cpg.frequency=2", "cpg.amplitude=0.3"]),
    "hexapod, thrown": ("hexapod", FAST + ["contact.on=all", "duration=6", "initial.base_velocity=[0, 0, 1.2]",
        "initial.base_angular_velocity=[12.8, 0, 0]"]),
    "hexapod, down a slope": ("hexapod", FAST + ["duration=5", "contact.on=all", "physics.gravity=[4.9, 0, -8.5]",
        "ground.friction=0.3"]),
    "hexapod, Bullet's solver": ("hexapod", ["contact={law: bullet, on: all}", "duration=3", "cpg.frequency=1"]),
    "hexapod, on two": ("hexapod", FAST + ["duration=2.5", "cpg.frequency=0.9", "initial.angles={default: 0, m3/passive: 0.2}"]),
    "hexapod, jumps": ("hexapod", FAST + ["contact.on=all", "duration=3",
        "cpg={type: sine, frequency: 2.4, amplitude: 0.9, phase_lag: 0}", "actuator.u_max=20", "actuator.i_max=6"],
        {"collision": 0.1, "touch": 0.0005}),
    "octopod": ("octopod", FAST + ["duration=6"]),
    "rubble": ("rubble", FAST + ["duration=7"]),
    "dtto": ("library/dtto-caterpillar", ["duration=12"]),
    "ckbot": ("library/ckbot-worm", ["duration=6", "cpg.amplitude=1.5"]),
    "polybot": ("library/polybot-worm", ["duration=6"]),
    "yamor": ("library/yamor-worm", ["duration=6", "cpg.offset={default: 0, m3/hinge: 1.3}"]),
    "y1, two": ("library/y1-pp", ["duration=6"]),
    "y1, rolling": ("library/y1-rolling", ["duration=6"]),
    "y1, sidewinding": ("library/y1-sidewinding", ["duration=6"]),
    "y1, snake": ("library/y1-snake", ["duration=6"]),
    "revolve": ("library/revolve-spider", ["duration=6"]),
    "rofi": ("library/rofi-snake", ["duration=6"]),
    "molecubes": ("library/molecubes-arm", ["duration=15"]),
    "molecubes, held": ("library/molecubes-arm", ["duration=15", "robot.base=fixed", "ground.type=none", "contact.on=none"]),
    "mobot": ("library/mobot-inchworm", ["duration=12"]),
    "smores": ("library/smores-drive", ["duration=12.5"]),
    "linkbot": ("library/linkbot-drive", ["duration=12.5"]),
    "linkbot, briefly": ("library/linkbot-drive", ["duration=6"]),
    "atron": ("library/atron-drive", ["duration=13"]),
    "pendulum": ("pendulum", ["duration=3"]),
    "planar": ("caterpillar", FAST + ["duration=4", "cpg.frequency=0.9", "robot.base=planar"]),
    "torque sources": ("hexapod", FAST + ["duration=3", "cpg.frequency=1", "actuator={type: torque, limit: 0.9}",
        "controller={type: pid, unit: N m, Kp: 2, Kd: 0.03}"]),
    "torque sources, unlimited": ("caterpillar", FAST + ["duration=2", "cpg.frequency=1.6", "actuator={type: torque}",
        "controller={type: pid, unit: N m, Kp: 2, Kd: 0.03, period: 0.003}"]),
    "off its field": ("caterpillar", FAST + ["duration=3.2", "cpg.frequency=1",
        "ground={type: heightfield, heightfield: {spacing: 0.4, origin: [0.4, -0.5, 0], "
        "values: [[0, 0.004, 0, 0.01], [0, 0, 0.01, 0], [0.004, 0, 0, 0], [0, 0, 0.004, 0], [0, 0, 0, 0]]}}"]),
    "on its field": ("hexapod", FAST + ["duration=2.4", "cpg.frequency=1", "contact.on=all",
        "ground={type: heightfield, heightfield: {spacing: 0.5, origin: [-1.4, -1.2, 0], "
        "values: [[0, 0.004, 0, 0.01, 0.002, 0], [0, 0, 0.01, 0, 0, 0], [0.004, 0, 0, 0.003, 0, 0], [0, 0, 0.004, 0, 0, 0], "
        "[0, 0, 0, 0, 0, 0]]}}"]),
    "hexapod, allowed": ("hexapod", FAST + ["duration=3", "cpg.frequency=1.2", "cpg.amplitude=0.6"],
        {"saturated_share": 0.99, "saturated_periods": 1000}),
    "short": ("hexapod", FAST + ["duration=0.7"]),
    "short, and broken": ("caterpillar", FAST + ["duration=0.8", "robot.position=[0, 0, 0.3]"]),
    "keyframes": ("hexapod", FAST + ["duration=3",
        "cpg={type: keyframes, model: {ramp: 0.5, frames: [{time: 0, angles: 0}, "
        "{time: 0.8, angles: {default: 0, \"*/passive\": 0.3}}, {time: 2, angles: 0}]}}"]),
    "makes energy": ("hexapod", FAST + ["duration=3", "cpg.frequency=1", "actuator.Kt=0.008"]),
    "coarse steps": ("hexapod", FAST + ["duration=3", "cpg.frequency=1", "physics.integrator=implicit", "physics.step=0.005"]),
    "one joint slower": ("hexapod", FAST + ["duration=4",
        "cpg={type: sine, amplitude: 0.2, couplings: [], frequency: {default: 1, m3/active: 0.7}}"], {"progress": 0}),
    "still growing": ("library/y1-pp", ["duration=7", "cpg.model.ramp=6"]),
    "too long a step": ("hexapod", FAST + ["duration=1.2", "cpg.frequency=2.6", "physics.integrator=rk4", "physics.step=2e-5"]),
    "stands": ("caterpillar", FAST + ["duration=3", "cpg.amplitude=0"]),
    "back-driven": ("caterpillar", FAST + ["duration=3.2", "cpg.frequency=1", "actuator.efficiency=0.35",
        "actuator.efficiency_model=directional"]),
}
# Robots that no ground carries.
SLOW = ["cpg.frequency=0.5", "cpg.amplitude=0.2", "duration=6"]
EASY = {"saturated_share": 0.99, "saturated_periods": 1000, "tilt": 1.5, "tracking_error": 1, "torque_error": 0.9}
UNBORNE = {
    "without gravity": ("caterpillar", FAST + SLOW + ["physics.gravity=[0, 0, 0]"], EASY),
    "above nothing": ("caterpillar", FAST + SLOW + ["ground.type=none", "contact.on=none"], EASY),
    "touches nothing": ("caterpillar", FAST + SLOW + ["contact.on=none"], EASY),
}
# Runs that were added later. They come last, because the draws of a run depend on its place.
LATER = {
    "holds more than its stall torque": ("library/ckbot-worm", ["duration=12", "actuator.stall_torque=0.5",
        "actuator.stall_torque_at=motor", "actuator.load_friction=0.3"]),
    "torque sources, unstable": ("caterpillar", FAST + ["duration=2", "cpg.frequency=1.6", "actuator={type: torque}",
        "controller={type: pid, unit: N m, Kp: 2, Kd: 0.03}"]),
    "more power than any motor": ("caterpillar", FAST + ["duration=3.2", "cpg.frequency=1", "actuator.u_max=100", "actuator.i_max=20"]),
    "friction": ("hexapod", FAST + ["duration=4", "cpg.frequency=1", "actuator.dry_friction=0.1", "actuator.viscous_friction=0.09"]),
    "friction and directional gears": ("caterpillar", FAST + ["duration=4", "cpg.frequency=1", "actuator.dry_friction=0.2",
        "actuator.efficiency_model=directional"]),
    "held by friction": ("caterpillar", FAST + ["duration=3", "cpg.amplitude={default: 0, m2/active: 0.3}", "actuator.dry_friction=1"]),
    "a worm with friction": ("library/ckbot-worm", ["duration=8", "actuator.dry_friction=0.06", "actuator.load_friction=0.2"]),
    "a supply above the sheet's": ("library/yamor-worm", ["duration=8", "actuator.u_max=8", "cpg.amplitude={default: 0, m2/hinge: 0.4}"]),
}
CPGS = ["sine", "hopf", "kuramoto_amplitude", "matsuoka", "phase_oscillator", "van_der_pol"]
GAITS = {"frequency": (0.8, 1.25), "amplitude": (0.75, 1.2)}


# The bus is recomputed from rows at control ticks (told/battery.py).
BUS = FAST + ["trace.period=0.015", "trace.columns=[t, joint.*, base.*, com.*, supply.*]"]
SUPPLIED = {
    "caterpillar, battery": ("caterpillar", BUS + ["duration=12", "supply={voltage: 7.4, resistance: 0.3, current: 2, least: 6.6}"]),
    "hexapod, brown-out": ("hexapod", BUS + ["duration=6", "cpg.frequency=0.8", "supply={voltage: 7.4, resistance: 1.2, current: 1, least: 6}"]),
}
# Gears with play: the scenario, its module type, whose hinges get the play, and settings.
GEARED = {
    "a worm with play": ("library/ckbot-worm", "ckbot", ["duration=6"]),
    "a caterpillar with play": ("caterpillar", "mtran", ["duration=4", "cpg.frequency=1", "actuator.rotor_inertia=1e-8",
        "actuator.dry_friction=0.05"]),
}
SCENARIOS = pathlib.Path(__file__).parents[3] / "scenarios"


def geared(rng, scenario, module, settings):
    """Text of a scenario with random play in every hinge, drawn again within tolerances, and its settings."""
    load = lambda name: yaml.load((SCENARIOS / f"{name}.yaml").read_text(), Loader)
    text, kind = load(scenario), load(f"modules/{module}")
    for hinge in kind["hinges"]:
        hinge |= {"play": rng.uniform(0.003, 0.04), "encoder": rng.choice(["output", "motor"]), "play_stiffness": 10 ** rng.uniform(1.5, 2.5)}
    text["robot"]["modules"] = kind
    text["tolerances"] = {"play": rng.uniform(0.05, 0.4), "gear_friction": 0.1}
    return [json.dumps(text)], FAST + settings + [f"seed={rng.randrange(1, 10**6)}"]


def random_tree(rng, count):
    """Docks of a random robot of M-TRAN modules."""
    rows, free = [], [(0, face) for face in (0, 1, 2, 3, 4, 5)]
    for k in range(1, count):
        parent, face = rng.choice([f for f in free if f[0] == k - 1 or rng.random() < 0.5] or free)
        own = rng.choice((0, 1, 2) if face > 2 else (3, 4, 5))
        rows.append([own, k, face, parent, rng.randrange(4)])
        free.remove((parent, face))
        free += [(k, f) for f in range(6) if f != own]
    return rows


LEVELS = {"fail": (0.55, 0.93), "warn": (1.03, 1.2), "pass": (1.5, 4), "close": (0.9995, 1.0005)}


def level(rng, mild):
    """Random factor of a rating. The limit is this factor times the value in the draft run."""
    name = rng.choices(list(LEVELS), [0, 0.2, 0.8, 0] if mild else [0.22, 0.28, 0.44, 0.06])[0]
    return rng.uniform(*LEVELS[name])


def limits(rng, record, judged, mild):
    """Random limits around the values of the draft run."""
    seen = lambda check: judged.checks[check].value if judged.checks[check] is not None else np.nan
    out = dict(LIMITS)
    out["warn_share"] = rng.choice([0.5, 0.8, 0.8, 0.9])
    out["saturated_share"] = 10 ** rng.uniform(-3, -0.3)
    out["saturated_periods"] = rng.choice([1, 3, 3, 8, 2.5, 40])
    out["height"] = 0.5 if mild else rng.choice([0.5, 0.9, 0.99])
    out["tilt"] = rng.choice([1.0471975511965976, 0.05, 0.3])
    out["slip"] = 10 ** rng.uniform(-1.3, 0.5)
    out["sink"] = 0.005 if mild else rng.choice([0.005, 0.005, 0.001])
    out["collision"], out["touch"] = rng.choice([(0.002, 0.0005), (0.06, 0.0005), (0.01, 0.005)])
    out["energy_created"] = 10 ** rng.uniform(-2, -0.5)
    out["energy_residual"] = 10 ** rng.uniform(-6, -2)
    out["start_jump"] = rng.choice([0.05, 0.001, 0.3])
    if rng.random() < 0.25 and not mild:
        out["progress"] = rng.uniform(0.005, 0.1)
    if np.isfinite(seen("tracking")) and seen("tracking") > 1e-6:
        out["tracking_error"] = min(1000, seen("tracking") * rng.choice([0.7, 0.9, 1.5, 3] + [0.35, 0.45] * (not mild)))
    if record.count and record.joints["range_worst"].max() > 1e-9:
        out["beyond_range"] = min(100, record.joints["range_worst"].max() * rng.choice([0.5, 1.5, 3]))
        out["beyond_range_share"] = min(1, record.joints["range_share"].max() * rng.choice([0.5, 1.5, 3]))
    if rng.random() < 0.15 and np.isfinite(seen("torque_error")):
        out["torque_error"] = float(np.clip(seen("torque_error") * rng.uniform(0.5, 2), 1e-9, 1))
    return out


def ratings(rng, record, judged, scenario, mild):
    """Random ratings of motors, gears and docks, some of which may be absent."""
    actuator = scenario["actuator"]
    if actuator["type"] in ("dc_motor", "servo"):
        window = judged.window
        current = np.sqrt(grown(record, "current_square", window).max() / window.length)
        torque = np.sqrt(grown(record, "torque_square", window).max() / window.length)
        for key, value in (("i_continuous", current), ("gear_torque_peak", peaks(record, "torque_peak", 0)[0].max()),
                           ("gear_torque_continuous", torque), ("speed_max", peaks(record, "speed_peak", 0)[0].max())):
            actuator.pop(key, None)
            if rng.random() < 0.75 and value > 0:
                actuator[key] = float(value * level(rng, mild))
        if rng.random() < 0.3:
            actuator["source"] = "a data sheet"
    if record.loads is None or not scenario["robot"].get("docks"):
        return
    peak = {}
    for q in ("tension", "shear", "bending", "torsion"):
        columns = [c for c in record.loads.columns if c.startswith("dock.") and c.endswith(q)]
        if columns and rng.random() < 0.75:
            peak[q] = max((record.loads[c] if q == "tension" else abs(record.loads[c])).max() for c in columns)
    held = {q: float(value * level(rng, mild)) for q, value in peak.items() if value > 1e-6}
    for data in scenario["robot"]["types"].values():
        for name in {face.get("connector", "latch") for face in data["faces"]}:
            data.setdefault("connectors", {})[name] = held | {"source": rng.choice(["chosen: drawn", "a data sheet"])}
        for face in data["faces"]:
            face.setdefault("connector", "latch")


def drawn(rng, draft, name, fixed):
    """Text of the final scenario, from the folder of a draft run."""
    record = Record(draft / "trace.h5")
    judged, scenario = Judged(record, whole=False), json.loads(json.dumps(record.scenario))
    scenario["name"] = name
    mild = rng.random() < 0.4
    if len(record.t) > 2 and record.driven.any():
        ratings(rng, record, judged, scenario, mild)
    scenario["limits"] = limits(rng, record, judged, mild) | fixed
    return json.dumps(scenario)


def plan(seed):
    """List of all runs as (name, scenario or texts, settings, limits)."""
    rng, out = random.Random(seed), []
    for name, (scenario, settings, *fixed) in RUNS.items():
        out.append((name, scenario, settings, *fixed))
    for k in range(4):  # each has several texts, of which the first without overlapping blocks runs
        texts = [TREE.format(name=f"random-{k}", docks=random_tree(rng, rng.randint(3, 6)), cpg=rng.choice(CPGS),
                             lag=f"{rng.uniform(0, 2):.3f}") for _ in range(20)]
        out.append((f"random {k}", texts, FAST))
    out += [(name, *run) for runs in (UNBORNE, LATER, SUPPLIED) for name, run in runs.items()]
    return out + [(name, *geared(rng, *run)) for name, run in GEARED.items()]
