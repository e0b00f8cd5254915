"""Runs: the bytes of `gaitlab run`, tables, folders."""
import gc
import json
import os
import unittest

import numpy as np

import gaitlab

from common import FAST, InFolder, called, caterpillar, digest, options

CLOCK = ("wall_time", "real_time_factor")


def content(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


class Folders(InFolder):
    def test_saved_is_the_folder_of_the_program(self):
        for engine, duration in (("articulated", 4), ("bullet", 1)):
            if engine == "bullet" and "without Bullet" in called("--version")[0]:
                continue
            settings = {"physics.engine": engine, "duration": duration}
            with self.subTest(engine):
                called("run", "hexapod", "--quiet", "--out", f"{engine}-program", *options(settings))
                run = gaitlab.run(gaitlab.Scenario("hexapod", settings))
                self.assertEqual(run.save(f"{engine}-python"), f"{engine}-python")
                names = sorted(os.listdir(f"{engine}-program"))
                self.assertEqual(sorted(os.listdir(f"{engine}-python")), names)
                for name in names:
                    if name != "summary.json":
                        self.assertEqual(content(f"{engine}-python", name), content(f"{engine}-program", name), name)
                mine, other = (json.loads(content(f"{engine}-{who}", "summary.json")) for who in ("python", "program"))
                self.assertEqual({k: v for k, v in mine.items() if k not in CLOCK}, {k: v for k, v in other.items() if k not in CLOCK})

    def test_read_is_the_run(self):
        run = gaitlab.run(caterpillar())
        folder = run.save("there")
        again = gaitlab.read(folder)
        self.assertEqual(digest(again), digest(run))
        self.assertEqual(again.verdict, run.verdict)
        self.assertEqual(again.summary, run.summary)
        self.assertEqual(again.resolved, run.resolved)
        for table in ("ticks", "loads", "poses"):
            self.assertEqual(getattr(again, table).values.tobytes(), getattr(run, table).values.tobytes(), table)
        self.assertEqual(again.page(), run.page())
        with self.assertRaisesRegex(gaitlab.RunError, "was read from"):
            again.save("elsewhere")

    def test_names_of_folders(self):
        run = gaitlab.run(caterpillar(duration=0.1))
        with self.assertRaisesRegex(ValueError, "has a null character"):
            run.save("a\0b")
        self.assertEqual(os.listdir("."), [])
        self.assertEqual([run.save(), run.save()], ["runs/caterpillar-8", "runs/caterpillar-8-2"])
        with self.assertRaisesRegex(gaitlab.InputError, "^save: runs/caterpillar-8: error: exists and is not empty"):
            run.save("runs/caterpillar-8")
        with self.assertRaises(gaitlab.InputError):
            gaitlab.read("nowhere")

    def test_nothing_is_written_before(self):
        gaitlab.run(caterpillar(duration=0.1))
        self.assertEqual(os.listdir("."), [])


class Tables(unittest.TestCase):
    def test_views_are_of_the_memory_and_keep_it(self):
        run = gaitlab.run(caterpillar())
        column, kept, units = run.trace["joint.0.torque"], run.trace["joint.0.torque"].copy(), run.trace.units
        other = gaitlab.run(caterpillar())
        self.assertEqual(digest(other), digest(run))
        del run
        gc.collect()
        more = [gaitlab.run(caterpillar()) for _ in range(3)]  # would reuse memory that was freed by mistake
        self.assertTrue(np.array_equal(column, kept))
        self.assertFalse(column.flags.writeable)
        self.assertFalse(column.flags.owndata)
        with self.assertRaises(ValueError):
            column.setflags(write=True)
        self.assertEqual(units["joint.0.torque"], "N m")
        self.assertEqual(len(more), 3)

    def test_mapping(self):
        trace = gaitlab.run(caterpillar(duration=0.1)).trace
        self.assertEqual(trace.columns[0], "t")
        self.assertEqual(len(trace), trace.values.shape[1])
        self.assertIn("joint.0.torque", trace)
        self.assertEqual(list(trace)[:1], ["t"])
        with self.assertRaises(KeyError):
            trace["joint.99.torque"]
        for name, near in (("joint.m0/active.torque", "joint.0.torque"), ("joint.0.torqe", "joint.0.torque")):
            with self.assertRaisesRegex(KeyError, f"no column {name}; did you mean {near}"):
                trace[name]
        self.assertNotIn("joint.99.torque", trace)
        self.assertIsNone(trace.get("joint.99.torque"))
        frame = trace.to_pandas()
        self.assertEqual(frame.index.name, "t")
        self.assertEqual(frame.attrs["units"]["joint.0.torque"], "N m")
        frame.iloc[0, 0] = 7  # changes a copy
        self.assertNotEqual(trace.values[0, 1], 7)

    def test_loads_are_left_out(self):
        run = gaitlab.run(gaitlab.Scenario("hexapod", FAST), loads=False)
        whole = gaitlab.run(gaitlab.Scenario("hexapod", FAST))
        self.assertLess(len(run.loads), len(whole.loads))
        self.assertEqual(digest(run), digest(whole))
        self.assertEqual(run.verdict["verdict"], whole.verdict["verdict"])


    def test_measured(self):
        log = {"file": "t,a\n0,0\n0.4,0\n", "columns": {"m0/active": {"angle": "a"}}}
        run = gaitlab.run(caterpillar(measured=log))
        angle = run.trace["joint.0.angle"][np.searchsorted(run.trace["t"], [0, 0.4 - 1e-9])]
        self.assertEqual(sorted(run.measured), ["angle.mae", "angle.peak", "angle.rms"])
        self.assertAlmostEqual(run.measured["angle.mae"], np.abs(angle).mean(), places=12)
        self.assertEqual(run.measured["angle.peak"], run.summary["measured"]["angle"]["peak"])
        self.assertIsNone(gaitlab.run(caterpillar(duration=0.1)).measured)


class Ends(unittest.TestCase):
    def test_diverged_run_is_a_run(self):
        @gaitlab.cpg("test_diverges")
        class Diverges:
            def __init__(self, joints, settings):
                pass

            def output(self, t, x, setpoint):
                setpoint[:] = 0 if t < 0.5 else np.inf

        run = gaitlab.run(gaitlab.Scenario("caterpillar", {**FAST, "cpg": {"type": "test_diverges"}}))
        self.assertRegex(run.outcome, "step|t = ")
        self.assertEqual(run.verdict["verdict"], "failed")
        self.assertGreater(run.trace.values.shape[0], 2)
        self.assertIn("<iframe", run._repr_html_())

    def test_progress(self):
        shares = []
        gaitlab.run(caterpillar(), progress=shares.append)
        self.assertEqual(shares[-1], 1)
        self.assertEqual(shares, sorted(shares))

        def refuse(share):
            raise LookupError("enough")

        with self.assertRaisesRegex(LookupError, "enough"):
            gaitlab.run(caterpillar(duration=600), progress=refuse)


if __name__ == "__main__":
    unittest.main()
