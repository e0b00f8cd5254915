#!/usr/bin/env python3
"""The schemas that `gaitlab schema` prints, against the program: shipped files are valid, and both reject the same wrong files.
usage: schema.py PROGRAM SCENARIOS_FOLDER PUBLISHED_FOLDER
Exit code 77 if python3-jsonschema or python3-yaml is missing."""
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import jsonschema
    import yaml
    from yaml12 import Loader
except ImportError as error:
    print(f"left out: {error} (Debian: python3-jsonschema, python3-yaml)")
    sys.exit(77)

PROGRAM, SCENARIOS, PUBLISHED = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])


def named(value):
    """Value with texts as keys, as in JSON: {0: mtran} gets the key "0"."""
    if isinstance(value, dict):
        return {str(key): named(inner) for key, inner in value.items()}
    return [named(inner) for inner in value] if isinstance(value, list) else value


def load(text):
    return named(yaml.load(text, Loader))


schema = json.loads(subprocess.run([PROGRAM, "schema"], check=True, capture_output=True, text=True).stdout)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)
module_schema = json.loads(subprocess.run([PROGRAM, "schema", "--module"], check=True, capture_output=True, text=True).stdout)
jsonschema.Draft7Validator.check_schema(module_schema)
module_validator = jsonschema.Draft7Validator(module_schema)
failures = []


def expect_valid(name, text, by=validator):
    errors = [f"{'.'.join(map(str, error.path))}: {error.message}" for error in by.iter_errors(load(text))]
    if errors:
        failures.append(f"{name}: {'; '.join(errors)[:500]}")


def program_accepts(text):
    with tempfile.TemporaryDirectory() as folder:
        for shared in ("modules", "robots"):
            (pathlib.Path(folder) / shared).symlink_to(SCENARIOS / shared)
        (pathlib.Path(folder) / "s.yaml").write_text(text)
        code = subprocess.run([PROGRAM, "check", "s.yaml"], cwd=folder, capture_output=True).returncode
        if code not in (0, 2):
            failures.append(f"gaitlab check ends with {code}: {text}")
        return code == 0


def expect_agreement(text, right):
    by_schema, by_program = validator.is_valid(load(text)), program_accepts(text)
    if by_schema != right or by_program != right:
        verdict = {True: "accepts", False: "refuses"}
        failures.append(f"the schema {verdict[by_schema]}, the program {verdict[by_program]}: {text!r}")


def resolved(path):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PROGRAM, "run", path, "--quiet", "--set", "duration=0.005", "--out", "run"], cwd=folder, check=True)
        return (pathlib.Path(folder) / "run/scenario.resolved.yaml").read_text()


shipped = sorted(SCENARIOS.glob("*.yaml"))
for path in shipped:
    expect_valid(path.name, path.read_text())
    expect_valid(f"{path.name}, resolved", resolved(path))
    first = path.read_text().split("\n", 1)[0]
    if first != "# yaml-language-server: $schema=gaitlab.schema.json":
        failures.append(f"{path.name}: its first line does not name the schema")
for path in sorted(SCENARIOS.glob("modules/*.yaml")):
    expect_valid(path.name, path.read_text(), module_validator)
for path in sorted(PUBLISHED.glob("*.yaml")):
    text = path.read_text()
    expect_valid(path.name, text, module_validator if "gaitlab_module:" in text else validator)

# ---- modules


def program_takes_module(text):
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "m.yaml").write_text(text)
        code = subprocess.run([PROGRAM, "explain", "module", "m.yaml"], cwd=folder, capture_output=True).returncode
        if code not in (0, 2):
            failures.append(f"gaitlab explain module ends with {code}: {text}")
        return code == 0


def expect_module_agreement(text, right):
    by_schema, by_program = module_validator.is_valid(load(text)), program_takes_module(text)
    if by_schema != right or by_program != right:
        verdict = {True: "accepts", False: "refuses"}
        failures.append(f"the schema of modules {verdict[by_schema]}, the program {verdict[by_program]}: {text!r}")


with tempfile.TemporaryDirectory() as new_folder:
    subprocess.run([PROGRAM, "new", "module", "demo"], cwd=new_folder, check=True, capture_output=True)
    DEMO = (pathlib.Path(new_folder) / "demo.yaml").read_text()
MODULE = "gaitlab_module: 1\nname: m\n"
BODY = MODULE + "bodies: {b: {mass: 1, shape: [{sphere: 0.1}]}}\n"
PAIR = ("bodies: {b: {mass: 1, shape: [{box: [1, 1, 1]}]}, c: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}\n"
        "hinges: [{name: h, parent: b, child: c, axis: [0, 1, 0], ")
RIGHT_MODULES = [
    DEMO,
    BODY,
    BODY + "contacts: {all: shapes}\nlattice: false\nsource: here\n",
    BODY + "contacts: {feet: shapes, all: [{body: b, point: [0, 0, 1]}, {body: b, sphere: [0, 0, 1], radius: 0.1}]}\n",
    BODY + "faces: [{id: 0, body: b, gender: none, connector: k, turns: [0, 2], origin: [0, 0, 0], normal: [1, 0, 0], "
    "reference: [0, 1, 0]}]\nconnectors: {k: {tension: 1, source: x}}\n",
    BODY + "connectors: {}\n",
    MODULE + PAIR + "range: [-1, 1]}]\n",
    MODULE + PAIR + "range: free, drive: none, damping: 1}]\n",
    MODULE + PAIR + "range: [-1, 1], play: 0.01, play_stiffness: 80, encoder: motor}]\n",
    MODULE + PAIR + "range: [-1, 1]}]\nbattery: {voltage: 7, resistance: 0.1, capacity: 2, regenerates: true}\n",
    MODULE + PAIR + "range: [-1, 1], actuator: {R: 3}, controller: {Kp: 2}}]\nactuator: {type: dc_motor, R: 2}\n",
    MODULE + PAIR + "range: [-1, 1]}]\nactuator: {type: servo, voltage: 5, stall_torque: 1, no_load_speed: 5, source: x}\n"
    "controller: {type: pid, Kp: 3, source: x}\n",
]
WRONG_MODULES = [
    "name: m\nbodies: {b: {mass: 1, shape: [{sphere: 0.1}]}}\n",
    "gaitlab_module: 4\nname: m\nbodies: {b: {mass: 1, shape: [{sphere: 0.1}]}}\n",
    MODULE,
    MODULE + "bodies: {}\n",
    BODY + "colour: red\n",
    MODULE + "bodies: {b: {mass: -1, shape: [{sphere: 0.1}]}}\n",
    MODULE + "bodies: {b: {mass: 1, shape: [{sphere: 0.1, box: [1, 1, 1]}]}}\n",
    MODULE + "bodies: {b: {mass: 1, shape: [{origin: [0, 0, 0]}]}}\n",
    MODULE + "bodies: {b: {mass: 1, shape: [{sphere: 0}]}}\n",
    MODULE + "bodies: {b: {mass: 1, com: [0, 0], shape: [{sphere: 1}]}}\n",
    BODY + "contacts: {all: boxes}\n",
    BODY + "contacts: {all: [{body: b}]}\n",
    BODY + "contacts: {all: [{body: b, point: [0, 0, 1], sphere: [0, 0, 1], radius: 1}]}\n",
    BODY + "faces: [{id: 0, body: b, gender: male, origin: [0, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}]\n",
    BODY + "faces: [{id: 0, body: b, gender: none, turns: [4], origin: [0, 0, 0], normal: [1, 0, 0], reference: [0, 1, 0]}]\n",
    BODY + "connectors: {k: {tension: 0}}\n",
    MODULE + PAIR + "}]\n",
    MODULE + PAIR + "range: loose}]\n",
    MODULE + PAIR + "range: free, drive: loose}]\n",
    MODULE + PAIR + "range: free, play: -0.01}]\n",
    MODULE + PAIR + "range: free, play: 0.01, encoder: link}]\n",
    MODULE + PAIR + "range: free}]\nbattery: {voltage: 0}\n",
    MODULE + PAIR + "range: [-1, 1]}]\nactuator: {type: servomotor}\n",
    MODULE + PAIR + "range: [-1, 1]}]\nactuator: {type: dc_motor, Rr: 2}\n",
    MODULE + PAIR + "range: [-1, 1]}]\ncontroller: {type: pid, period: 0.01}\n",
]
for text in RIGHT_MODULES:
    expect_module_agreement(text, True)
for text in WRONG_MODULES:
    expect_module_agreement(text, False)

HEAD = "gaitlab: 1\nrobot: {modules: mtran}\n"
SHORT = HEAD + "duration: 1\n"
RIGHT = [
    SHORT,
    "robot: {}\nduration: 0.1\n",
    "robot: {position: [1, 2]}\nduration: 0.1\n",
    "robot: {position: [1, 2, 3]}\nduration: 0.1\n",
    SHORT + "name: 8\n",
    SHORT + "cpg: {}\n",
    SHORT + "cpg: {amplitude: 0.3, model: {coupling: 2}}\n",
    SHORT + "cpg: {type: sine, amplitude: [0.3, 0.2], model: {ramp: 1}}\n",
    SHORT + "cpg: {type: sine, amplitude: {default: 0.3, m0/passive: 0.2}, couplings: mirror}\n",
    SHORT + "cpg: {type: hopf, couplings: [{from: 0, to: m0/passive, weight: 2, phase_lag: 1}]}\n",
    SHORT + "actuator: {i_max: 0.8}\n",
    SHORT + "actuator: {i_max: {default: 0.8, '*/passive': 0.5, 'm?/active': 0.6}}\nfigure: {joints: ['*/active']}\n",
    SHORT + "actuator: {type: servo, voltage: 10, stall_torque: 1.618, no_load_speed: {'*': 5.343}, stall_current: 0.9}\n",
    SHORT + "actuator: {type: torque, limit: 2}\ncontroller: {type: pid, unit: N m, Kp: 5, Kd: 0.05}\n",
    SHORT + "actuator: {type: none}\n",
    SHORT + "actuator: {i_max: 0.8, source: data sheet 17}\n",
    SHORT + "controller: {type: hold, command: 1, period: 0.005}\n",
    SHORT + "physics: {engine: bullet, integrator: rk4, step: 1e-5}\n",
    SHORT + "ground: {type: boxes, boxes: [{center: [0, 0, 0.1], size: [1, 1, 0.2], rpy: [0, 0.1, 0], friction: 0.4}]}\n",
    SHORT + "ground: {type: heightfield, heightfield: {values: [[0, 0.1], [0, 0]], origin: [-1, -1, 0], spacing: 2}}\n",
    SHORT + "trace: {period: 0.005, columns: [joint.*]}\nsensors: []\nplugins: []\n",
    SHORT + "sensors: {}\n",
    SHORT + "sensors: {type: encoder, joints: '*', resolution: 0.00511, noise: 0.0035, delay: 0.015}\n",
    SHORT + "sensors: {e: {type: encoder, joints: [m0/active], delay: [0, 0.03]}, b: {type: imu, body: m0/active, gyro: {noise: 1}}}\n",
    SHORT + "at: []\n",
    SHORT + "cpg: {type: sine}\nat: [{t: 0.1, set: {cpg.frequency: 1, controller.Kp: 50}}]\n",
    SHORT + "at: [{t: 0, fault: {joint: m0/active, kind: dead}}]\n",
    SHORT + "at: [{t: 0.1, fault: [{joint: '*', kind: weak, share: 0.5}, {joint: [m0/active], kind: late, delay: 0.03}]}]\n",
    SHORT + "sensors: {d: {type: motor, measures: current}, f: {type: load, modules: [], bodies: m0/active, range: [0, 50]}}\n",
    "robot: {modules: {0: mtran, default: mtran}, docks: [[1, 1, 4, 0, 0]]}\nduration: 0.1\n",
    "robot: {modules: {name: one, bodies: {b: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}}}\ncontact: {on: none}\nduration: 0.1\n"
    "trace: {columns: [base.*]}\n",
]
WRONG = [
    HEAD,
    "gaitlab: 1\nduration: 1\n",
    "gaitlab: 2\nrobot: {}\nduration: 1\n",
    SHORT + "colour: red\n",
    HEAD + "duration: 0\n",
    HEAD + "duration: long\n",
    HEAD + "duration: '1'\n",
    SHORT + "seed: 1.5\n",
    SHORT + "cpg: {type: sin}\n",
    SHORT + "cpg: {frequncy: 1}\n",
    SHORT + "cpg: {frequency: 21}\n",
    SHORT + "cpg: {frequency: {default: fast}}\n",
    SHORT + "cpg: {type: sine, model: {coupling: 2}}\n",
    SHORT + "cpg: {type: hopf, couplings: [{from: 0, too: 1}]}\n",
    SHORT + "cpg: {couplings: chains}\n",
    SHORT + "cpg: []\n",
    SHORT + "actuator: {type: torque, i_max: 2}\ncontroller: {unit: N m}\n",
    SHORT + "actuator: {Rr: 2}\n",
    SHORT + "actuator: {type: servo, voltage: 0, stall_torque: 1, no_load_speed: 5}\n",
    SHORT + "actuator: {i_max: {'*/passive': -1}}\n",
    SHORT + "actuator: {type: none, i_max: 1}\n",
    SHORT + "actuator: {type: none, source: data sheet 17}\n",
    SHORT + "actuator: {efficiency_model: papr}\n",
    SHORT + "controller: {type: hold, Kp: 1}\n",
    SHORT + "physics: {engine: bulet}\n",
    SHORT + "physics: {integrator: euler}\n",
    SHORT + "physics: {gravity: [0, 0]}\n",
    SHORT + "ground: {type: plane, friction: -1}\n",
    SHORT + "ground: {type: boxes, boxes: [{size: [1, 1]}]}\n",
    SHORT + "ground: {type: boxes, boxes: [{size: [1, 1, 1], centre: [0, 0, 0]}]}\n",
    SHORT + "ground: {type: heightfield, heightfield: {values: [0, 1]}}\n",
    SHORT + "contact: {slip_speed: 0}\n",
    SHORT + "contact: {on: foot}\n",
    SHORT + "initial: {angles: high}\n",
    SHORT + "trace: {columns: joint.*}\n",
    SHORT + "at: {t: 0.1}\n",
    SHORT + "at: [{t: 0.1}]\n",
    SHORT + "at: [{fault: {joint: m0/active, kind: dead}}]\n",
    SHORT + "at: [{t: -1, fault: {joint: m0/active, kind: dead}}]\n",
    SHORT + "at: [{t: 0, fault: {joint: m0/active, kind: daed}}]\n",
    SHORT + "at: [{t: 0, fault: {joint: m0/active, kind: weak, share: 2}}]\n",
    SHORT + "at: [{t: 0, fault: {kind: dead}}]\n",
    SHORT + "at: [{t: 0, set: {physics.step: 0.001}}]\n",
    SHORT + "at: [{t: 0, set: {}}]\n",
    SHORT + "sensors: [imu]\n",
    SHORT + "sensors: imu\n",
    SHORT + "sensors: {e: {noise: 0.1}}\n",
    SHORT + "sensors: {e: {type: encodr}}\n",
    SHORT + "sensors: {type: encoder, nose: 1}\n",
    SHORT + "sensors: {e: {type: encoder, noise: -1}}\n",
    SHORT + "sensors: {e: {type: encoder, delay: [0, 0.015, 0.03]}}\n",
    SHORT + "sensors: {d: {type: motor, measures: [curent]}}\n",
    SHORT + "sensors: {b: {type: imu, body: m0/active, gyro: {nose: 1}}}\n",
    SHORT + "plugins: ./a.so\n",
    "robot: {modules: mtran, on_ground: 1}\nduration: 1\n",
    "robot: {modules: mtran, position: [1]}\nduration: 1\n",
    "robot: {modules: mtran, position: [1, 2, 3, 4]}\nduration: 1\n",
    "robot: {modules: mtran, docks: [[1, 1, 4, 0]]}\nduration: 1\n",
    "robot: {modules: {zero: mtran}}\nduration: 1\n",
    "robot: {modules: {name: one, bodies: {b: {mas: 1}}}}\nduration: 1\n",
]

# ---- studies

study_schema = json.loads(subprocess.run([PROGRAM, "schema", "--study"], check=True, capture_output=True, text=True).stdout)
jsonschema.Draft7Validator.check_schema(study_schema)
study_validator = jsonschema.Draft7Validator(study_schema)


def program_takes_study(text):
    """True if the program accepts a study. Without a question, `evaluate` only reads and checks the study."""
    with tempfile.TemporaryDirectory() as folder:
        for shared in ("modules", "robots"):
            (pathlib.Path(folder) / shared).symlink_to(SCENARIOS / shared)
        (pathlib.Path(folder) / "two.yaml").write_text(
            "robot: {modules: mtran, docks: [[1, 1, 4, 0, 0]]}\nphysics: {engine: articulated}\n"
            "cpg: {type: phase_oscillator}\nduration: 0.1\n")
        (pathlib.Path(folder) / "s.yaml").write_text(text)
        code = subprocess.run([PROGRAM, "evaluate", "s.yaml", "--out", "s", "--quiet"], cwd=folder, capture_output=True,
                              stdin=subprocess.DEVNULL).returncode
        if code not in (0, 2):
            failures.append(f"gaitlab evaluate ends with {code}: {text}")
        return code == 0


def expect_study_agreement(text, right):
    by_schema, by_program = study_validator.is_valid(load(text)), program_takes_study(text)
    if by_schema != right or by_program != right:
        verdict = {True: "accepts", False: "refuses"}
        failures.append(f"the schema of studies {verdict[by_schema]}, the program {verdict[by_program]}: {text!r}")


studies = sorted(SCENARIOS.glob("studies/*.yaml"))
for path in studies:
    expect_valid(f"studies/{path.name}", path.read_text(), study_validator)
    if path.read_text().split("\n", 1)[0] != "# yaml-language-server: $schema=../gaitlab-study.schema.json":
        failures.append(f"studies/{path.name}: its first line does not name the schema")

STUDY = "gaitlab_study: 1\nscenario: two.yaml\n"
LAG = STUDY + "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5}}\n"
RIGHT_STUDIES = [
    LAG,
    STUDY + "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5, scale: log, count: 3}, cpg.type: {values: [sine, hopf]}}\n",
    STUDY + "parameters: {legs: {low: 0, high: 1, sets: {cpg.offset: 0.3*legs - 0.1, cpg.phase_lag: 1}}}\n",
    "gaitlab_study: 1\nscenarios: {flat: two.yaml, 2: two.yaml}\nparameters: {cpg.phase_lag: {values: [1, 2]}}\n",
    LAG + "name: s\nset: [physics.step=0.001]\nseed: 3\nquantities: [speed]\n",
    LAG + "replicates: {count: 2, vary: {ground.friction: {normal: [0.8, 0.1], low: 0.3}, actuator.R: {times: {uniform: [0.9, 1]}}}, "
    "combine: quantile(0.9)}\n",
    LAG + "objective: [{maximize: speed}, {minimize: torque.peak}]\nconstraints: [torque.rms <= 1]\n",
    LAG + "guards: none\nstop: [fell, speed > 9 after 0.01]\n",
    LAG + "stop: none\n",
    LAG + "stop: [hopeless]\n",
    LAG + "guards: {stops: 0.1, dock_bending: {margin: 0.2}, periodic: true, slip: false}\nmethod: {type: cma, population: 16}\nbudget: {runs: 99}\nverify: {engine: none}\n",
]
WRONG_STUDIES = [
    STUDY,
    "gaitlab_study: 2\nscenario: two.yaml\nparameters: {cpg.phase_lag: {low: 0.5, high: 1.5}}\n",
    "gaitlab_study: 1\nparameters: {cpg.phase_lag: {low: 0.5, high: 1.5}}\n",
    LAG + "scenarios: {flat: two.yaml}\n",
    "gaitlab_study: 1\nscenarios: {}\nparameters: {cpg.phase_lag: {values: [1, 2]}}\n",
    "gaitlab_study: 1\nscenarios: {a b: two.yaml}\nparameters: {cpg.phase_lag: {values: [1, 2]}}\n",
    STUDY + "parameters: {}\n",
    STUDY + "parameters: {cpg.phase_lag: {low: 0.5}}\n",
    STUDY + "parameters: {cpg.phase_lag: {low: 0.5, high: 1 rad}}\n",
    STUDY + "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5, cuont: 2}}\n",
    STUDY + "parameters: {cpg.phase_lag: {low: 0.5, high: 1.5, values: [1]}}\n",
    STUDY + "parameters: {cpg.phase_lag: {values: []}}\n",
    STUDY + "parameters: {legs: {low: 0, high: 1, sets: {}}}\n",
    LAG + "objectiv: {maximize: speed}\n",
    LAG + "objective: {maximise: speed}\n",
    LAG + "objective: {maximize: speed, minimize: torque.peak}\n",
    LAG + "constraints: torque.rms <= 1\n",
    LAG + "guards: walk\n",
    LAG + "guards: {stop: 0.1}\n",
    LAG + "guards: {stops: {limit: 0.1}}\n",
    LAG + "guards: {field: 0.1}\n",
    LAG + "replicates: {combine: worst}\n",
    LAG + "replicates: {count: 0}\n",
    LAG + "replicates: {count: 2, combine: best}\n",
    LAG + "replicates: {count: 2, vary: {ground.friction: {normal: [0.8]}}}\n",
    LAG + "replicates: {count: 2, vary: {ground.friction: {uniform: [0, 1], normal: [0.8, 0.1]}}}\n",
    LAG + "stop: fell\n",
    LAG + "method: {type: cmaes}\n",
    LAG + "method: {type: cma, sigma: 2}\n",
    LAG + "budget: {runs: 64, wall: 1 h}\n",
    LAG + "verify: {best: 0}\n",
    LAG + "seed: -1\n",
]
for text in RIGHT_STUDIES:
    expect_study_agreement(text, True)
for text in WRONG_STUDIES:
    expect_study_agreement(text, False)

for text in RIGHT:
    expect_agreement(text, True)
for text in WRONG:
    expect_agreement(text, False)

print(f"{len(shipped)} shipped scenarios and their resolved form, {len(RIGHT)} right and {len(WRONG)} wrong ones; "
      f"{len(RIGHT_MODULES)} right and {len(WRONG_MODULES)} wrong modules; "
      f"{len(studies)} shipped studies, {len(RIGHT_STUDIES)} right and {len(WRONG_STUDIES)} wrong ones")
for failure in failures:
    print("FAILED", failure)
sys.exit(1 if failures else 0)
