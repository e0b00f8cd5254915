"""Generates mutants: copies of the sources in which a number activates each change (mutants.h)."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
CHECKS = sorted(f"report/verdict/checks/{path.name}" for path in (ROOT / "report/verdict/checks").glob("*.cpp"))
VERDICT = CHECKS + [f"report/verdict/{name}.cpp" for name in ("error_bar", "evidence", "trust", "verdict", "warnings")]
ANALYSIS = [f"report/analysis/{name}.cpp" for name in (
    "collisions", "fall", "motion", "own_overlap", "posture", "upright")]
# Period, full size and window of a gait; implausible and impossible numbers; instability.
WORD = ["report/analysis/gait.cpp", "report/verdict/instability.cpp"] + sorted(
    f"report/verdict/plausible/{path.name}" for path in (ROOT / "report/verdict/plausible").glob("*.cpp"))
HEADERS = ["report/verdict/checks/rated.h", "report/verdict/error_bar.h", "report/verdict/evidence.h", "report/verdict/trust.h",
           "report/analysis/posture.h", "report/analysis/gait.h"]
GUARDS = "studies/study/guards.cpp"
DEFAULTS = "core/scenario/scenario.h"


class Mutants:
    """Mutants with their numbers and names. A name is the place and the change. Each file has a range of a thousand numbers, so that a
    change of a file does not require other files to be compiled again."""

    def __init__(self):
        self.names = {}
        self.fresh = set()  # numbers of mutants that affect the creation of scenarios, and thus need a new process
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
    """Line without its comment, and with spaces instead of strings, so that positions are those of the original line."""
    line = re.sub(r'"(?:\\.|[^"\\])*"', lambda m: "\0" * len(m.group()), line)
    return re.split(r"//", line)[0]


def sub(line, pattern, replace):
    """Replaces matches of a pattern outside of strings and comments."""
    done, at = "", 0
    for match in re.finditer(pattern, code_of(line)):
        new = replace(match)
        if new is None:
            continue
        done += line[at:match.start()] + new
        at = match.end()
    return done + line[at:]


NOT_A_LIMIT = re.compile(r"numeric_limits|^constexpr const char|k(Never|NoTime|None|NoFigure|Unknown)\b")
# Lines that are not mutated: statements that create a text, and for loops, which might not end.
TEXT = re.compile(r"^\s*(made\.text|made\.remedy|made\.source|const std::string|const char|return fmt|std::string text|text|for \()")
OPERATORS = {"<": "less", ">": "more", "<=": "at_most", ">=": "at_least"}
LIMIT_USE = r"(?:\w+\.limits\(\)|\b(?:s|scenario|run\.scenario|scenario_)\.limits|\blimits_)\.(\w+)\b(?:\(\))?"


def constants(mutants, path, number, line, out):
    """Mutates constants such as `constexpr double kA = 1, kB = 2;`. They become functions in a namespace, and values elsewhere."""
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
    statement = ""  # start of the statement that contains the line
    for number, line in enumerate(text.split("\n"), 1):
        code = code_of(line)
        if not statement:
            statement = code
        if constants(mutants, path, number, line, out):
            statement = ""
            continue
        made_text = TEXT.match(statement) is not None or "made.text +=" in code
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
    """Mutates the span of every row of the list of checks, in a copy of the list that is created at the call."""
    spans = ""
    for check in re.findall(r'\{"(\w+)", (?:CheckGroup::|"N)', "".join((ROOT / source).read_text() for source in CHECKS)):
        number = mutants.add(path, 1, f"span of {check} exchanged")
        spans += f'    if (mutants::on({number}) && one.id == std::string("{check}")) one.span = exchanged;\n'
    return text.replace("  return kKinds;\n", f"""
  static std::vector<CheckKind> mutated;
  mutated = kKinds;
  for (CheckKind& one : mutated) {{
    const CheckSpan exchanged = one.span == CheckSpan::window ? CheckSpan::whole_run : CheckSpan::window;
{spans}  }}
  return mutated;
""")


def mutate_guards(mutants, path, text):
    def at(old):
        if text.count(old) != 1:
            sys.exit(f"{path}: expected once: {old}")
        return text[:text.index(old)].count("\n") + 1

    edits = [
        ("return std::isnan(margin) ? 0 : std::max(0.0, (reserve ? least : std::min(0.0, least)) - margin);", "no guard has a limit", "if (mutants::on({})) return 0; "),
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
    return text


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
    for path in HEADERS + VERDICT + ANALYSIS + WORD:
        text = mutate_checks(mutants, path, (ROOT / path).read_text())
        made[path] = mutate_kinds(mutants, path, text) if path.endswith("checks/list.cpp") else text
    made[GUARDS] = mutate_guards(mutants, GUARDS, (ROOT / GUARDS).read_text())
    made[DEFAULTS] = mutate_defaults(mutants, DEFAULTS, (ROOT / DEFAULTS).read_text())
    return mutants, made
