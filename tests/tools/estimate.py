#!/usr/bin/env python3
"""The factor of the torque error's estimate (docs/equations.md, 7): fitted on one half of drawn scenarios, tested on the other.

    tests/tools/estimate.py PROGRAM [--seed 1] [--draws 60] [--jobs 2] [--keep FOLDER] [--out TABLE.csv] [--ratio 3]
        [--row 0.005]

Each draw is a robot of the library or a random tree with a gait, gains, limits, ground, gravity and control period of its own
(random.Random(f"{seed}/{number}")), run at the default accuracy for 1 to 3 s. Its truth: torque at rows, RMS of the difference
to integrator `extrapolated` at 20 us over the joint's peak, worst joint; there is none if that reference differs from the one
at 50 us by more than a third of the truth or 2 %, or if a run ends early. Its difference: the same to a run at --ratio times the
accuracy, which is 0.5 or 3 of the rollouts of core/simulation/step_error.h. error = c difference, with the c that brings most
draws with an even number within 0.5 to 3 times the truth; the shares are also those of draws with an odd number. The table also
shows the program's own estimate. FOLDER keeps scenarios and traces, so that a draw is run once; two processes need two folders.

The torque of a joint that comes to rest under friction jumps. One row that meets such a jump can be nearly all of the RMS, and
truth and estimate by rows of 5 ms are then samples of a few events. Rows at --row 0.0005 sample the truth ten times as often;
they do not change the motion, and the program's own estimate stays at 5 ms. Needs numpy (Debian: python3-numpy).
"""
import argparse, concurrent.futures, csv, hashlib, json, math, pathlib, random, re, subprocess, sys, tempfile

import numpy

LIBRARY = ["atron-drive", "ckbot-worm", "dtto-caterpillar", "linkbot-drive", "mobot-inchworm", "molecubes-arm", "polybot-worm",
           "revolve-spider", "rofi-snake", "y1-pp", "y1-rolling", "y1-sidewinding", "y1-snake", "yamor-worm"]
WALKS = ["hexapod", "octopod", "caterpillar", "rubble"]
LEAST_PEAK = 0.02  # least peak, as a share of the largest of all joints, as in report/verdict/trust.cpp


def unit(draw):
    while True:
        v = [draw.gauss(0, 1) for _ in range(3)]
        size = math.sqrt(sum(x * x for x in v))
        if size > 0.1:
            return [x / size for x in v]


def inertia(draw, mass):
    """Inertia of a box with random edges about its own axes."""
    a, b, c = (draw.uniform(0.03, 0.12) for _ in range(3))
    return [mass / 12 * (b * b + c * c), mass / 12 * (a * a + c * c), mass / 12 * (a * a + b * b), 0, 0, 0]


def tree(draw):
    """Module type: a random tree of bodies, each with a foot and a sphere."""
    bodies, hinges, contacts = {}, [], []
    for i in range(draw.randint(3, 6)):
        name = f"b{i}"
        mass = draw.uniform(0.1, 0.35)
        place = lambda size: [draw.uniform(-size, size) for _ in range(3)]
        bodies[name] = {"mass": mass, "com": place(0.04), "inertia": inertia(draw, mass)}
        if i > 0:
            hinge = {"name": f"h{i}", "parent": f"b{draw.randrange(i)}", "child": name, "origin": place(0.1),
                     "rpy": place(1.5), "axis": unit(draw), "range": [-draw.uniform(1.5, 2.4), draw.uniform(1.1, 2.4)]}
            if i > 2 and draw.random() < 0.15:
                hinge.update({"drive": "none", "stiffness": draw.uniform(0.5, 3), "damping": draw.uniform(0.002, 0.02)})
            hinges.append(hinge)
        contacts.append({"body": name, "point": place(0.1)})
        contacts.append({"body": name, "sphere": place(0.08), "radius": draw.uniform(0.02, 0.05)})
    module = {"name": "odd", "bodies": bodies, "hinges": hinges, "faces": [], "contacts": {"feet": contacts, "all": contacts}}
    return {"robot": {"modules": {0: "odd"}, "types": {"odd": module}, "docks": []}, "contact": {"on": "all"}}


def robot(draw, scenarios, number):
    """Robot, actuator and ground of a scenario of the library without its gait, or a random tree."""
    kind = number % 3
    if kind == 0:
        return tree(draw), "tree"
    name = draw.choice(LIBRARY) if kind == 1 else draw.choice(WALKS)
    return None, str(scenarios / ("library" if kind == 1 else ".") / f"{name}.yaml")


def heights(draw):
    top = draw.choice([0.002, 0.005, 0.01])
    return {"type": "heightfield", "friction": draw.uniform(0.2, 1.2),
            "heightfield": {"values": [[draw.uniform(0, top) for _ in range(41)] for _ in range(41)], "spacing": 0.05,
                            "origin": [-1.0, -1.0, 0.0]}}


def boxes(draw):
    each = [{"center": [draw.uniform(-0.5, 0.6), draw.uniform(-0.4, 0.4), 0.0],
             "size": [draw.uniform(0.08, 0.4), draw.uniform(0.08, 0.5), draw.uniform(0.01, 0.06)],
             "rpy": [draw.gauss(0, 0.04), draw.gauss(0, 0.04), draw.uniform(-0.6, 0.6)]} for _ in range(3)]
    return {"type": "boxes", "friction": draw.uniform(0.2, 1.0), "boxes": each}


def drawn(seed, number, scenarios, row_time):
    """Random scenario as (text or path of the scenario file, overrides)."""
    draw = random.Random(f"{seed}/{number}")
    made, base = robot(draw, scenarios, number)
    sets = {"physics.engine": "articulated", "physics.integrator": "adaptive", "physics.step": "auto",
            "duration": draw.choice([1.0, 1.5, 2.0, 2.5, 3.0]), "trace.period": row_time, "trace.columns": ["joint.*.torque"]}
    if made is not None:
        made.update({"gaitlab": 1, "name": "odd", "cpg": {"type": "sine"}})
        sets["cpg.phase_lag"] = draw.uniform(-2, 2)
    if made is not None or draw.random() < 0.7:
        sets["cpg.frequency"] = round(math.exp(draw.uniform(math.log(0.3), math.log(2.6))), 4)
        sets["cpg.amplitude"] = round(draw.uniform(0.2, 0.9), 4)
    if draw.random() < 0.35:
        sets["actuator.type"] = "dc_motor"
        sets["actuator.i_max"] = round(math.exp(draw.uniform(math.log(0.12), math.log(0.6))), 4)
        if draw.random() < 0.3:
            sets["actuator.efficiency_model"] = "directional"
    if draw.random() < 0.3:
        sets["controller.period"] = draw.choice([0.005, 0.01, 0.02, 0.03])
    if draw.random() < 0.3:
        sets["controller.Kp"] = round(draw.uniform(20, 150), 2)
    if draw.random() < 0.3:
        sets["contact.stiffness"] = draw.choice([3e3, 1e5, 3e5])
    if draw.random() < 0.25:
        tilt = draw.uniform(0.02, 0.12)
        sets["physics.gravity"] = [-9.81 * math.sin(tilt), 0, -9.81 * math.cos(tilt)]
    ground = draw.random()
    if not base.endswith("rubble.yaml"):
        if ground < 0.15:
            sets["ground"] = heights(draw)
        elif ground < 0.3:
            sets["ground"] = boxes(draw)
        elif ground < 0.45:
            sets["ground.friction"] = draw.choice([0.05, 0.2, 1.5])
    return made, base, sets


def set_text(key, value):
    return f"{key}={json.dumps(value)}"


def without_accuracy(file):
    """Text of a scenario without its accuracy, which integrator `extrapolated` does not accept."""
    text = re.sub(r", *accuracy: *[^,}]*", "", file.read_text())
    return "".join(line for line in text.splitlines(keepends=True) if not line.strip().startswith("accuracy:"))


class Runs:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def __call__(self, base, sets):
        """Tuple (torques at rows, summary), or the reason for a failure as text."""
        words = [set_text(*one) for one in sets.items() if one[1] is not None]
        name = hashlib.sha256(json.dumps([str(self.program), base, words]).encode()).hexdigest()[:16]
        kept = self.folder / f"{name}.npz"
        if kept.exists():
            with numpy.load(kept, allow_pickle=False) as file:
                return file["torque"], json.loads(str(file["summary"]))
        out = self.folder / name
        command = [self.program, "run", base, "--out", out, "--no-report", "--quiet", "--format", "csv"]
        for word in words:
            command += ["--set", word]
        done = subprocess.run(command, capture_output=True, text=True, timeout=900)
        try:
            torque = numpy.loadtxt(out / "trace.csv", delimiter=",", skiprows=1, ndmin=2)[:, 1:]
            full = json.loads((out / "summary.json").read_text())
        except (OSError, ValueError):
            return (done.stderr.strip().splitlines() or ["nothing"])[0]
        summary = {key: full.get(key) for key in ("outcome", "solves", "coarse_time", "torque_error", "predictable", "wall_time")}
        subprocess.run(["rm", "-rf", out])
        numpy.savez(kept, torque=torque, summary=json.dumps(summary))
        return torque, summary


def apart(a, b):
    """RMS of the difference over all rows, divided by the joint's peak in a, for the worst joint; and the number of this joint."""
    if a.shape != b.shape:
        return math.inf, 0
    peak = numpy.abs(a).max(axis=0)
    peak = numpy.maximum(peak, LEAST_PEAK * peak.max())
    share = numpy.sqrt(((a - b) ** 2).mean(axis=0)) / numpy.where(peak > 0, peak, 1)
    return float(share.max()), int(share.argmax())


def measure(program, reference, scenarios, folder, seed, number, ratio, row_time):
    made, base, sets = drawn(seed, number, scenarios, row_time)
    text = json.dumps(made) if made is not None else without_accuracy(pathlib.Path(base))
    file = folder / (f"odd-{seed}-{number}.yaml" if made is not None else pathlib.Path(base).name)
    file.write_text(text)
    base = str(file)
    row = {"number": number, "robot": pathlib.Path(base).stem, "sure": "", "truth": "", "apart": "", "said": "", "why": ""}
    accuracy = sets.get("physics.accuracy", 0.01)
    run, fine = Runs(program, folder), Runs(reference, folder)
    found = {"run": run(base, {**sets, "physics.accuracy": accuracy}),
             "twin": run(base, {**sets, "physics.accuracy": accuracy * ratio})}
    exact = {**sets, "physics.integrator": "extrapolated"}
    for step in (5e-5, 2e-5):
        found[step] = fine(base, {**exact, "physics.step": step})
    for one in found.values():
        if isinstance(one, str):
            return {**row, "why": one[:80]}
        if one[1]["outcome"] != "done":
            return {**row, "why": "ends early"}
    torque = {key: one[0] for key, one in found.items()}
    truth, joint = apart(torque[2e-5], torque["run"])
    doubt, _ = apart(torque[2e-5], torque[5e-5])
    row["truth"], row["apart"] = truth, apart(torque["run"], torque["twin"])[0]
    row["said"] = (found["run"][1]["torque_error"] or {}).get("worst") or ""
    row["solves"], row["twin_solves"] = found["run"][1]["solves"], found["twin"][1]["solves"]
    row["doubt"], row["chaotic"] = doubt, (found["run"][1].get("predictable") or {}).get("chaotic", "")
    row["sure"] = int(doubt < 0.02 and doubt < max(truth / 3, 1e-4))
    return row


def shares(pairs):
    """Statistics of pairs (estimate, truth)."""
    ratios = [estimate / truth for estimate, truth in pairs]
    within = sum(0.5 <= r <= 3 for r in ratios)
    beyond = [(e, t) for e, t in pairs if t > 0.01]
    silent = sum(e <= 0.01 for e, _ in beyond)
    cries = sum(e > 0.01 for e, t in pairs if t <= 0.01)
    return (f"{within} of {len(pairs)} within 0.5 to 3 times the truth ({min(ratios):.2g} to {max(ratios):.2g}); "
            f"{silent} of {len(beyond)} beyond 1 % silent; {cries} told below 1 %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--reference", help="program that makes the references (the same)")
    parser.add_argument("--seed", default="1")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--draws", type=int, default=60)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep")
    parser.add_argument("--out")
    parser.add_argument("--ratio", type=float, default=3)
    parser.add_argument("--row", type=float, default=0.005, help="time between rows, s")
    given = parser.parse_args()
    scenarios = pathlib.Path(__file__).resolve().parents[2] / "scenarios"
    temporary = None if given.keep else tempfile.TemporaryDirectory()
    folder = pathlib.Path(given.keep or temporary.name).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        rows = list(pool.map(lambda n: measure(given.program, given.reference or given.program, scenarios, folder, given.seed, n,
                                               given.ratio, given.row), range(given.first, given.first + given.draws)))
    if given.out:
        with open(given.out, "w", newline="") as file:
            table = csv.DictWriter(file, ["number", "robot", "sure", "doubt", "truth", "apart", "said", "chaotic", "solves",
                                           "twin_solves", "why"])
            table.writeheader()
            table.writerows(rows)
    for row in rows:
        if row["why"] or not row["sure"]:
            print(f"draw {row['number']} ({row['robot']}) is not counted: {row['why'] or 'two references differ'}")
    sure = [row for row in rows if row["sure"] and row["truth"] > 0 and row["apart"] > 0]
    fitted, tested = ([row for row in sure if row["number"] % 2 == half] for half in (0, 1))
    if not fitted or not tested:
        sys.exit("too few draws with a sure reference")
    within = lambda c: sum(0.5 <= c * row["apart"] / row["truth"] <= 3 for row in fitted)
    c = max((1.01**k for k in range(-300, 300)), key=lambda c: (within(c), c))
    print(f"{len(sure)} of {len(rows)} draws have a sure reference; c = {c:.3g}, fitted on {len(fitted)}")
    print("fitted: " + shares([(c * row["apart"], row["truth"]) for row in fitted]))
    print("tested: " + shares([(c * row["apart"], row["truth"]) for row in tested]))
    chaotic = [row for row in rows if row.get("chaotic") and row["chaotic"] > 0.01]
    if chaotic:
        print(f"{len(chaotic)} draws are told to be not predictable; of {sum(not row['sure'] for row in chaotic)} two references differ")
    said = [row for row in sure if row["said"]]
    if said:
        print(f"the program's own, all {len(said)}: " + shares([(row["said"], row["truth"]) for row in said]))


main()
