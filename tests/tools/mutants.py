#!/usr/bin/env python3
"""Check that the tests of the verdict detect wrong limits: limits times 1.3, comparisons turned, spans exchanged, guards
removed.

usage: tests/tools/mutants.py [BUILD] [--list] [--only TEXT] [--quick] [--jobs N]

BUILD is a finished build of preset release (default build/release), whose libraries and flags are used. All mutants are
compiled once, into copies of the sources in build/mutants, each activated by its number when the tests run. A mutant costs a
fork and the tests up to the first failure, but no compilation. The exit code is 1 if a mutant survives that is not in
EQUIVALENT below.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "mutants"))
from changes import generate  # noqa: E402

ROOT = HERE.parents[1]
OUT = ROOT / "build/mutants"
# Sources that create scenarios or print their limits, and sources that use the constants of HEADERS.
WITH_DEFAULTS = ["core/scenario/scenario_reader.cpp"]
# Tests of tables and of changed recordings run first. Surviving mutants are then tested by tests that simulate.
QUICK = ["report/verdict/checks/check_table", "report/verdict/checks/check_cases", "report/verdict/checks/motion_cases", "report/verdict/check_evidence",
         "report/verdict/checks/load_checks", "report/verdict/checks/body_checks", "report/verdict/checks/verdict_motor", "report/verdict/decision",
         "report/verdict/checks/stall", "report/analysis/own_overlap", "studies/study/guards", "report/analysis/posture",
         "report/analysis/gait", "report/analysis/gait_rules", "report/verdict/plausible/possible", "report/verdict/plausible/plausibility",
         "report/analysis/motion", "report/verdict/instability", "report/verdict/trust"]
SLOW = ["report/verdict/verdict", "report/verdict/warnings", "report/verdict/earned",
        "report/verdict/shown", "report/verdict/checks/creep"]
QUICK_FILTER = ("Check*:Decision*:Stall*:OwnOverlap*:LoadChecks*:Fall*:Upright*:InGround*:Guards*:Posture*:LookAhead*:GaitRules*:"
                "Possible*:Plausibility*:ChangedLimits*:Units*:Doubts*:Unstable*:Motion.*-*Shipped*")
# The filter excludes tests that take minutes and do not concern a single check: whole programs, all shipped scenarios.
SLOW_FILTER = "Verdict*:SetupWarnings*:RunWarnings*:Earned*:Shown*:Creep*:AnyRows*-*Shipped*:Verdict.IsAFile*"
# Mutants that no test can detect, as (part of the mutant's name, reason).
EQUIVALENT = [
    ("kEqual times 1.3", "rounding of sums of the same ticks, which differ by a tick or not at all"),
    ("kRounds times 1.3", "rounding of times, of which no tick is within a millionth of a control period"),
    ("kWater times 1.3", "cancels, except for a box about points, where 1000 and 1300 kg/m^3 are usual"),
    ("turned in `if (body.volume > 0) {`", "the union of the shapes is computed again, with the same volume"),
    ("turned in `ble volume = body.volume > 0", "the same"),
    ("turned in `if (body.volume > 0) return;`", "moments of shapes are never impossible"),
    ("kOnGrid times 1.3", "rounding of times, which are whole control periods or half of one away from it"),
]


def write(path, text):
    """Writes a file only if its text changes, because ccache and this script compare modification times."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def flags_of(build, target):
    for entry in json.loads((build / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        if f"/{target}.dir/" in entry["output"] if "output" in entry else f"/{target}.dir/" in " ".join(words):
            return [w for k, w in enumerate(words) if w.startswith(("-D", "-I", "-std", "-ffp")) or w == "-isystem" or words[k - 1] == "-isystem"]
    sys.exit(f"{build}: no commands of {target}")


def link_line(build):
    """Libraries with which program_tests is linked."""
    ninja = (build / "build.ninja").read_text()
    found = re.search(r"^build bin/program_tests .*?^  LINK_LIBRARIES = (.*?)$", ninja.replace("$\n", ""), re.M | re.S)
    return [word for word in shlex.split(found.group(1)) if not word.startswith("bench/")]  # only tests with MuJoCo use bench/


def compile_all(build, jobs, names):
    mutants, made = generate()
    shadow = OUT / "sources"
    for path, text in made.items():
        write(shadow / path, text)
    for name in ("mutants.h", "main.cpp"):
        write(OUT / name, (HERE / "mutants" / name).read_text())
    tests = [ROOT / "tests" / (path + "_test.cpp") for path in names]
    base = ["g++", "-O1", "-w", f"-I{shadow}", f"-I{ROOT}", f"-I{OUT}", "-include", str(OUT / "mutants.h")]
    ours, theirs = flags_of(build, "gaitlab_core") + flags_of(build, "gaitlab_report"), flags_of(build, "program_tests")
    newest = max((OUT / "mutants.h").stat().st_mtime, *(p.stat().st_mtime for p in shadow.rglob("*.h")))
    newest_of_tests = max(newest, *(p.stat().st_mtime for p in (ROOT / "tests").rglob("*.h")))
    work = []
    for source, flags in ([(shadow / p, ours) for p in made if p.endswith(".cpp")] + [(ROOT / p, ours) for p in WITH_DEFAULTS] +
                          [(OUT / "main.cpp", theirs)] + [(t, theirs) for t in tests]):
        name = str(source.relative_to(shadow if shadow in source.parents else ROOT)).replace("/", "_")
        work.append((source, OUT / "objects" / (name + ".o"), flags))
    (OUT / "objects").mkdir(exist_ok=True)

    def one(item):
        source, target, flags = item
        if target.exists() and target.stat().st_mtime > max(newest_of_tests if flags is theirs else newest, source.stat().st_mtime):
            return ""
        print(f"compile {source.name}", flush=True)
        done = subprocess.run([*base, *flags, "-c", str(source), "-o", str(target)], capture_output=True, text=True)
        return f"{source}\n{done.stderr[:4000]}" if done.returncode else ""

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        wrong = [text for text in pool.map(one, work) if text]
    if wrong:
        sys.exit("\n".join(wrong))
    program = OUT / "mutant_tests"
    # The linker uses the first definition, that of the mutants, which precede the libraries.
    subprocess.run(["g++", "-fuse-ld=lld", "-Wl,--allow-multiple-definition", "-o", str(program), *(str(t) for _, t, _ in work),
                    *link_line(build)], cwd=build, check=True)
    return mutants, program


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", nargs="?", default="build/release")
    parser.add_argument("--list", action="store_true", help="print the mutants, and run none")
    parser.add_argument("--only", default="", help="mutants with one of these texts, between commas, in their names")
    parser.add_argument("--quick", action="store_true", help="without the tests that simulate")
    parser.add_argument("--jobs", type=int, default=2, help="compilers, and processes of tests, at a time")
    given = parser.parse_args()
    if given.list:
        print("\n".join(generate()[0].names.values()))
        return 0
    os.chdir(ROOT)
    mutants, program = compile_all(pathlib.Path(given.build).resolve(), given.jobs, QUICK if given.quick else QUICK + SLOW)
    chosen = [k for k, name in mutants.names.items() if any(text in name for text in given.only.split(","))]
    told = {}

    os.environ["GAITLAB_DATA"] = str(ROOT / "scenarios")  # the mutants' program has no data beside it

    def run(numbers, tests, environment):
        """Runs the mutants. Returns the first test that fails without a mutant, or an empty text."""
        command = ["nice", "-n", "3", str(program), "--gtest_brief=1", "--gtest_filter=" + tests, *map(str, numbers)]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=environment) as running:
            for line in running.stderr:
                words = line.split()
                if len(words) > 1 and words[0].isdigit() and words[1] in ("red", "green"):
                    told[int(words[0])] = " ".join(words[1:])
                    print(f"{' '.join(words[1:])}: {mutants.names[int(words[0])]}", flush=True)
                elif words[:1] == ["red"]:
                    return words[-1]
        return "" if running.returncode == 0 else "signal"

    survivors = chosen
    for tests in [QUICK_FILTER] if given.quick else [QUICK_FILTER, SLOW_FILTER]:
        print(f"tests {tests}", flush=True)
        cached = [k for k in survivors if k not in mutants.fresh]
        fresh = [k for k in survivors if k in mutants.fresh]  # need a new process each, because scenarios keep their limits

        def from_the_start(number, tests=tests):
            red = run([], tests, {**os.environ, "GAITLAB_MUTANT": str(number)})
            told[number] = "red " + red if red else "green"
            print(f"{told[number]}: {mutants.names[number]}", flush=True)

        with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
            parts = [cached[k::given.jobs] for k in range(given.jobs)]
            for red in pool.map(lambda part: run(part, tests, os.environ), parts):
                if red:
                    sys.exit(f"red without a mutant: {red}")
            list(pool.map(from_the_start, fresh))
        survivors = [k for k in survivors if told.get(k, "green") == "green"]
    print(f"{len(chosen)} mutants, {len(chosen) - len(survivors)} killed")
    left = 0
    for number in survivors:
        reason = next((why for part, why in EQUIVALENT if part in mutants.names[number]), "")
        left += 0 if reason else 1
        print(f"  survives: {mutants.names[number]}{': ' + reason if reason else ''}")
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
