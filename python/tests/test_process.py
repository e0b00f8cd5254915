"""The module in a process of other software: signals, locks, locale, floating-point modes, forks, libraries."""
import ctypes
import glob
import locale
import math
import multiprocessing
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import unittest
import warnings

import numpy as np

import gaitlab
from gaitlab import _native

from common import FAST, ROOT, InFolder, called, caterpillar, digest

LONG = {**FAST, "duration": 3600}


def send_interrupt(*_):
    os.kill(os.getpid(), signal.SIGINT)


class Interrupts(unittest.TestCase):
    def setUp(self):
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def test_run(self):
        for _ in range(2):
            sent = []
            with self.assertRaises(KeyboardInterrupt):
                gaitlab.run(gaitlab.Scenario("caterpillar", LONG), progress=lambda share: sent or sent.append(send_interrupt()))
            self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        self.assertEqual(gaitlab.run(caterpillar()).outcome, "done")

    def test_rollouts_keep_their_rows(self):
        scenario = gaitlab.Scenario("caterpillar", LONG)
        points = [{"duration": 0.1}, {}, {}]
        sent = []
        with self.assertRaises(KeyboardInterrupt) as caught:
            gaitlab.rollouts(scenario, points, threads=1, lanes=1,
                             progress=lambda done, of: done and not sent and sent.append(send_interrupt()))
        table = caught.exception.rollouts
        self.assertEqual(table.outcome, ["done", "not run", "not run"])
        self.assertTrue(np.isfinite(table["speed"][0]))
        self.assertTrue(np.isnan(table.values[1:]).all())

    def test_handler_of_python(self):
        heard = []
        signal.signal(signal.SIGINT, lambda *_: heard.append(1))
        run = gaitlab.run(caterpillar(duration=4), progress=lambda share: heard or send_interrupt())
        self.assertEqual(run.outcome, "done")
        self.assertGreaterEqual(len(heard), 1)


class Threads(unittest.TestCase):
    def test_four_at_once(self):
        wanted, got = digest(gaitlab.run(caterpillar())), []
        threads = [threading.Thread(target=lambda: got.append(digest(gaitlab.run(caterpillar())))) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(got, [wanted] * 4)

    def test_one_scenario_in_two_threads(self):
        scenario = caterpillar()
        points = [{"cpg.amplitude": 0.1 * k} for k in range(1, 5)]
        wanted, got = gaitlab.rollouts(scenario, points).values.tobytes(), []
        threads = [threading.Thread(target=lambda: got.append(gaitlab.rollouts(scenario, points).values.tobytes())) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(got, [wanted] * 2)

    def test_other_threads_go_on(self):
        ticks, over = [], threading.Event()

        def count():
            while not over.wait(0.001):
                ticks.append(1)

        counter = threading.Thread(target=count)
        counter.start()
        seen = []
        gaitlab.run(caterpillar(duration=10), progress=lambda share: seen.append(len(ticks)))
        over.set()
        counter.join()
        self.assertGreater(seen[-1], 0)

    def test_classes_in_threads(self):
        @gaitlab.cpg("test_threads")
        class Still:
            def __init__(self, joints, settings):
                pass

            def output(self, t, x, setpoint):
                setpoint[:] = 0.1 * math.sin(t)

        scenario = gaitlab.Scenario("caterpillar", {**FAST, "cpg": {"type": "test_threads"}})
        wanted, got = digest(gaitlab.run(scenario)), []
        threads = [threading.Thread(target=lambda: got.append(digest(gaitlab.run(scenario)))) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(got, [wanted] * 3)


def digest_of(scenario):
    return digest(gaitlab.run(scenario))


class Processes(InFolder):
    def test_fork(self):
        wanted = digest(gaitlab.run(caterpillar()))
        there, here = os.pipe()
        child = os.fork()
        if child == 0:
            try:
                os.write(here, digest(gaitlab.run(caterpillar())).encode())
            finally:
                os._exit(0)
        os.close(here)
        with os.fdopen(there) as pipe:
            self.assertEqual(pipe.read(), wanted)
        os.waitpid(child, 0)

    def test_spawn(self):
        scenario = caterpillar()
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            self.assertEqual(pool.map(digest_of, [scenario]), [digest(gaitlab.run(scenario))])

    def test_stderr_stays_empty(self):
        """Warnings, which are ignored here, and errors; and the end of a process that holds classes, scenarios and runs."""
        script = """
import gaitlab, warnings
warnings.simplefilter("ignore")
@gaitlab.cpg("ends")
class Ends:
    def __init__(self, joints, settings): pass
    def output(self, t, x, setpoint): setpoint[:] = 0
scenario = gaitlab.Scenario("caterpillar", {"physics.engine": "articulated", "duration": 0.2, "ground.friction": 30, "cpg": {"type": "ends"}})
run = gaitlab.run(scenario)
run.save("there")
again = gaitlab.read("there")
try:
    gaitlab.Scenario("caterpillar", {"no.such": 1})
except gaitlab.InputError:
    pass
trace = run.trace["t"]
"""
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=os.environ)
        self.assertEqual((ended.returncode, ended.stderr, ended.stdout), (0, "", ""))


    def test_daemon_threads_end_with_the_interpreter(self):
        """Threads in a run, in a class of Python, and in rollouts."""
        script = """
import gaitlab, threading, warnings
warnings.simplefilter("ignore")
@gaitlab.cpg("goes")
class Goes:
    def __init__(self, joints, settings): pass
    def output(self, t, x, setpoint):
        setpoint[:] = 0
        begun.release()
begun = threading.Semaphore(0)
scenario = gaitlab.Scenario("caterpillar", {"physics.engine": "articulated", "duration": 3600, "cpg": {"type": "goes"}})
for work in (gaitlab.run, lambda one: gaitlab.rollouts(one, [{}, {}], threads=2)):
    threading.Thread(target=work, args=[scenario], daemon=True).start()
for _ in range(9):
    begun.acquire()
"""
        for _ in range(5):  # the end meets the threads at different places
            ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=os.environ)
            self.assertEqual((ended.returncode, ended.stderr, ended.stdout), (0, "", ""))


def float_modes(bits):
    """Sets bits of the processor's MXCSR in this thread. Returns the old environment."""
    libm = ctypes.CDLL("libm.so.6")
    before = ctypes.create_string_buffer(64)
    libm.fegetenv(before)
    changed = ctypes.create_string_buffer(before.raw, 64)
    mxcsr = int.from_bytes(changed.raw[28:32], "little") | bits
    ctypes.memmove(ctypes.addressof(changed) + 28, mxcsr.to_bytes(4, "little"), 4)
    libm.fesetenv(changed)
    return lambda: libm.fesetenv(before)


class Environment(InFolder):
    def test_subnormal_numbers_are_kept(self):
        """An amplitude below 2.2e-308 gives set points that a processor which flushes to zero would make 0."""
        # A text, because Python's own conversion of the number is subject to the mode.
        tiny = {**FAST, "duration": 0.3, "cpg": "{type: sine, frequency: 1, amplitude: 1e-309}"}
        wanted = gaitlab.run(gaitlab.Scenario("caterpillar", tiny))
        self.assertGreater(np.abs(wanted.trace["joint.0.setpoint"]).max(), 0)
        restore = float_modes(0x8040)  # flush to zero, denormals are zero
        try:
            flushed = np.float64(1e-308) * np.float64(0.1)
            run = gaitlab.run(gaitlab.Scenario("caterpillar", tiny))
            table = gaitlab.rollouts(gaitlab.Scenario("caterpillar", tiny), [{}])
        finally:
            restore()
        self.assertEqual(flushed, 0)  # the mode was in force
        self.assertEqual(digest(run), digest(wanted))
        self.assertEqual(table["speed"][0], wanted.summary["speed"])

    def test_german_decimal_comma(self):
        wanted = digest(gaitlab.run(caterpillar()))

        def refusal():
            with self.assertRaises(gaitlab.InputError) as caught:
                gaitlab.Scenario("caterpillar", {"cpg.amplitude": 4.25})
            return str(caught.exception)

        text = refusal()
        self.assertIn("4.25 rad", text)
        try:
            locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
        except locale.Error:
            self.skipTest("the locale de_DE.UTF-8 is not there")
        self.addCleanup(locale.setlocale, locale.LC_ALL, "C")
        self.assertEqual(locale.localeconv()["decimal_point"], ",")
        self.assertEqual(refusal(), text)
        self.assertEqual(digest(gaitlab.run(caterpillar())), wanted)

    def test_libraries(self):
        needed = subprocess.run(["ldd", _native.__file__], capture_output=True, text=True, check=True).stdout
        for library in ("pagmo", "sqlite3", "tbb", "boost", "urdfdom", "libpython"):
            self.assertNotIn(library, needed)
        symbols = subprocess.run(["nm", "-D", "--defined-only", _native.__file__], capture_output=True, text=True, check=True).stdout
        self.assertRegex(symbols, r"\A\S+ T PyInit__native\n\Z")
        self.assertLess(os.path.getsize(_native.__file__), 7.7e6)  # 7.0 MB; the library of searches would add more than 1 MB


class Hdf5(InFolder):
    def test_filters_of_others_stay(self):
        import h5py  # which loads the same library

        library = glob.glob("/usr/lib/*/libhdf5_serial.so.103")
        if not library:
            self.skipTest("not Debian's library")
        state = ctypes.c_uint()

        def filters():
            ctypes.CDLL(library[0]).H5PLget_loading_state(ctypes.byref(state))
            return state.value

        before = filters()
        self.assertNotEqual(before, 0)
        folder = gaitlab.run(caterpillar()).save()
        self.assertEqual(filters(), before)
        gaitlab.read(folder)
        self.assertEqual(filters(), before)
        with h5py.File(os.path.join(folder, "trace.h5")) as file:
            self.assertGreater(len(file), 0)

    def test_beside_h5py(self):
        """Another thread writes and reads with h5py while runs are saved and read."""
        import h5py

        over, seen, failures = threading.Event(), [], []

        def use():
            try:
                while not over.is_set():
                    with h5py.File("other.h5", "w") as file:
                        file["x"] = np.arange(1000.0)
                    with h5py.File("other.h5") as file:
                        seen.append(file["x"][()].sum())
            except Exception as error:  # noqa: BLE001: reported below
                failures.append(error)

        other = threading.Thread(target=use)
        other.start()
        run = gaitlab.run(caterpillar())
        for k in range(20):
            self.assertEqual(digest(gaitlab.read(run.save(f"run{k}"))), digest(run))
        over.set()
        other.join()
        self.assertEqual(failures, [])
        self.assertEqual(set(seen), {499500.0})


class Plugins(InFolder):
    def compiled(self, amplitude):
        source = "wave.cpp"
        shutil.copy(os.path.join(ROOT, "tests", "plugin_example", "wave.cpp"), source)
        with open(source, "a") as file:
            file.write(f'extern "C" double gaitlab_test_version() {{ return {amplitude}; }}\n')
        compiler = re.search(r"\((GNU|Clang) (\d+)", gaitlab.build)
        command = "g++" if compiler and compiler[1] == "GNU" else "clang++"
        subprocess.run([command, "-std=c++20", "-O0", "-fPIC", "-shared", "-I", ROOT, source, "-o", "wave.so"], check=True)

    def test_rebuilt_plugin_is_refused(self):
        self.compiled(1)
        with open("p.yaml", "w") as file:
            file.write("gaitlab: 1\nplugins: [wave.so]\nrobot: {modules: mtran}\nduration: 0.1\ncpg: {type: wave}\n"
                       "physics: {engine: articulated}\n")
        with self.assertRaisesRegex(gaitlab.InputError, 'plugins="trust"'):
            gaitlab.Scenario("p.yaml", plugins="refuse")
        with self.assertRaisesRegex(gaitlab.InputError, "p.yaml"):
            gaitlab.Scenario("p.yaml", plugins=["p.yaml"])
        first = gaitlab.Scenario("p.yaml", plugins=["wave.so"])
        run = gaitlab.run(first)
        self.assertEqual(run.outcome, "done")
        folder = run.save()
        with self.assertRaisesRegex(gaitlab.InputError, "a record contains only the plugin's name"):
            gaitlab.read(folder, plugins="trust")
        self.assertEqual(digest(gaitlab.read(folder, plugins=["wave.so"])), digest(run))
        shutil.copy("wave.so", folder)
        with self.assertRaisesRegex(gaitlab.InputError, r'read\(..., plugins="trust"\)'):
            gaitlab.read(folder)
        self.assertEqual(digest(gaitlab.read(folder, plugins="trust")), digest(run))
        self.compiled(2)
        with self.assertRaisesRegex(gaitlab.InputError, "built again"):
            gaitlab.Scenario("p.yaml")
        self.assertEqual(gaitlab.run(first).outcome, "done")


class Told(unittest.TestCase):
    def test_warning_of_a_run(self):
        odd = {**FAST, "ground.friction": 30}
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            run = gaitlab.run(gaitlab.Scenario("caterpillar", odd))
        self.assertLessEqual(set(run.warnings), {str(one.message) for one in heard})
        with warnings.catch_warnings():
            warnings.simplefilter("error", gaitlab.Warning)
            with self.assertRaises(gaitlab.Warning):
                gaitlab.Scenario("caterpillar", odd)


if __name__ == "__main__":
    unittest.main()
