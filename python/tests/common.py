"""Common parts of the tests: the program beside the module, scenarios of short runs, and bytes of results."""
import hashlib
import os
import subprocess
import tempfile
import unittest

import numpy as np

import gaitlab
from gaitlab._child import program

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = program()
FAST = {"physics.engine": "articulated", "duration": 1}


def caterpillar(**more):
    return gaitlab.Scenario("caterpillar", {**FAST, **{key.replace("__", "."): value for key, value in more.items()}})


def of_class(name, **more):
    """The caterpillar whose CPG is a class of Python."""
    return gaitlab.Scenario("caterpillar", {**FAST, "cpg": {"type": name}, **more})


def digest(run):
    return hashlib.sha256(np.ascontiguousarray(run.trace.values).tobytes()).hexdigest()


def called(*arguments, code=0, folder=None):
    """Calls the program. Returns its standard output and its standard error."""
    ended = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=folder)
    if ended.returncode != code:
        raise AssertionError(f"gaitlab {arguments}: code {ended.returncode}: {ended.stderr}")
    return ended.stdout, ended.stderr


def options(settings):
    """Settings as options of the command line."""
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


class InFolder(unittest.TestCase):
    """A test in an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = folder.name
