#!/usr/bin/env python3
"""Every command in a folder full of traps: it loads no library from there, waits for no FIFO under a name that it opens, and
does not change a user's files under the names that it writes. No file of the build and install trees has an empty or relative
run path. It costs some 25 s of CPU: a thousand starts of the program.
usage: traps.py PROGRAM BUILD_FOLDER (TRAPS_LONGEST, 600: seconds after which a command counts as waiting for ever)
Exit code 77 if strace is missing (Debian: strace) or tracing is not allowed."""
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

PROGRAM, BUILD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(tempfile.mkdtemp(prefix="traps."))
LONGEST = int(os.environ.get("TRAPS_LONGEST", "600"))  # s; time limit for a command that does not end
bad = 0


def wrong(text):
    global bad
    bad += 1
    print(f"BAD      {text}", flush=True)


def call(argv, folder, **options):
    """Exit code of a command (None if it does not end), and both outputs."""
    try:
        done = subprocess.run([str(word) for word in argv], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, timeout=LONGEST,
                              **options)
        return done.returncode, done.stdout + done.stderr
    except subprocess.TimeoutExpired as late:
        return None, (late.stdout or b"") + (late.stderr or b"")


def expect(argv, folder):
    code, said = call(argv, folder)
    if code != 0:
        sys.exit(f"exit code {code}: {argv}: {said.decode(errors='replace')}")
    return said.decode(errors="replace")


# --- run paths ----------------------------------------------------------------------------------------------------------


def elf_files(folder):
    """Paths of programs and shared libraries in a folder."""
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink() and path.suffix != ".o":
            with open(path, "rb") as file:
                if file.read(4) == b"\x7fELF":
                    yield path


def run_paths(folder):
    count = 0
    for path in elf_files(folder):
        count += 1
        dynamic = expect(["readelf", "--dynamic", "--wide", path], folder)
        for entries in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", dynamic):
            for entry in entries.split(":"):
                if not entry.startswith("/"):
                    wrong(f"{path.relative_to(folder)}: its run path has the entry '{entry}': libraries of the current folder ({entries})")
    return count


# --- the folder, and what is called in it -------------------------------------------------------------------------------

SCENARIO = """gaitlab: 1
name: two
robot: {modules: modules/mtran.yaml, docks: [[1, 1, 4, 0, 0]], base: fixed}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated, accuracy: 0.001}
cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.6, phase_lag: 1.2}
trace: {period: 0.01}
duration: 0.1
"""
STUDY = """gaitlab_study: 1
name: few
scenario: two.yaml
parameters: {cpg.frequency: {low: 0.5, high: 3}}
guards: none
"""
COMMANDS = {
    "version": "--version",
    "help": "help run",
    "list": "list",
    "explain": "explain cpg equations",
    "schema": "schema",
    "completion": "completion bash",
    "completion of words": "completion bash -- run two.yaml --set physics.engine=",
    "man": "man",
    "check": "check two.yaml",
    "check --page": "check two.yaml --page page.html",
    "run": "run two.yaml --quiet",
    "run --out": "run two.yaml --quiet --out new",
    "demo": "demo --out new",
    "run csv": "run two.yaml --quiet --format csv --out new",
    "converge": "converge two.yaml --halvings 1",
    "swap": "swap two.yaml --cpg sine,hopf --quiet",
    "sweep": "sweep study.yaml --quiet --out new",
    "sweep --out": "sweep study.yaml --quiet --out study",
    "shard": "sweep study.yaml --quiet --out shards --shard 1/2",
    "optimize": "optimize search.yaml --quiet --out new",
    "evaluate": "evaluate study.yaml --quiet --out new",
    "study show": "study show study",
    "study report": "study report study",
    "study best": "study best study",
    "study export": "study export study --to csv table.csv",
    "study merge": "study merge shards",
    "study rerun": "study rerun study 0",
    "report": "report run",
    "report --page": "report run --page page.html",
    "report --out": "report run --out new",
    "report of two": "report run csv",
    "figure": "figure recipe.yaml -o figure.svg",
    "compare": "compare run csv",
    "dynamics": "dynamics two.yaml --state state.json",
    "export csv": "export run --to csv rows.csv",
    "export gltf": "export run --to gltf robot.glb",
    "export mjcf": "export two.yaml --to mjcf robot.xml",
    "export urdf": "export two.yaml --to urdf robot.urdf",
    "rerun": "rerun run --quiet --out new",
    "rerun --verify": "rerun run --verify",
    "approve": "approve two.yaml --reason trap",
    "test": "test golden/two.yaml --junit junit.xml",
    "new plugin": "new plugin cpg mine",
    "new module": "new module mine",
    "new module --from": "new module mine --from from.urdf",
    "new scenario": "new scenario mine --module modules/mtran.yaml",
    "new log": "new log mine",
}
# Commands that intentionally replace files: in the folder of a study or a run, or the figure of a recipe.
RENEWED = {"study report", "sweep --out", "shard", "study merge", "report of two", "figure"}
# Endings of file names that SQLite uses next to a journal, and of files that a killed `approve` leaves.
OURS = ("-wal", "-shm", "-journal", ".golden.next")


def gaitlab(words):
    return [PROGRAM, *words.split()]


def prepare(folder):
    folder.mkdir()
    shutil.copytree(ROOT / "scenarios/modules", folder / "modules")
    (folder / "two.yaml").write_text(SCENARIO)
    (folder / "study.yaml").write_text(STUDY + "method: {type: random}\nbudget: {runs: 4}\n")
    (folder / "search.yaml").write_text(STUDY + "objective: {maximize: speed}\nmethod: {type: cma, population: 5, instances: 1}\nbudget: {runs: 20}\n")
    (folder / "recipe.yaml").write_text("gaitlab: 1\nruns: {two: run}\npanels:\n  - kind: curves\n    left: {columns: [joint.0.angle]}\n")
    (folder / "state.json").write_text("{}\n")
    expect(gaitlab("run two.yaml --quiet --out run"), folder)
    expect(gaitlab("export two.yaml --to urdf from.urdf"), folder)
    expect(gaitlab("run two.yaml --quiet --format csv --out csv"), folder)
    expect(gaitlab("sweep study.yaml --quiet --out study"), folder)
    for shard in ("0/2", "1/2"):
        expect(gaitlab(f"sweep study.yaml --quiet --out shards --shard {shard}"), folder)
    (folder / "golden").mkdir()
    shutil.copyfile(folder / "two.yaml", folder / "golden/two.yaml")
    (folder / "golden/modules").symlink_to("../modules")
    expect(gaitlab("approve golden/two.yaml --reason first"), folder)


def copy_of(folder):
    new = WORK / "now"
    shutil.rmtree(new, ignore_errors=True)
    shutil.copytree(folder, new, symlinks=True)
    return new


# --- libraries ----------------------------------------------------------------------------------------------------------


def libraries_of(program):
    """Names of all libraries that the loader uses, each with the required symbol versions."""
    names = [line.split()[0] for line in expect(["ldd", program], WORK).splitlines() if "=>" in line]
    versions, of = {}, None
    for line in expect(["objdump", "--private-headers", program], WORK).splitlines():
        if found := re.match(r"\s+required from (\S+):", line):
            of = versions.setdefault(found[1], [])
        elif (found := re.match(r"\s+0x\S+ 0x\S+ \d+ (\S+)$", line)) and of is not None:
            of.append(found[1])
    return {name: versions.get(name, []) for name in names}


def make_library(name, versions, file, log):
    """Builds a library that writes its name into a file when it is loaded."""
    (WORK / "trap.c").write_text(f"""#include <fcntl.h>
#include <unistd.h>
__attribute__((constructor)) static void loaded(void) {{
  const int log = open("{log}", O_WRONLY | O_CREAT | O_APPEND, 0666);
  (void)!write(log, "{name} ", {len(name) + 1});
}}
""")
    (WORK / "versions").write_text("".join(f"{version} {{ }};\n" for version in versions))
    with_versions = [f"-Wl,--version-script={WORK}/versions"] if versions else []
    expect(["cc", "-shared", "-fPIC", f"-Wl,-soname,{name}", *with_versions, WORK / "trap.c", "-o", file], WORK)


def try_libraries(good):
    """Tests each library alone, because a library without the required symbols ends the program before it loads others. Then tests all
    libraries at once with every command."""
    log = WORK / "loaded"
    environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}

    def harmless(what, words, folder, codes):
        code, said = call([program, *words.split()], folder, env=environment)
        if code in codes and not log.exists():
            return True
        ran = f"runs {log.read_text()}of the current folder" if log.exists() else f"exit code {code}: {said.decode(errors='replace')[-300:]}"
        log.unlink(missing_ok=True)
        wrong(f"{program.name} {words}, beside {what}: {ran}")
        return False

    for program in (PROGRAM, PROGRAM.with_name("gaitlab-mpi")):
        if not program.exists():
            continue
        libraries, folder = libraries_of(program), copy_of(good)
        if len(libraries) < 8:
            wrong(f"{program.name}: only {len(libraries)} libraries: this gate sees nothing")
        for name, versions in libraries.items():
            make_library(name, versions, WORK / name, log)
            shutil.copyfile(WORK / name, folder / name)
            harmless(f"a library {name}", "--version", folder, (0,))
            (folder / name).unlink()
        if bad:
            continue  # a test with all libraries at once would show nothing more
        for name in libraries:
            shutil.move(WORK / name, folder / name)
        commands = COMMANDS.values() if program == PROGRAM else ["--version"]
        for words in commands:
            harmless("libraries", words, folder, (0, 2))  # exit code 2 if the output exists already
        print(f"ok       {program.name}: {len(commands)} commands beside {len(libraries)} libraries", flush=True)


# --- names that are opened and written ----------------------------------------------------------------------------------


def names_of(words, folder):
    """Names below the folder that a command opens, and names that it writes, according to strace."""
    log = WORK / "strace"
    code, said = call(["strace", "-f", "-qq", "-e", "trace=%file", "-o", log, *gaitlab(words)], folder)
    if code not in (0, 3):  # exit code 3 if the verification of this short search fails
        wrong(f"{words}: exit code {code}: {said.decode(errors='replace')[-300:]}")
    looked, written = set(), set()
    for line in log.read_text(errors="replace").splitlines():
        found = re.match(r"\d+\s+(\w+)\((.*)", line)
        if not found:
            continue
        call_name, rest = found.groups()
        paths = re.findall(r'"((?:[^"\\]|\\.)*)"', rest)
        if not paths or call_name == "execve":
            continue
        name = os.path.normpath(os.path.join(folder, paths[-1]))
        if not name.startswith(f"{folder}/") or name.endswith(".part"):
            continue
        name = os.path.relpath(name, folder)
        if call_name.startswith("rename") or "O_CREAT" in rest:
            written.add(name)
        elif not os.path.isdir(folder / name):
            looked.add(name)
    return looked - written, written


def ends(what, words, folder):
    code, said = call(gaitlab(words), folder)
    if code is None:
        wrong(f"{what}: waits for ever: gaitlab {words}")
    elif code not in (0, 1, 2, 3, 4):
        wrong(f"{what}: exit code {code}: gaitlab {words}: {said.decode(errors='replace')[-300:]}")
    return code


def put(folder, name):
    """Path of a name that does not exist in an existing folder."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
    return path


def try_names(good):
    tried = {"FIFOs": 0, "links": 0, "files": 0}
    os.mkfifo(WORK / "somewhere")
    seen = set()
    for command, words in COMMANDS.items():
        looked, written = names_of(words, copy_of(good))
        for name in sorted(looked):
            # A file that all commands read in the same way is tested only with the first of them.
            if (name, words.split()[0]) in seen:
                continue
            seen.add((name, words.split()[0]))
            folder = copy_of(good)
            os.mkfifo(put(folder, name))
            tried["FIFOs"] += 1
            ends(f"{command}: a FIFO under {name}", words, folder)
            put(folder, name).symlink_to(WORK / "somewhere")
            tried["links"] += 1
            ends(f"{command}: a link to a FIFO under {name}", words, folder)
        for name in sorted(written):
            folder = copy_of(good)
            os.mkfifo(put(folder, name))
            tried["FIFOs"] += 1
            ends(f"{command}: a FIFO under {name}", words, folder)
            if (good / name).exists() or command in RENEWED or name.endswith(OURS):
                continue
            folder = copy_of(good)
            path = put(folder, name)
            path.write_text("a user's\n")
            tried["files"] += 1
            code = ends(f"{command}: a user's file under {name}", words, folder)
            if not path.is_file() or path.read_bytes() != b"a user's\n":
                wrong(f"{command}, exit code {code}: replaces a user's {name}")
    for kind, count in tried.items():
        if count < 40:
            wrong(f"only {count} {kind}: this gate sees nothing")
    print("ok       " + ", ".join(f"{count} {kind}" for kind, count in tried.items()))


def main():
    built = run_paths(BUILD)
    expect(["cmake", "--install", BUILD, "--prefix", WORK / "installed"], WORK)
    installed = run_paths(WORK / "installed")
    if built < 5 or installed < 1:
        wrong(f"only {built} files of the build tree and {installed} installed: this gate sees nothing")
    print(f"ok       the run paths of {built} built and {installed} installed files", flush=True)
    resource.setrlimit(resource.RLIMIT_CPU, (300, 300))  # limit of CPU time per process for endless loops, s
    prepare(good := WORK / "good")
    try_libraries(good)
    code, said = call(["strace", "-f", "-e", "trace=%file", "true"], WORK) if shutil.which("strace") else (127, b"strace is missing")
    if bad:
        print("         (names are not tried before libraries are right)")
    elif code == 0:
        try_names(good)
    else:
        print(f"SKIPPED  traps under names: NOT TESTED: {said.decode(errors='replace').splitlines()[-1]} (Debian: strace)", file=sys.stderr)
        if not bad:
            sys.exit(77)
    print(f"{bad} bad")
    sys.exit(1 if bad else 0)


try:
    main()
finally:
    shutil.rmtree(WORK, ignore_errors=True)
