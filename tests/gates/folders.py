#!/usr/bin/env python3
"""Files that are passed on do not reveal their author's folder. Each command writes into a folder with a unique name, which
must be in no file, in no compressed part of one (gzip, zlib, also in base64) and in no row of a database. Then the folder is
gone, and its files are still read: reports, reruns, exports, runs of a study.
usage: folders.py PROGRAM BUILD_FOLDER (the plugins of the tests)"""
import array
import base64
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import zlib

PROGRAM, BUILD = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(tempfile.mkdtemp(prefix="gate."))
AUTHOR = WORK / "of-the-author"
TOLD = [str(WORK).encode(), AUTHOR.name.encode(), str(ROOT).encode()]
LONGEST = 600  # s; for a command that never ends
bad = 0

SCENARIO = """gaitlab: 1
plugins: [{plugin}]
robot: {{modules: mtran, docks: [[1, 1, 4, 0, 0]]}}
physics: {{engine: articulated, accuracy: 0.001}}
ground: {{type: heightfield, heightfield: {{file: {heights}, spacing: 0.05, origin: [-5, -5, 0], scale: 0.001}}}}
contact: {{on: all}}
cpg: {{type: wave, frequency: 1, amplitude: 0.3}}
duration: 0.6
"""
STUDY = """gaitlab_study: 1
scenario: {scenario}
parameters: {{cpg.frequency: {{low: 0.5, high: 1}}}}
objective: {{maximize: speed}}
method: {{type: sobol}}
budget: {{runs: 3}}
guards: none
"""


def wrong(text):
    global bad
    bad += 1
    print(f"BAD      {text}", flush=True)


def call(*words, folder=AUTHOR, accepted=(0,), given=b""):
    argv = [str(PROGRAM)] + [str(word) for word in words]
    done = subprocess.run(argv, cwd=folder, input=given, capture_output=True, timeout=LONGEST, check=False)
    if done.returncode not in accepted:
        wrong(f"exit code {done.returncode}: {' '.join(argv[1:])}: {done.stderr.decode(errors='replace')[-600:]}")
    return done.stdout


def heights(path):
    """A matrix of 210 x 210 small numbers, as numpy.save writes it: more than a scenario contains."""
    head = "{'descr': '<f4', 'fortran_order': False, 'shape': (210, 210), }"
    head += " " * (63 - (10 + len(head)) % 64) + "\n"
    values = array.array("f", (float(k * 7919 % 101) / 100 for k in range(210 * 210)))
    path.write_bytes(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode() + values.tobytes())


def parts(data, depth=0):
    """The bytes, and the content of everything compressed in them."""
    yield data
    if depth > 3:
        return
    for start in re.finditer(rb"\x1f\x8b\x08|\x78[\x01\x5e\x9c\xda]", data):
        try:
            packed = zlib.decompressobj(zlib.MAX_WBITS | 32).decompress(data[start.start():])
        except zlib.error:
            continue
        if packed:
            yield from parts(packed, depth + 1)
    for blob in re.finditer(rb"[A-Za-z0-9+/]{64,}={0,2}", data):
        text = blob.group()
        yield from parts(base64.b64decode(text[:len(text) // 4 * 4]), depth + 1)


def texts(path):
    yield from parts(path.read_bytes())
    if path.suffix == ".db":
        with sqlite3.connect(path) as database:
            for line in database.iterdump():
                yield line.encode()


def search(folder):
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    for path in files:
        for text in texts(path):
            told = [word for word in TOLD if word in text]
            if told:
                at = text.index(told[0])
                around = text[max(0, at - 60):at + 90]
                wrong(f"{path.relative_to(AUTHOR)} tells {told[0].decode()}: ...{around.decode(errors='replace')!r}...")
                break
    return len(files)


def write():
    """Every command that writes files, called with absolute paths."""
    walk, study, golden = AUTHOR / "own/walk.yaml", AUTHOR / "own/study.yaml", AUTHOR / "own/walk.golden"
    out = AUTHOR / "passed-on"
    trust = "--plugin", AUTHOR / "lib/wave.so"
    out.mkdir()
    call("run", walk, "--out", out / "run", "--demand", accepted=(0, 3))
    call("run", walk, "--out", out / "csv", "--format", "csv", "--set", "cpg.amplitude=0.2")
    call("report", out / "run", out / "csv", "--page", out / "two.html", *trust)
    call("remedy", walk, "--out", out / "remedy", "--set", "actuator.i_max=0.05", "--by", "amplitude", accepted=(0, 1, 3))
    call("swap", walk, "--cpg", "wave,sine", "--out", out / "swap", "--report")
    call("approve", walk, "--reason", "first")
    shutil.copytree(golden, out / "walk.golden")
    walk.write_text(walk.read_text().replace("amplitude: 0.3", "amplitude: 0.25"))
    call("test", walk, "--out", out / "test", accepted=(4,))  # a page of both runs
    call("check", walk, "--page", out / "check.html", *trust)
    call("export", out / "run", "--to", "gltf", out / "run.glb", *trust)
    for form in "mjcf", "urdf":
        call("export", AUTHOR / "own/flat.yaml", "--to", form, out / ("robot." + form), *trust)
    call("sweep", walk, "--grid", "cpg.frequency=0.5:1:3", "--out", out / "sweep")
    call("optimize", study, "--out", out / "optimize", accepted=(0, 3))
    call("optimize", "caterpillar-speed", "--runs", "8", "--set", "duration=0.5", "--method", "sobol", "--out", out / "shipped",
         accepted=(0, 3))
    call("evaluate", study, "--out", out / "evaluate", given=b'{"id": 1, "parameters": {"cpg.frequency": 0.7}}\n')
    return out


def read(moved):
    """Reads the files in another place, without the author's folder."""
    trust = "--plugin", WORK / "here/wave.so"
    here = WORK / "here"
    call("report", moved / "run", *trust, folder=here)
    call("report", moved / "csv", *trust, "--page", here / "csv.html", folder=here)
    call("rerun", moved / "run", "--verify", *trust, folder=here)
    call("rerun", moved / "run/trace.h5", "--out", here / "again", *trust, folder=here)
    call("export", moved / "run", "--to", "gltf", here / "again.glb", *trust, folder=here)
    for name in "sweep", "optimize", "evaluate":
        call("study", "rerun", moved / name, "0", "--out", here / name, *trust, folder=here)
    # Without --plugin, a library in the folder of the file that names it is loaded if it is allowed.
    shutil.copy(here / "wave.so", moved / "run/wave.so")
    call("rerun", moved / "run", "--verify", "--plugins-from-scenario", folder=here)


def main():
    (AUTHOR / "own").mkdir(parents=True)
    (AUTHOR / "lib").mkdir()
    (WORK / "here").mkdir()
    for folder in AUTHOR / "lib", WORK / "here":
        shutil.copy(BUILD / "plugins/wave.so", folder)
    heights(AUTHOR / "lib/hill.npy")
    (AUTHOR / "own/walk.yaml").write_text(SCENARIO.format(plugin="../lib/wave.so", heights="../lib/hill.npy"))
    (AUTHOR / "own/flat.yaml").write_text(re.sub("(?m)^ground: .*\n", "", (AUTHOR / "own/walk.yaml").read_text()))
    (AUTHOR / "own/study.yaml").write_text(STUDY.format(scenario="walk.yaml"))
    out = write()
    count = search(out)
    moved = WORK / "elsewhere"
    out.rename(moved)
    shutil.rmtree(AUTHOR)
    read(moved)
    print(f"{'ok' if bad == 0 else 'BAD'}: {count} files, {bad} bad")
    return 1 if bad else 0


try:
    sys.exit(main())
finally:
    shutil.rmtree(WORK)
