#!/usr/bin/env python3
"""The answers of `gaitlab remedy`, checked by runs: twelve infeasible gaits and three that no setting makes feasible.

    tests/tools/remedy.py PROGRAM [--only NAME,NAME]

For each answer, `gaitlab run` with the answer's settings must be feasible, and with nine tenths of the change it must not be;
answers in remedy.json must be the same bytes with one thread and two. Prints a row per case: answers, runs, CPU time. The exit
code is 1 if a check fails. Takes about half an hour.
"""
import argparse, json, pathlib, re, resource, subprocess, sys, tempfile

OWN_MODULE = """
gaitlab_module: 1
name: elbow
source: "chosen: two boxes and a hinge"
bodies:
  lower: {mass: 0.2, inertia: [2e-4, 2e-4, 2e-4, 0, 0, 0], shape: [{box: [0.06, 0.06, 0.06], origin: [-0.03, 0, 0]}]}
  upper: {mass: 0.2, inertia: [2e-4, 2e-4, 2e-4, 0, 0, 0], shape: [{box: [0.06, 0.06, 0.06], origin: [0.03, 0, 0]}]}
hinges:
  - {name: elbow, parent: lower, child: upper, origin: [0, 0, 0], axis: [0, 1, 0], range: [-1.2, 1.2]}
connectors:
  plate: {bending: 0.8, source: chosen}
faces:
  - {id: 0, body: lower, gender: none, connector: plate, origin: [-0.06, 0, 0], normal: [-1, 0, 0], reference: [0, 0, 1]}
  - {id: 1, body: upper, gender: none, connector: plate, origin: [0.06, 0, 0], normal: [1, 0, 0], reference: [0, 0, 1]}
contacts: {feet: POINTS, all: POINTS}
actuator: {type: servo, voltage: 6, stall_torque: 3, no_load_speed: 6, source: chosen}
"""
POINTS = [{"body": body, "point": [x, y, z]} for body, ends in (("lower", (-0.06, 0)), ("upper", (0.06, 0)))
          for x in ends for y in (-0.03, 0.03) for z in (-0.03, 0.03)]  # corners of the boxes
OWN_MODULE = OWN_MODULE.replace("POINTS", json.dumps(POINTS))
OWN = """
gaitlab: 1
name: elbows
robot: {modules: elbow.yaml, docks: [[1, 1, 0, 0, 1], [1, 2, 0, 1, 1], [1, 3, 0, 2, 1], [1, 4, 0, 3, 1]]}
physics: {engine: articulated}
contact: {on: all}
controller: {Kp: 30, Kd: 0.3}
cpg: {type: phase_oscillator, frequency: 0.5, amplitude: 0.5, phase_lag: 1.2}
duration: 12
"""
FAST = ["physics.engine=articulated"]
# name, scenario, settings, settings that must be among the answers (empty: no setting helps)
CASES = [
    ("current", "caterpillar", FAST + ["physics.accuracy=0.0009", "actuator.i_max=0.408"], ["i_max"]),
    ("voltage", "hexapod", FAST + ["cpg.frequency=1.2", "cpg.amplitude=0.6"], ["frequency"]),
    ("bullet", "caterpillar", ["duration=16", "actuator.u_max=3.5"], ["u_max"]),
    ("dtto", "library/dtto-caterpillar", [], ["amplitude"]),
    ("stops", "library/ckbot-worm", ["cpg.amplitude=1.6"], ["amplitude"]),
    ("tracking", "caterpillar", FAST + ["controller.Kp=14"], ["Kp"]),
    ("heat", "caterpillar", FAST + ["actuator.i_continuous=0.25"], ["i_continuous"]),
    ("gears", "caterpillar", FAST + ["actuator.gear_torque_peak=0.9"], ["gear_torque_peak"]),
    ("servo", "library/yamor-worm", ["duration=10", "actuator.stall_torque=0.4"], ["stall_torque"]),
    ("polybot", "library/polybot-worm", ["cpg.frequency=3"], ["frequency"]),
    ("docks", "elbows.yaml", [], ["docks"]),
    ("elbows", "elbows.yaml", ["actuator.stall_torque=1"], ["amplitude"]),
    ("upside down", "hexapod", FAST + ["duration=8", "robot.orientation=[0.9,0,0]"], []),
    ("overlap", "caterpillar", FAST + ["duration=8", "cpg.offset=1.35"], []),
    ("few contacts", "library/ckbot-worm", ["duration=8", "contact.on=feet"], []),
]


def call(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True)


class Case:
    def __init__(self, program, scenarios, folder, name, scenario, sets):
        self.program, self.name, self.sets = program, name, sets
        self.file = folder / scenario if scenario.endswith(".yaml") else scenarios / (scenario + ".yaml")
        self.folder = folder / name.replace(" ", "-")
        self.count = 0

    def options(self, sets):
        return [part for s in sets for part in ("--set", s)]

    def verdict(self, sets):
        self.count += 1
        out = self.folder / f"run{self.count}"
        done = call(self.program, "run", self.file, *self.options(self.sets + sets), "--out", out, "--no-report", "--quiet")
        if done.returncode != 0:
            return "failed: " + done.stderr.strip().splitlines()[-1]
        return json.loads((out / "verdict.json").read_text())["verdict"]

    def remedy(self, jobs):
        out = self.folder / f"remedy{jobs}"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = call(self.program, "remedy", self.file, *self.options(self.sets), "--out", out, "--no-report", "--quiet", "-j", jobs)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not (out / "remedy.json").exists():
            raise SystemExit(f"{self.name}: no remedy: {done.stderr}")
        text = (out / "remedy.json").read_bytes()
        return text, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def scaled(text, share):
    """The text with every number multiplied; names in quotes stay."""
    parts = re.split(r'("[^"]*")', text)
    number = r"-?\d+\.?\d*(e-?\d+)?"
    return "".join(p if p.startswith('"') else re.sub(number, lambda m: f"{float(m[0]) * share:.10g}", p) for p in parts)


def less(answer):
    """Settings with nine tenths of the change of an answer."""
    share = (1 + 0.9 * (answer["factor"] - 1)) / answer["factor"]
    sets = []
    for key, value in (setting.split("=", 1) for setting in answer["set"]):
        if key != "duration":
            sets.append(f"{key}={scaled(value, share)}")
    if answer["setting"] == "frequency" and answer["factor"] < 1:
        sets += [s for s in answer["set"] if s.startswith("duration=")]
    return sets


def check(case, wanted):
    """Row of the table, and the problems of a case."""
    one, cpu = case.remedy(1)
    two, _ = case.remedy(2)
    found = json.loads(one)
    problems = [] if one == two else ["other bytes with two threads"]
    answers = [a for a in found["answers"] if a.get("confirmed")]
    names = [a["setting"] for a in answers]
    for answer in answers:
        with_it, with_less = case.verdict(answer["set"]), case.verdict(less(answer))
        if with_it != "feasible":
            problems.append(f"{answer['set']}: {with_it}")
        if with_less == "feasible":
            problems.append(f"nine tenths of {answer['setting']}: {with_less}")
    if found["ratings_suffice"]:
        for rating in found["ratings"]:
            if rating["check"].startswith("dock_"):
                names.append("docks")
                problems += check_docks(case, rating)
                continue
            names.append(rating["setting"])
            now, need = rating["now"], rating["rating"]
            for value, expected in ((need, True), (now + 0.9 * (need - now), False)):
                verdict = case.verdict([f"actuator.{rating['setting']}={value:.10g}"])
                if (verdict == "feasible") != expected:
                    problems.append(f"{rating['setting']}={value:.5g}: {verdict}")
    problems += [f"no answer by {name}" for name in wanted if name not in names]
    if not wanted and names:
        problems.append("answers where none is expected: " + ", ".join(names))
    return found, cpu, problems


def check_docks(case, rating):
    module = case.file.parent / "elbow.yaml"
    text = module.read_text()
    problems = []
    now, need = rating["now"], rating["rating"]
    for value, expected in ((need, True), (now + 0.9 * (need - now), False)):
        module.write_text(text.replace("bending: 0.8", f"bending: {value:.10g}"))
        verdict = case.verdict([])
        if (verdict == "feasible") != expected:
            problems.append(f"docks of {value:.5g}: {verdict}")
    module.write_text(text)
    return problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    scenarios = pathlib.Path(__file__).resolve().parents[2] / "scenarios"
    failed = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "elbow.yaml").write_text(OWN_MODULE)
        (folder / "elbows.yaml").write_text(OWN)
        for name, scenario, sets, wanted in CASES:
            if arguments.only and name not in arguments.only.split(","):
                continue
            case = Case(arguments.program.resolve(), scenarios, folder, name, scenario, sets)
            case.folder.mkdir()
            found, cpu, problems = check(case, wanted)
            failed += bool(problems)
            print(f"{name}: {found['verdict']}; {found['runs']} runs, {cpu:.0f} s of CPU; {'FAILED' if problems else 'ok'}")
            for text in found["text"] + problems:
                print("   ", text)
            sys.stdout.flush()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
