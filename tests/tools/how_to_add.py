#!/usr/bin/env python3
"""Executes rows of "How to add" (docs/architecture.md): adds a dummy of each kind, builds the program, and calls each dummy.

usage: tests/tools/how_to_add.py CLONE [--dry-run]

CLONE is a checkout with a finished build/release. Its files are edited and, at the end, restored. The script prints the files
that each addition edits by hand. The exit code is 1 if the row does not name one of them, or a dummy does not work. --dry-run:
nothing is built.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

NEW = None  # stands for a pattern if the text is a new file


def renamed(path, *names):
    """Text of an existing file in which each of the names is replaced by that of the dummy."""
    def make(clone):
        text = (clone / path).read_text()
        for old, new in names:
            if old not in text:
                sys.exit(f"{path}: nothing to rename: {old}")
            text = text.replace(old, new)
        return text
    return make


SUBCOMMAND = """#include <fmt/core.h>

#include "app/shell/commands.h"

namespace gaitlab::app {
namespace {
struct DummyArguments {};
int dummy(const DummyArguments&) { return fmt::print("dummy\\n"), 0; }
}  // namespace
void add_dummy(Commands& commands) {
  add_command<DummyArguments>(commands, "dummy", "Print a word.", dummy, [](CLI::App&, DummyArguments&) {});
}
}  // namespace gaitlab::app
"""
PANEL = """#include "report/figures/paper/panel_kinds.h"
namespace gaitlab::report {
const PanelKind kDummyPanel{"dummy", "A dummy panel.", true, kHeatPanel.fields, kHeatPanel.lacking, kHeatPanel.make};
}  // namespace gaitlab::report
"""
# Beginning of the row, edits (path, pattern that is found once, its replacement), and a call of the program with a text that it prints.
ADDITIONS = [
    ("a CPG, controller or actuator", [
        ("cpg/dummy.h", NEW, renamed("cpg/sine.h", ("Sine", "Dummy"), ("`sine`", "`dummy`"), ("type: sine", "type: dummy"))),
        ("cpg/register.cpp", r'(#include "cpg/)sine(\.h"\n)', r"\1dummy\2\g<0>"),
        ("cpg/register.cpp", r'  add_cpg<Sine>.*\n', r'  add_cpg<Dummy>(registry, "dummy", Dummy::kManual);\n\g<0>')],
     "explain cpg dummy", "type: dummy"),
    ("a type of sensor", [
        ("sensors/dummy.h", NEW, renamed("sensors/load.h", ("LoadSensor", "DummySensor"))),
        ("sensors/dummy.cpp", NEW, renamed("sensors/load.cpp", ("LoadSensor", "DummySensor"), ("sensors/load.h", "sensors/dummy.h"))),
        ("sensors/register.cpp", r'(#include "sensors/)encoder(\.h"\n)', r"\1dummy\2\g<0>"),
        ("sensors/register.cpp", r"  add_sensor<Encoder.*\n", r'  add_sensor<DummySensor>(registry, "dummy", DummySensor::kManual);\n\g<0>'),
        ("tests/core/scenario/sensors_test.cpp", r"known types: encoder", "known types: dummy, encoder")],
     "explain sensor dummy", "Load of modules"),
    ("a check of the verdict", [
        ("report/verdict/checks/dummy.cpp", NEW, renamed("report/verdict/checks/speed.cpp", ("checks::speed()", "checks::dummy()"),
                                                         ('{"speed",', '{"dummy",'))),
        ("report/verdict/checks/list.h", r"speed\(\)", r"\g<0>, dummy()"),
        ("report/verdict/checks/list.h", r"speed, ", r"\g<0> dummy,"),
        ("tests/report/verdict/checks/check_table_test.cpp", r' *of_tick\("speed".*\n', lambda m: m[0] + m[0].replace('"speed"', '"dummy"')),
        ("tests/report/verdict/checks/check_table_test.cpp", r'"envelope", "speed",(?=\n)', r'\g<0> "dummy",'),
        ("tests/report/verdict/checks/check_table_test.cpp", r'"envelope", "speed", "stall"', r'\g<0>, "dummy"')],
     "explain check dummy", "Speed within reach"),
    ("a summary number", [
        ("report/verdict/numbers/run_numbers.cpp", r'\{\.key = "seed"',
         r'{.key = "dummy", .definition = "A dummy number.", .value = [](R r) { return r.scenario.seed; }},\n      \g<0>'),
        ("docs/numbers.md", r"\| `seed` \|", r"| `dummy` |  | A dummy number. |\n\g<0>")],
     "run pendulum --set duration=0.1 --set trace.columns=[t] --quiet --no-report --out run", ""),  # its row in docs/numbers.md is added below
    ("a key of module files", [
        ("core/robot_files/module_keys.h", r"bool lattice = false;", r"\g<0>\n  bool dummy = false;"),
        ("core/robot_files/module_keys.cpp", r' *f\.flag\("lattice", .*\n', r'\g<0>  f.flag("dummy", dummy, "A dummy key.");\n')],
     "explain module", "A dummy key."),
    ("a subcommand", [
        ("app/look/dummy.cpp", NEW, lambda _: SUBCOMMAND),
        ("app/shell/subcommands.h", r"add_man\(Commands&\);", "add_man(Commands&), add_dummy(Commands&);"),
        ("app/shell/subcommands.h", r"add_man\}", "add_man, add_dummy}"),
        ("tests/gates/traps.py", r' *"demo": .*\n', r'\g<0>    "dummy": "dummy",\n'),
        ("docs/commands.md", r"\| `gaitlab demo .*\n", r"\g<0>| `gaitlab dummy` | a word |\n")],
     "dummy", "dummy"),
    ("a type of panel in figures for papers", [
        ("report/figures/paper/dummy_panel.cpp", NEW, lambda _: PANEL),
        ("report/figures/paper/panel_kinds.h", r"kHeatPanel,(?= kFootfallsPanel, kViewsPanel;)", r"\g<0> kDummyPanel,"),
        ("report/figures/paper/panel_kinds.h", r"&kHeatPanel,", r"\g<0> &kDummyPanel,")],
     "explain figure dummy", "A dummy panel."),
]


def names_in(row):
    """Names of files in a row, with alternatives in braces written out."""
    found = set()
    for name in re.findall(r"[\w./{},]+", row):
        braces = re.search(r"\{([\w,]+)\}", name)
        found.update(name.replace(braces[0], one) for one in braces[1].split(",")) if braces else found.add(name)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("clone", type=pathlib.Path)
    parser.add_argument("--dry-run", action="store_true")
    given = parser.parse_args()
    clone = given.clone.resolve()
    rows = dict(re.findall(r"^\| (.+?) \| (.+) \|$", (clone / "docs/architecture.md").read_text(), re.M))
    before, wrong = {}, 0
    try:
        for what, edits, _, _ in ADDITIONS:
            for path, pattern, new in edits:
                file = clone / path
                before.setdefault(path, file.read_text() if file.exists() else None)
                text, number = (new(clone), 1) if pattern is NEW else re.subn(pattern, new, file.read_text())
                if number != 1:
                    sys.exit(f"{path}: {pattern} is found {number} times")
                file.write_text(text)
            files = sorted({path for path, _, _ in edits})
            named = names_in(rows[what])
            unnamed = [path for path in files if not {path.replace("dummy", "NAME").replace("app/look", "app/ROOM"),
                                                      path.rsplit("/")[-1]} & named]
            wrong += len(unnamed)
            print(f"{len(files)} files: {what}" + "".join(f"\n    not in its row: {path}" for path in unnamed))
        if given.dry_run:
            return 1 if wrong else 0
        subprocess.run(["cmake", "--build", "build/release", "--target", "gaitlab", "program_tests"], cwd=clone, check=True,
                       stdout=subprocess.DEVNULL)
        with tempfile.TemporaryDirectory() as empty:
            calls = [([clone / "build/release/bin/gaitlab", *call.split()], text) for _, _, call, text in ADDITIONS]
            calls.append(([clone / "build/release/bin/program_tests", "--gtest_filter=Every/*dummy*:CheckTable.*:Numbers.*"], "PASSED"))
            for call, text in calls:
                done = subprocess.run(call, capture_output=True, text=True, cwd=empty)
                good = done.returncode == 0 and text in done.stdout
                wrong += not good
                print("ok" if good else f"FAILED\n{done.stdout}{done.stderr}", *call[1:])
    finally:
        for path, text in before.items():
            (clone / path).unlink() if text is None else (clone / path).write_text(text)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
