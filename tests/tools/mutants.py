#!/usr/bin/env python3
"""Whether the tests of the verdict notice wrong limits: limits times 1.3, comparisons turned, spans exchanged, guards removed.

usage: tests/tools/mutants.py [BUILD] [--list] [--only TEXT] [--quick] [--jobs N]

BUILD is a finished build of preset release (default build/release), whose libraries and flags are taken. All mutants are compiled
once, into copies of the sources in build/mutants, each behind a number that is chosen when the tests run: a mutant costs a fork and
the tests until the first red one, and no compiler. The exit code is 1 where one survives that is not in EQUIVALENT below.
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

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = ROOT / "build/mutants"
VERDICT = [f"report/verdict/{name}.cpp" for name in (
    "check_kinds", "checks_body", "checks_gait", "checks_motor", "checks_trust", "evidence", "load_checks", "trust", "verdict",
    "warnings")]
ANALYSIS = [f"report/analysis/{name}.cpp" for name in ("collisions", "fall", "motion", "posture", "upright")]
HEADERS = ["report/verdict/evidence.h", "report/analysis/posture.h", "report/analysis/gait_period.h"]
GUARDS = "studies/study/guards.cpp"
DEFAULTS = "core/scenario/scenario.h"
# Where scenarios are made or their limits printed, and all that is compiled with the constants of HEADERS.
WITH_DEFAULTS = ["core/scenario/read_scenario.cpp", "report/analysis/gait_period.cpp"]
# Tests of tables and of recordings changed by hand come first; what survives them meets those that simulate.
QUICK = ["report/verdict/check_table", "report/verdict/check_cases", "report/verdict/check_evidence", "report/verdict/load_checks",
         "report/verdict/body_checks", "report/verdict/verdict_motor", "studies/study/guards", "report/analysis/posture"]
SLOW = ["report/verdict/verdict", "report/verdict/warnings", "report/verdict/trust", "report/verdict/earned",
        "report/analysis/motion"]
QUICK_FILTER = "Check*:LoadChecks*:Fall*:Upright*:InGround*:Guards*:Posture*-Posture.Shipped*"
# What takes minutes, and is of no single check: whole programs, all shipped scenarios.
SLOW_FILTER = ("Verdict*:SetupWarnings*:RunWarnings*:Doubts*:Earned*:Motion.*:AnyRows*-*Shipped*:Verdict.IsAFile*:"
               "Motion.OfAnOlderFolder*")
# (part of a mutant's name, the reason why no test can see it)
EQUIVALENT = []

SUPPORT = r"""#pragma once
#include <cstdlib>
namespace gaitlab::mutants {
inline int& current() {
  static int now = std::getenv("GAITLAB_MUTANT") != nullptr ? std::atoi(std::getenv("GAITLAB_MUTANT")) : 0;
  return now;
}
inline bool on(int id) { return current() == id; }
inline double scaled(int id, double value) { return on(id) ? 1.3 * value : value; }
enum class Is { less, more, at_most, at_least };
/// a < Turn < b, for each of the four comparisons.
struct Turn {
  int id;
  Is is;
};
template <class A>
struct Half {
  A a;
  Turn turn;
};
template <class A>
Half<A> operator<(const A& a, const Turn& turn) { return {a, turn}; }
template <class A, class B>
bool operator<(const Half<A>& left, const B& b) {
  const bool turned = on(left.turn.id);
  switch (left.turn.is) {
    case Is::less: return turned ? left.a > b : left.a < b;
    case Is::more: return turned ? left.a < b : left.a > b;
    case Is::at_most: return turned ? left.a >= b : left.a <= b;
    default: return turned ? left.a <= b : left.a >= b;
  }
}
}  // namespace gaitlab::mutants
"""

MAIN = r"""#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdio>
#include "mutants.h"
namespace {
/// Tells the first test that is red; that of a mutant ends its process.
struct First : testing::EmptyTestEventListener {
  const char* mutant = "";
  bool told = false;
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed() || told) return;
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    std::fprintf(stderr, "%s red %s.%s\n", mutant, test->test_suite_name(), test->name());
    told = true;
    if (*mutant != 0) _exit(1);
  }
};
}
// Without numbers: the tests, once. With numbers: each in a process of its own, behind a run that is green and has made the walks.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  auto* first = new First;
  testing::UnitTest::GetInstance()->listeners().Append(first);
  if (RUN_ALL_TESTS() != 0) return 1;
  for (int i = 1; i < argc; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      gaitlab::mutants::current() = std::atoi(argv[i]);
      first->mutant = argv[i];
      const rlimit most{120, 120};  // s of CPU: a loop that does not end
      setrlimit(RLIMIT_CPU, &most);
      if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(2);
      _exit(RUN_ALL_TESTS());
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) std::fprintf(stderr, "%s red signal %d\n", argv[i], WTERMSIG(status));
    if (status == 0) std::fprintf(stderr, "%s green\n", argv[i]);
  }
  return 0;
}
"""


class Mutants:
    """Every mutant has a number and a name: its place and what it does. Each file has a thousand numbers, so that a change of one
    does not compile the others."""

    def __init__(self):
        self.names = {}
        self.fresh = set()  # those that scenarios see which were made before
        self.files = []

    def next(self, path):
        if path not in self.files:
            self.files.append(path)
        first = 1000 * (self.files.index(path) + 1)
        return first + sum(first <= number < first + 1000 for number in self.names)

    def add(self, path, line, what, fresh=False):
        number = self.next(path)
        self.names[number] = f"{path}:{line}: {what}"
        if fresh:
            self.fresh.add(number)
        return number


def code_of(line):
    """The line without its comment and with blanks for strings: what rules look at has the places of the line."""
    line = re.sub(r'"(?:\\.|[^"\\])*"', lambda m: "\0" * len(m.group()), line)
    return re.split(r"//", line)[0]


def sub(line, pattern, replace):
    """Replaces what matches outside of strings and comments."""
    done, at = "", 0
    for match in re.finditer(pattern, code_of(line)):
        new = replace(match)
        if new is None:
            continue
        done += line[at:match.start()] + new
        at = match.end()
    return done + line[at:]


NOT_A_LIMIT = re.compile(r"numeric_limits|^constexpr const char|k(Never|NoTime|None|NoFigure|Unknown)\b")
# Statements that make a text; for loops, which would not end.
TEXT = re.compile(r"^\s*(made\.text|made\.remedy|made\.source|const std::string|const char|return fmt|std::string text|text|for \()")
OPERATORS = {"<": "less", ">": "more", "<=": "at_most", ">=": "at_least"}
LIMIT_USE = r"(?:\w+\.limits\(\)|\b(?:s|scenario|run\.scenario|scenario_)\.limits|\blimits_)\.(\w+)\b"


def constants(mutants, path, number, line, out):
    """`constexpr double kA = 1, kB = 2;`, in a namespace as functions, elsewhere as values."""
    match = re.match(r"(\s*)(inline )?constexpr double (.*?);(.*)$", line)
    if not match or NOT_A_LIMIT.search(line):
        return False
    indent, inline, body, rest = match.groups()
    for name, value in re.findall(r"(k\w+) = ((?:[^,(]|\([^)]*\))+)", body):
        ident = mutants.add(path, number, f"{name} times 1.3")
        if indent:
            out.append(f"{indent}const double {name} = mutants::scaled({ident}, {value});")
        else:
            out.append(f"inline double mutated_{name}() {{ return mutants::scaled({ident}, {value}); }}")
            out.append(f"#define {name} mutated_{name}()")
    return True


def mutate_checks(mutants, path, text):
    out = []
    statement = ""  # the start of the statement that the line is of
    for number, line in enumerate(text.split("\n"), 1):
        code = code_of(line)
        if not statement:
            statement = code
        if constants(mutants, path, number, line, out):
            statement = ""
            continue
        made_text = TEXT.match(statement) is not None or "made.text +=" in code
        if path.endswith("check_kinds.cpp"):
            out.append(line)
            statement = ""
            continue
        if "torque_remedy" not in code and "threshold(" not in code and not made_text:
            line = sub(line, LIMIT_USE, lambda m: f"mutants::scaled({mutants.add(path, number, m.group() + ' times 1.3')}, {m.group()})")
        line = sub(line, r"(?<=, )&Limits::(\w+), run\)(?=;)", lambda m: m.group() +
                   f", (made.limit = mutants::scaled({mutants.add(path, number, m.group(1) + ' times 1.3')}, made.limit))")
        line = sub(line, r"made\.limit \*= 2\b", lambda m: f"made.limit *= mutants::scaled({mutants.add(path, number, 'twice times 1.3')}, 2)")
        line = sub(line, r"(?<=, )1(?=, \[&\])", lambda m: f"mutants::scaled({mutants.add(path, number, 'limit 1 times 1.3')}, 1)")
        line = sub(line, r"CheckSpan::whole_run : CheckSpan::window", lambda m:
                   f"(mutants::on({mutants.add(path, number, 'span exchanged')}) ? CheckSpan::window : CheckSpan::whole_run) : CheckSpan::window")
        line = sub(line, r"run\.summary\.judged\.(whole|joints)\[", lambda m:
                   f"(mutants::on({mutants.add(path, number, m.group(1) + ' exchanged')}) ? run.summary.judged."
                   f"{'joints' if m.group(1) == 'whole' else 'whole'} : run.summary.judged.{m.group(1)})[")
        if not made_text:
            def turn(m):
                ident = mutants.add(path, number, f"{m.group(1)} turned in `{code[max(0, m.start() - 24):m.end() + 24].strip()}`".replace("\0", "'"))
                return f" < mutants::Turn{{{ident}, mutants::Is::{OPERATORS[m.group(1)]}}} < "
            line = sub(line, r"(?<=[\w)\]]) (<|>|<=|>=) (?=[\w(!*\-])", turn)
        out.append(line)
        if re.search(r"[;{}]\s*$", code):
            statement = ""
    return "\n".join(out)


def mutate_kinds(mutants, path, text):
    """The span of every row: a copy of the table, made when it is asked for."""
    rows = []
    for number, line in enumerate(text.split("\n"), 1):
        start = re.match(r'\s+\{"(\w+)", Group::', line)
        if start:
            rows.append((number, start.group(1)))
    first = mutants.next(path)
    for number, check in rows:
        mutants.add(path, number, f"span of {check} exchanged")
    return text.replace("std::span<const CheckKind> check_kinds() { return kChecks; }", f"""
std::span<const CheckKind> check_kinds() {{
  static std::vector<CheckKind> all;
  all.assign(std::begin(kChecks), std::end(kChecks));
  for (std::size_t k = 0; k < all.size(); ++k) {{
    if (mutants::on({first} + static_cast<int>(k))) all[k].span = all[k].span == kWindow ? kWhole : kWindow;
  }}
  return all;
}}""")


def mutate_guards(mutants, path, text):
    def at(old):
        if text.count(old) != 1:
            sys.exit(f"{path}: expected once: {old}")
        return text[:text.index(old)].count("\n") + 1

    edits = [
        ("return std::isnan(margin) ? 0 : std::max(0.0, least - margin);", "no guard has a limit", "if (mutants::on({})) return 0; "),
        ("if (check.can_fail || (of_energy && check.id == \"created\"))", "none of the verdict's", "if (!mutants::on({})) "),
        ("if (check.can_fail && other) add(", "none is replaced", "if (!mutants::on({})) "),
        ("add(check.id, margin_column(*given)", "none that the study gives", "if (!mutants::on({})) "),
    ]
    for old, what, before in edits:
        text = text.replace(old, before.format(mutants.add(path, at(old), "guards: " + what)) + old)
    old = "given->asks == Guard::Asks::margin ? given->number : 0"
    text = text.replace(old, f"mutants::on({mutants.add(path, at(old), 'guards: the number of a margin')}) ? 0 : {old}")
    old = "guard.number = read.value;"
    text = text.replace(old, f"guard.number = mutants::on({mutants.add(path, at(old), 'guards: a number that is read')}) ? 0 : read.value;")
    old = 'guard.check + (guard.asks == Guard::Asks::limit ?'
    text = text.replace(old, f"guard.check + (!mutants::on({mutants.add(path, at(old), 'guards: the column of a limit')}) && guard.asks == Guard::Asks::limit ?")
    first = mutants.next(path)
    rows = re.findall(r'OldGuard\{"([\w.]+)"', text)
    for name in rows:
        mutants.add(path, at(f'OldGuard{{"{name}"'), f"guards: {name} means nothing")
    old = "const auto found = std::ranges::find_if(kOldGuards"
    return text.replace(old, "for (std::size_t k = 0; k < kOldGuards.size(); ++k)\n    "
                        f"if (name == kOldGuards[k].name && mutants::on({first} + static_cast<int>(k))) return nullptr;\n  " + old)


def mutate_defaults(mutants, path, text):
    begin = text.index("struct Limits {")
    end = text.index("};", begin)

    def default(m):
        if not begin < m.start() < end or float(m.group(2)) == 0:
            return m.group()
        line = text[:m.start()].count("\n") + 2
        number = mutants.add(path, line, f"default of {m.group(1)} times 1.3", True)
        return f"\n  double {m.group(1)} = mutants::scaled({number}, {m.group(2)});"

    return re.sub(r"\n  double (\w+) = ([\d.e-]+);", default, text)


def generate():
    mutants = Mutants()
    made = {}
    for path in HEADERS + VERDICT + ANALYSIS:
        text = mutate_checks(mutants, path, (ROOT / path).read_text())
        made[path] = mutate_kinds(mutants, path, text) if path.endswith("check_kinds.cpp") else text
    made[GUARDS] = mutate_guards(mutants, GUARDS, (ROOT / GUARDS).read_text())
    made[DEFAULTS] = mutate_defaults(mutants, DEFAULTS, (ROOT / DEFAULTS).read_text())
    return mutants, made


def write(path, text):
    """Leaves a file alone that has that text already, for the sake of ccache's and our own comparison of times."""
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
    """The libraries of program_tests."""
    ninja = (build / "build.ninja").read_text()
    found = re.search(r"^build bin/program_tests .*?^  LINK_LIBRARIES = (.*?)$", ninja.replace("$\n", ""), re.M | re.S)
    return [word for word in shlex.split(found.group(1)) if not word.startswith("bench/")]  # of MuJoCo's tests


def compile_all(build, jobs, names):
    mutants, made = generate()
    shadow = OUT / "sources"
    for path, text in made.items():
        write(shadow / path, text)
    write(OUT / "mutants.h", SUPPORT)
    write(OUT / "main.cpp", MAIN)
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
    # The first definition counts: the mutants', before the libraries'.
    subprocess.run(["g++", "-fuse-ld=lld", "-Wl,--allow-multiple-definition", "-o", str(program), *(str(t) for _, t, _ in work),
                    *link_line(build)], cwd=build, check=True)
    return mutants, program


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", nargs="?", default="build/release")
    parser.add_argument("--list", action="store_true", help="print the mutants, and run none")
    parser.add_argument("--only", default="", help="mutants with this in their names")
    parser.add_argument("--quick", action="store_true", help="without the tests that simulate")
    parser.add_argument("--jobs", type=int, default=2, help="compilers, and processes of tests, at a time")
    given = parser.parse_args()
    if given.list:
        print("\n".join(generate()[0].names.values()))
        return 0
    os.chdir(ROOT)
    mutants, program = compile_all(pathlib.Path(given.build).resolve(), given.jobs, QUICK if given.quick else QUICK + SLOW)
    chosen = [k for k, name in mutants.names.items() if given.only in name]
    told = {}

    def run(numbers, tests, environment):
        """Of tests that are red without a mutant the first; else empty."""
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
        fresh = [k for k in survivors if k in mutants.fresh]  # each from the start: scenarios keep their limits

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
