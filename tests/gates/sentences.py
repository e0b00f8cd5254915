#!/usr/bin/env python3
"""Every sentence of the terminal, of verdict.json and of the page's headline, recomputed from trace.h5 alone.
usage: sentences.py PROGRAM SCENARIOS_FOLDER [--keep FOLDER] [--seed N] [NAME...]     (pages, too: sentences.sh)
Exit code 77 if python3-h5py, python3-numpy or python3-yaml is missing.

For each run: the part, the time and the number of each sentence, the limit, the margin, the status and the word, by code in told/
that shares nothing with the program and is written from docs/reference/verdict.md and docs/numbers.md. A sentence that no
expression of told/sentences.py reads fails. What must have occurred (checks that fail, warn, are kept, are too close) is counted.
KNOWN lists sentences that are wrong at present; an entry that no run shows any more fails, too."""
import argparse
import collections
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # no __pycache__ in the source tree
try:
    import h5py  # noqa: F401
    import numpy as np
    import yaml  # noqa: F401
except ImportError as error:
    print(f"left out: {error} (Debian: python3-h5py, python3-numpy, python3-yaml)")
    sys.exit(77)

from told import draws, page, screen
from told.gears import hear_gears
from told.record import Record
from told.verdict import Judged, compare, hear, hear_evidence, hear_unstable, sentence, tightest

SEED = 20
# Known defects of the program: (runs, sentence, reason why the sentence is wrong).
KNOWN = []
# Statuses of each check that must occur in some run. Otherwise its sentences would not be tested.
MUST = {check: ("pass", "warn", "fail") for check in (
    "voltage", "current", "speed", "stall", "heat", "gear_peak", "gear_continuous", "tracking", "stops", "dock_tension", "dock_shear",
    "dock_bending", "dock_torsion", "upright", "collision")}
MUST |= {check: ("pass", "warn") for check in ("envelope", "setpoints", "start", "slip", "airborne", "field", "periodic",
                                               "torque_error", "creep", "ledger", "created")}
MUST |= {check: ("pass", "fail") for check in ("outcome", "fall", "in_ground")}
MUST |= {"progress": ("pass", "warn", "fail"), "stability": ("pass",), "evidence": ("pass", "not judged"), "supply": ("pass",),
         "step": ("pass",), "coarse": ("pass",), "law": ("pass",)}
CHOSEN = ("dry_friction", "viscous_friction", "load_friction", "rotor_inertia")  # of servo, where nothing is stated
FRICTION_ALONE = ", with the friction chosen; feasible without"
WORDS = ("feasible", "infeasible", "not judged", "failed")
REASONS = ("that a gait needs", "so far: ", "makes energy", "moves no joint", "off by about", "nothing drives the joints",
           "the shortest steps", "there is no gravity", "falls freely")


def run(program, *arguments):
    as_it_is = ["--no-retry"] if arguments[0] == "run" else []
    return subprocess.run([program, *map(str, arguments), *as_it_is], capture_output=True, text=True, check=False, timeout=600)


def known_to(window):
    """Uncertainty of the start of the window, s. The window starts whole periods before the end, and each period is uncertain; that of
    the set points, which are samples, by up to 1e-4."""
    return (window.cycle.doubt() * window.periods * window.cycle.period if window.periods else 1e-4 * (window.end - window.start)) + 1e-9


class Gate:
    def __init__(self, program, scenarios, work):
        self.program, self.scenarios, self.work = program, scenarios, work
        self.wrong, self.said, self.met, self.words, self.lines = [], 0, collections.Counter(), collections.Counter(), set()
        self.frictions = collections.Counter()  # words without chosen friction
        self.browser = page.Browser()
        self.torn, self.pages, self.mutants, self.survivors, self.begins, self.reasons = 0, 0, 0, [], collections.Counter(), []

    def without_friction(self, name, folder, verdict, record):
        """Word of an infeasible run without the friction of its servos that is only chosen: of a further run, all of whose sentences
        are checked, too. None where no friction is chosen."""
        actuator = record.scenario.get("actuator") or {}
        plays = any(hinge.get("play", 0) > 0 for kind in record.robot.types.values() for hinge in kind.get("hinges", []))
        # The resolved scenario contains what is stated. A motor within its play keeps its inertia.
        chosen = [key for key in CHOSEN if key not in actuator and not (plays and key == "rotor_inertia")]
        if verdict["verdict"] != "infeasible" or actuator.get("type") != "servo" or not chosen:
            return None
        out = folder.parent / "without"
        sets = [x for key in chosen for x in ("--set", f"actuator.{key}=0")]
        made = run(self.program, "run", folder.parent / "drawn.yaml", *sets, "--out", out, "--verbose")
        self.judge(f"{name}, without friction", out, made.stdout)
        other = json.loads((out / "verdict.json").read_text())
        bare = Record(out / "trace.h5")
        checks = other["checks"]
        if bare.chaotic():
            word = "not judged"  # its rollouts are not simulated for this word
        else:  # the word of one run, without a spread: an ill-conditioned motion
            if bare.spread is not None:
                checks = [c | {"status": "fail" if c["margin"] < 0 else "pass"} if c["status"] == "too close" else c for c in checks]
            bare.spread = None
            word = Judged(bare, other["window"]["from"], whole=False).word(checks)
        self.frictions[word] += 1
        return word

    def hear(self, rng, name, scenario, settings, fixed=None):
        """Checks one run: a draft, limits that are drawn around its values, the run, and all of its sentences."""
        folder = self.work / re.sub(r"\W+", "-", name)
        folder.mkdir()
        source = self.scenarios / f"{scenario}.yaml"
        for text in scenario if isinstance(scenario, list) else []:
            source = folder / "tree.yaml"
            source.write_text(text)
            if run(self.program, "check", source, "--quiet").returncode == 0:
                break
        sets = [x for s in settings for x in ("--set", s)]
        draft = run(self.program, "run", source, *sets, "--out", folder / "draft", "--no-report", "--quiet")
        if not (folder / "draft" / "trace.h5").exists():
            self.wrong.append((name, f"the draft does not run: {draft.stderr}"))
            return
        file = folder / "drawn.yaml"
        file.write_text(draws.drawn(rng, folder / "draft", re.sub(r"\W+", "-", name), fixed or {}))
        shutil.rmtree(folder / "draft")
        made = run(self.program, "run", file, "--out", folder / "run", "--verbose")
        if not (folder / "run" / "verdict.json").exists():
            self.wrong.append((name, f"{file} does not run: {made.stderr}"))
            return
        (folder / "terminal.txt").write_text(made.stdout)  # for --keep
        self.judge(name, folder / "run", made.stdout)

    def judge(self, name, folder, stdout):
        wrong = []
        verdict = json.loads((folder / "verdict.json").read_text())
        record = Record(folder / "trace.h5")
        judged = Judged(record, verdict["window"]["from"])
        room = known_to(judged.window)
        if not abs(judged.own_start - verdict["window"]["from"]) <= room or verdict["window"]["to"] != record.end:
            wrong.append(f"window {verdict['window']}, recomputed {judged.own_start} to {record.end}")
        if torn := judged.unstable():
            self.said += 1
            self.torn += 1
            wrong += hear_unstable(torn, verdict)
            if verdict.get("unstable", "?") not in " ".join(stdout.split()):
                wrong.append("the terminal lacks the sentence on the unstable controller")
            self.wrong += [(name, text) for text in wrong]
            return
        if "unstable" in verdict:
            wrong.append(f"{verdict['unstable']!r}, recomputed that it is stable")
        known = screen.numbers(judged)
        for check in verdict["checks"]:
            told = judged.checks[check["id"]]
            self.met[check["id"], check["status"]] += 1
            self.said += 1
            wrong += (compare(told, check) if told else []) + hear(told, check, check["text"], "verdict.json")
            if told:
                self.mutate(told, check)
        wrong += hear_evidence(judged, verdict) + hear_gears(record)
        word = judged.word(verdict["checks"])
        self.words[verdict["verdict"]] += 1
        self.reasons.append(verdict["reason"])
        if word != verdict["verdict"]:
            wrong.append(f"the word is {verdict['verdict']}, recomputed {word}")
        if verdict["tightest"] not in tightest(verdict["checks"]):
            wrong.append(f"tightest {verdict['tightest']}, recomputed {tightest(verdict['checks'])}")
        counts = collections.Counter(check["status"] for check in verdict["checks"])
        if {k: v for k, v in verdict["counts"].items() if v} != dict(counts):
            wrong.append(f"counts {verdict['counts']}, recomputed {dict(counts)}")
        if verdict["decided_by"] not in judged.decided_by(verdict["checks"], word):
            wrong.append(f"decided by {verdict['decided_by']}, recomputed {judged.decided_by(verdict['checks'], word)}")
        timed = [c for c in verdict["checks"] if c["status"] == "fail" and c["first"] is not None]
        events = sorted((c["first"], c["id"], c["first_part"] or c["worst"]) for c in timed)
        if sorted((e["time"], e["check"], e["part"]) for e in verdict["events"]) != events or any(
                a["time"] > b["time"] for a, b in zip(verdict["events"], verdict["events"][1:])):
            wrong.append(f"events {verdict['events']}, recomputed {events}")
        first = verdict["first"]
        if (first is None) != ("first" not in known) or first and (
                first["joint"] not in known["first"] or first["time"] != known["first_time"]):
            wrong.append(f"first {first}, recomputed {known.get('first')} at {known.get('first_time')}")
        without = self.without_friction(name, folder, verdict, record)
        if verdict.get("without_chosen_friction") != without:
            wrong.append(f"without_chosen_friction is {verdict.get('without_chosen_friction')}, recomputed {without}")
        end = FRICTION_ALONE if without == "feasible" else ""
        wrong += screen.first_screen(stdout, verdict, judged, known, end)
        why = page.meta(folder / "report.html")["verdict"]["why"]
        if why.endswith(FRICTION_ALONE) != bool(end):
            wrong.append(f"the page says {why!r}, recomputed the end {end!r}")
        lines, seen = screen.verbose(stdout, known)
        wrong += lines
        self.lines |= seen
        # A browser takes much time, so that only pages whose headline differs from earlier pages are rendered.
        first = verdict["decided_by"] or verdict["tightest"]
        self.begins[verdict["verdict"], first] += 1
        some = self.begins[verdict["verdict"], first] == 1
        shown = self.browser.facts((folder / "report.html").resolve()) if some else None
        if shown is not None:
            self.pages += 1
            wrong += page.hear(shown, page.meta(folder / "report.html"), verdict, judged, known)
        self.wrong += [(name, text) for text in wrong]


    def any_rows(self, name):
        """A checked run has the same verdict, checks and lines for trace rows of 1, 5 and 50 ms."""
        folder = self.work / re.sub(r"\W+", "-", name)
        lines = lambda text: [x for x in text.splitlines()[1:] if not re.match(r"  (page|files|judge by)|            \w+\.\w+", x)]
        seen = set()
        for period in ("0.001", "0.005", "0.05"):
            out = folder / f"rows-{period}"
            made = run(self.program, "run", folder / "drawn.yaml", "--set", f"trace.period={period}", "--out", out, "--no-report",
                       "--verbose")
            seen.add(((out / "verdict.json").read_bytes(), *lines(made.stdout)))
        if len(seen) != 1:
            self.wrong.append((name, "verdict or terminal differ with the rows of the trace"))

    def studies(self):
        """Studies have the same margins and sentences with any threads and lanes, and each point has those of `run`."""
        sets = [x for s in ("duration=3.3", "cpg.frequency=1") for x in ("--set", s)]
        source, tables = self.work / "hexapod" / "drawn.yaml", set()  # contains ratings of motors, gears and docks
        for k, options in enumerate((["-j", 1, "--lanes", 1], ["-j", 2, "--lanes", 1], ["-j", 2, "--lanes", 8])):
            made = run(self.program, "sweep", source, *sets, "--grid", "cpg.amplitude=0.25:0.55:3", "--grid", "actuator.i_max=0.4,1.2",
                       "--show", "margin*", *options, "--out", self.work / f"sweep-{k}", "--quiet")
            file = self.work / f"sweep-{k}" / "table.csv"
            if not file.exists():
                self.wrong.append(("sweep", made.stderr))
                return
            tables.add(file.read_text())
        if len(tables) != 1:
            self.wrong.append(("sweep", "the table differs with threads and lanes"))
        for k, row in enumerate(csv.DictReader(tables.pop().splitlines())):
            point = [x for key in ("cpg.amplitude", "actuator.i_max") for x in ("--set", f"{key}={row[key]}")]
            run(self.program, "run", source, *sets, *point, "--out", self.work / f"point-{k}", "--no-report", "--quiet")
            verdict = json.loads((self.work / f"point-{k}" / "verdict.json").read_text())
            why = next((sentence(c) for c in verdict["checks"] if c["id"] == verdict["decided_by"]), "")
            expected = {f"margin.{c['id']}": c["margin"] for c in verdict["checks"] if c["margin"] is not None and c["can_fail"]}
            expected["margin"] = min(c["margin"] for c in verdict["checks"] if c["can_fail"] and c["margin"] is not None)
            wrong = {key: (row[key], value) for key, value in expected.items() if row[key] == "" or float(row[key]) != value}
            if wrong or row["verdict"] != verdict["verdict"] or float(row["feasible"]) != (verdict["verdict"] == "feasible"):
                self.wrong.append(("sweep", f"point {k}: {row['verdict']}, run {verdict['verdict']}; {wrong}"))
            if row["message"] != (verdict["reason"] or why):
                self.wrong.append(("sweep", f"point {k}: message {row['message']!r}, run {verdict['reason'] or why!r}"))

    def mutate(self, told, check):
        """A sentence with a changed number must be detected. Each of its numbers is increased in turn, by a tenth and by two units of
        its last digit."""
        if hear(told, check, check["text"], ""):
            return
        said = check["text"].split("; take physics")[0]  # without the advice, which contains other numbers
        for match in re.finditer(r"(?<![\w.\-/])\d+\.?\d*(?:e[-+]?\d+)?(?![\w/])", said):
            value = float(match[0])
            if 0 < value < 1e-12:
                continue  # rounding error
            last = 10.0 ** -len(match[0].partition(".")[2]) if "e" not in match[0] else 0  # unit of the last digit
            larger = max(value * 1.1, value + 2 * last) + (value == 0)
            other = f"{larger:.3g}" if "." in match[0] or value > 100 else f"{value + 1:.0f}"
            changed = check["text"][:match.start()] + other + check["text"][match.end():]
            self.mutants += 1
            if float(other) != value and not hear(told, check, changed, ""):
                self.survivors.append(f"{check['id']}: {changed}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scenarios", type=pathlib.Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=SEED)
    options = parser.parse_intermixed_args()
    # In CI every fourth run, others at each landing. What must have occurred is counted only where all runs are made.
    quarter = int(os.environ["GAITLAB_QUARTER"]) if "GAITLAB_QUARTER" in os.environ else None
    with tempfile.TemporaryDirectory() as temporary:
        work = options.keep or pathlib.Path(temporary)
        gate = Gate(str(pathlib.Path(options.program).resolve()), options.scenarios.resolve(), work)
        heard = set()
        for k, one in enumerate(draws.plan(options.seed)):
            if one[0] in options.names or not options.names and (quarter is None or k % 4 == quarter):
                gate.hear(draws.random.Random(1000 * options.seed + k), *one)
                heard.add(one[0])
        if not options.names:
            for name in sorted(heard & {"hexapod, fast", "caterpillar, little current", "hexapod, bullet"}):
                gate.any_rows(name)
            if "hexapod" in heard:
                gate.studies()
        gate.browser.close()
    open_, met = [], set()
    for name, text in gate.wrong:
        known = ((not where or name in where.split("|")) and re.search(what, text) for where, what, _ in KNOWN)
        entry = next((k for k, one in enumerate(known) if one), None)
        if entry is None:
            open_.append(text)
            print(f"WRONG {name}: {text}")
        else:
            met.add(entry)
            print(f"known {name}: {text}")
    for text in gate.survivors:
        open_.append(text)
        print(f"WRONG a changed number is not heard: {text}")
    if not options.names and quarter is None and options.seed == SEED:
        for entry in set(range(len(KNOWN))) - met:
            open_.append(entry)
            print(f"WRONG no run shows any more, so it is to be taken out of KNOWN: {KNOWN[entry]}")
        for check, statuses in MUST.items():
            for status in statuses:
                if not gate.met[check, status]:
                    open_.append(check)
                    print(f"WRONG no run in which {check} is {status}")
        if not gate.torn:
            open_.append("unstable")
            print("WRONG no run has an unstable controller")
        for word in WORDS:
            if not gate.words[word]:
                open_.append(word)
                print(f"WRONG no run is {word}")
        for word in ("feasible", "infeasible"):
            if not gate.frictions[word]:
                open_.append(word)
                print(f"WRONG no infeasible run is {word} without chosen friction")
        for words in REASONS:
            if not any(words in reason for reason in gate.reasons):
                open_.append(words)
                print(f"WRONG no run is not judged for {words!r}")
    print(f"{sum(gate.words.values())} runs, {gate.said} sentences, {gate.pages} pages, {gate.mutants} changed numbers: "
          f"{dict(gate.words)}; {len(open_)} wrong")
    print("; ".join(f"{check} {status} {count}" for (check, status), count in sorted(gate.met.items()) if status != "not judged"))
    sys.exit(1 if open_ else 0)


if __name__ == "__main__":
    main()
