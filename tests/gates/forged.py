#!/usr/bin/env python3
"""Forged traces with valid hashes, which try to read other files, load code or crash the program. Each must be refused or
compared, without other effects.

usage: forged.py PROGRAM TRACE FLIPS   (in a folder of its own)
"""
import os
import random
import resource
import shutil
import struct
import subprocess
import sys
import zlib

import h5py

program, good, flips = sys.argv[1], sys.argv[2], int(sys.argv[3])
# Leak detection is off, because HDF5 1.10 does not free some blocks after a file that it cannot open.
os.environ["ASAN_OPTIONS"] = ":".join(filter(None, [os.environ.get("ASAN_OPTIONS"), "detect_leaks=0"]))
bad = told = 0


def signed(name):
    rest = open(name, "rb").read()[512:]
    state = 14695981039346656037
    for word in (len(rest), *struct.unpack(f"<{(len(rest) + 7) // 8}Q", rest + b"\0" * (-len(rest) % 8))):
        state = (state ^ word) * 1099511628211 % 2**64
        state ^= state >> 32
    head = f"gaitlab-trace-1\nHDF5 follows at byte 512. Bytes in all: {512 + len(rest)}; hash from byte 512 on: {state:016x}\n"
    open(name, "wb").write(head.encode().ljust(512, b"\0") + rest)


def compare(name):
    # The limit is a minute of CPU time; a tenth of a second is usual. The ten minutes of real time are for a call that does not end.
    minute = lambda: resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
    done = subprocess.run([program, "compare", name, good], capture_output=True, text=True, timeout=600, preexec_fn=minute)
    return done.returncode, done.stderr


def forged(name, change, said):
    """Writes a trace whose dataset `change` replaces, and expects this message of the program."""
    global bad
    shutil.copyfile(good, name)
    with h5py.File(name, "r+") as file:
        old = file["trace"]
        values, attributes = old[:], dict(old.attrs)
        del file["trace"]
        change(file, values)
        if file.get("trace", getlink=True).__class__ is h5py.HardLink:
            for key, value in attributes.items():
                file["trace"].attrs[key] = value
    signed(name)
    refused(name, said)


def refused(name, said):
    global bad, told
    told += 1
    code, err = compare(name)
    if code != 2 or said not in err:
        bad += 1
        print(f"bad      {name}: exit {code}: {err}")


def short_chunks(path):
    """Writes a trace whose dataset `path` has chunks that unpack to 4 bytes, beyond which HDF5 1.10 reads."""
    shutil.copyfile(good, "short.h5")
    with h5py.File("short.h5", "r+") as file:
        old = file[path]
        shape, chunks, attributes = old.shape, old.chunks, dict(old.attrs)
        del file[path]
        made = file.create_dataset(path, shape, "<f8", chunks=chunks, compression="gzip", shuffle=True)
        for key, value in attributes.items():
            made.attrs[key] = value
        for column in range(shape[1]):
            made.id.write_direct_chunk((0, column), zlib.compress(bytes(4)), 0)
    signed("short.h5")
    refused("short.h5", f"dataset /{path}: the chunk of column 0 from row 0 on does not unpack to")


def soft(file, values):
    file["trace"] = h5py.SoftLink("/recording/ticks")


def external_link(file, values):
    file["trace"] = h5py.ExternalLink(good, "/trace")


def external_storage(file, values):
    values.tofile("values.bin")
    file.create_dataset("trace", values.shape, "<f8", external=[("values.bin", 0, values.nbytes)])


def virtual(file, values):
    layout = h5py.VirtualLayout(values.shape, "<f8")
    layout[:] = h5py.VirtualSource(good, "trace", values.shape)
    file.create_virtual_dataset("trace", layout)


def of_itself(file, values):
    layout = h5py.VirtualLayout(values.shape, "<f8")
    layout[:] = h5py.VirtualSource(".", "trace", values.shape)
    file.create_virtual_dataset("trace", layout)


def other_filter(file, values):
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_chunk(values.shape)
    properties.set_filter(32000, h5py.h5z.FLAG_OPTIONAL)
    h5py.h5d.create(file.id, b"trace", h5py.h5t.IEEE_F64LE, h5py.h5s.create_simple(values.shape), properties)


forged("soft.h5", soft, "is a link to another place")
forged("external-link.h5", external_link, "is a link to another place")
forged("external.h5", external_storage, "is not stored in this file")
forged("virtual.h5", virtual, "is not stored in this file")
forged("itself.h5", of_itself, "is not stored in this file")
# A library that creates a file when it is loaded.
with open("evil.c", "w") as code:
    code.write('#include <stdio.h>\n__attribute__((constructor)) static void f(void) { fclose(fopen("loaded", "w")); }\n')
os.makedirs("plugins", exist_ok=True)
subprocess.run(["cc", "-shared", "-fPIC", "-o", "plugins/libevil.so", "evil.c"], check=True)
os.environ["HDF5_PLUGIN_PATH"] = os.path.abspath("plugins")
forged("filter.h5", other_filter, "is packed by filter 32000")
with h5py.File(good) as file:
    datasets = [path for path in ["trace", *(f"recording/{name}" for name in file["recording"])] if file[path].size]
for path in datasets:
    short_chunks(path)
if os.path.exists("loaded"):
    bad += 1
    print("bad      HDF5 loaded a library for a filter")

random.seed(1)
whole = open(good, "rb").read()
ends = {}
for _ in range(flips):
    one = bytearray(whole)
    # Half of the flips are in the first 4 kB of the HDF5 data, which contain its structures.
    end = random.choice([min(4608, len(one)), len(one)])
    for _ in range(random.randint(1, 8)):
        one[random.randrange(512, end)] ^= 1 << random.randrange(8)
    open("flipped.h5", "wb").write(bytes(one))
    signed("flipped.h5")
    code, err = compare("flipped.h5")
    ends[code] = ends.get(code, 0) + 1
    if code not in (0, 2, 4):
        bad += 1
        shutil.copyfile("flipped.h5", f"crash-{bad}.h5")
        print(f"bad      flipped: exit {code}: {err}")
print(f"forged traces: {told - bad} of {told} refused; {flips} with flipped bits: exit codes {dict(sorted(ends.items()))}")
sys.exit(bad != 0)
