"""Tables of rollouts: the bits of `gaitlab sweep`, refused rows, interrupts by an exception."""
import itertools
import sys
import unittest
import warnings

import numpy as np

import gaitlab

from common import FAST, ROOT, InFolder, called, caterpillar


def equal(a, b):
    """The same bits, or both unknown."""
    return (a == b) | (np.isnan(a) & np.isnan(b))


class Sweep(InFolder):
    def same_as_sweep(self, engine, lags, amplitudes):
        settings = {"physics.engine": engine, "duration": 1}
        with open("study.yaml", "w") as file:
            file.write(f"gaitlab_study: 1\nscenario: {ROOT}/scenarios/caterpillar.yaml\nestimate_every: 1\nmethod: {{type: grid}}\n"
                       f"set: [{', '.join(f'{key}={value}' for key, value in settings.items())}]\n"
                       f"parameters:\n  cpg.phase_lag: {{low: -1.6, high: 1.6, count: {lags}}}\n"
                       f"  cpg.amplitude: {{low: 0.2, high: 0.8, count: {amplitudes}}}\n")
        called("sweep", "study.yaml", "--quiet", "--out", "swept", "-j", "2")
        journal = gaitlab.study("swept")
        rows = journal.points
        column = dict(zip(journal.quantities["name"], journal.quantities["column_name"]))
        asked = [{key: row[key] for key in ("cpg.phase_lag", "cpg.amplitude")} for row in rows.to_dict("records")]
        self.assertEqual(len(asked), lags * amplitudes)
        scenario = gaitlab.Scenario("caterpillar", settings)
        for lanes in (1, 0):
            table = gaitlab.rollouts(scenario, asked, lanes=lanes, threads=2, estimate_every=1)
            self.assertEqual(table.outcome, ["done"] * len(asked))
            self.assertEqual(table.verdict, list(rows["verdict"]))
            self.assertEqual(table.message, list(rows["message"]))
            for name in table:
                swept = rows[column[name]].to_numpy(float)
                self.assertTrue(equal(table[name], swept).all(), f"{engine}, lanes {lanes}: {name}")
            self.assertTrue(np.isfinite(table["speed"]).all())

    def test_articulated(self):
        self.same_as_sweep("articulated", 8, 8)

    def test_bullet(self):
        if "without Bullet" in called("--version")[0]:
            self.skipTest("this build has no Bullet")
        self.same_as_sweep("bullet", 3, 2)


class Rows(unittest.TestCase):
    def test_threads_and_lanes_change_no_bit(self):
        points = [{"cpg.phase_lag": 0.1 * k} for k in range(12)]
        tables = [gaitlab.rollouts(caterpillar(), points, threads=threads, lanes=lanes).values.tobytes()
                  for threads, lanes in ((1, 1), (2, 4), (3, 0))]
        self.assertEqual(len(set(tables)), 1)

    def test_a_row_is_its_run(self):
        table = gaitlab.rollouts(caterpillar(), [{"cpg.amplitude": 0.4}])
        run = gaitlab.run(caterpillar(cpg__amplitude=0.4))
        self.assertEqual(table["speed"][0], run.summary["speed"])
        self.assertEqual(table.units["speed"], "m/s")
        self.assertEqual(table.verdict, [run.verdict["verdict"]])

    def test_estimates(self):
        points = [{"cpg.phase_lag": 0.05 * k} for k in range(34)]
        usual, all_rows, none = (gaitlab.rollouts(caterpillar(duration=0.3), points, estimate_every=every) for every in (16, 1, 0))
        error = "torque_error.worst"
        self.assertEqual(list(np.flatnonzero(np.isfinite(usual[error]))), [0, 16, 32])
        self.assertTrue(np.isfinite(all_rows[error]).all())
        self.assertTrue(np.isnan(none[error]).all())
        self.assertEqual(usual["speed"].tobytes(), all_rows["speed"].tobytes())
        self.assertEqual(usual["speed"].tobytes(), none["speed"].tobytes())
        self.assertEqual(usual[error][16], all_rows[error][16])
        few = gaitlab.rollouts(caterpillar(duration=0.3), points[:20])
        self.assertTrue(np.isfinite(few[error]).all())

    def test_estimates_are_held_against_the_limit_of_the_scenario(self):
        points = [{"cpg.phase_lag": 0.05 * k} for k in range(34)]
        with self.assertWarnsRegex(Warning, r"above limits\.torque_error in 3 of 3 estimates"):
            gaitlab.rollouts(caterpillar(duration=0.3, limits__torque_error=1e-9), points, estimate_every=16)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gaitlab.rollouts(caterpillar(duration=0.3), points, estimate_every=16)

    def test_refused_is_a_row(self):
        points = [{}, {"cpg.amplitude": 99}, {"cpg.nope": 1}, {"cpg.amplitude": float("nan")}, {"duration": float("inf")}, {}]
        table = gaitlab.rollouts(caterpillar(), points)
        self.assertEqual(table.outcome, ["done", "refused", "refused", "refused", "refused", "done"])
        self.assertTrue(np.isnan(table.values[1:5]).all())
        self.assertEqual(table.values[0].tobytes(), table.values[5].tobytes())
        self.assertRegex(table.message[2], "cpg.nope")
        self.assertEqual(table.verdict[1:5], [""] * 4)

    def test_none_and_empty(self):
        self.assertEqual(gaitlab.rollouts(caterpillar(), []).values.shape[0], 0)
        self.assertEqual(gaitlab.rollouts(caterpillar(), []).to_pandas().shape[0], 0)
        self.assertEqual(gaitlab.rollouts(caterpillar(), [{}]).outcome, ["done"])

    def test_frames(self):
        import pandas

        points = pandas.DataFrame({"cpg.amplitude": [0.2, 0.4], "cpg.phase_lag": [0.5, 1.0]})
        table = gaitlab.rollouts(caterpillar(), points)
        frame = table.to_pandas()
        self.assertEqual(list(frame.columns[:2]), ["cpg.amplitude", "cpg.phase_lag"])
        self.assertEqual(list(frame["outcome"]), ["done", "done"])
        self.assertEqual(frame.attrs["units"]["speed"], "m/s")

    def test_types_of_cpg(self):
        table = gaitlab.rollouts(caterpillar(), [{"cpg": {"type": one}} for one in ("sine", "hopf", "none_such")])
        self.assertEqual(table.outcome[2], "refused")
        self.assertEqual(table.outcome[:2], ["done", "done"])

    def test_with(self):
        scenario = caterpillar().with_({"cpg.amplitude": 0.4})
        table = gaitlab.rollouts(scenario, [{"cpg.phase_lag": 0.5}])
        run = gaitlab.run(scenario.with_({"cpg.phase_lag": 0.5}))
        self.assertEqual(table["speed"][0], run.summary["speed"])

    def test_quantities(self):
        names = ["torque.peak[m0/active]", "margin.voltage", "speed", "margin.voltage[0.5]"]
        table = gaitlab.rollouts(caterpillar(), [{}], quantities=names)
        self.assertEqual(list(table), names)
        self.assertEqual(table.units["torque.peak[m0/active]"], "N m")
        self.assertGreater(table["torque.peak[m0/active]"][0], 0)
        with self.assertRaisesRegex(TypeError, r"quantities are a list of names: quantities=\['speed'\]"):
            gaitlab.rollouts(caterpillar(), [{}], quantities="speed")
        with self.assertRaisesRegex(gaitlab.InputError, "did you mean 'speed'"):
            gaitlab.rollouts(caterpillar(), [{}], quantities=["sped"])
        self.assertIn("speed", [one.name for one in gaitlab.quantities()])
        self.assertIn("torque.peak", [one.name for one in gaitlab.quantities(of_joints=True)])

    def test_ranges(self):
        for name, value, low, high in (("threads", 10**9, 1, 1024), ("threads", 0, 1, 1024), ("threads", 10**30, 1, 1024),
                                       ("lanes", 10**6, 0, 64), ("lanes", -1, 0, 64), ("estimate_every", -1, 0, sys.maxsize)):
            with self.subTest(name), self.assertRaisesRegex(ValueError, f"^{name} is {value}; expected {low} to {high}$"):
                gaitlab.rollouts(caterpillar(), [{}], **{name: value})
        for value in (1.5, "2", True):
            with self.subTest(value), self.assertRaisesRegex(TypeError, "^threads must be a whole number from 1 to 1024, not "):
                gaitlab.rollouts(caterpillar(), [{}], threads=value)

    def test_progress_and_its_exception(self):
        seen = []
        gaitlab.rollouts(caterpillar(), [{}] * 5, progress=lambda done, of: seen.append((done, of)))
        self.assertEqual(seen[-1], (5, 5))

        def refuse(done, of):
            if done:
                raise LookupError("enough")

        points = [{"duration": 0.1}, *({"duration": 600} for _ in range(3))]
        with self.assertRaises(LookupError) as caught:
            gaitlab.rollouts(caterpillar(), points, threads=1, lanes=1, progress=refuse)
        self.assertEqual(caught.exception.rollouts.outcome, ["done", "not run", "not run", "not run"])
        self.assertTrue(np.isfinite(caught.exception.rollouts["speed"][0]))

    def test_diverged_is_a_row(self):
        @gaitlab.cpg("test_row_diverges", at=(1.0, "s", 0, 100, "Time of the infinite set point."))
        class Diverges:
            def __init__(self, joints, settings):
                self.at = settings["at"]

            def output(self, t, x, setpoint):
                setpoint[:] = 0 if t < self.at else np.inf

        scenario = gaitlab.Scenario("caterpillar", {**FAST, "cpg": {"type": "test_row_diverges"}})
        table = gaitlab.rollouts(scenario, [{"cpg.at": 0.5}, {"cpg.at": 50}, {"cpg.at": 200}])
        self.assertEqual(table.outcome, ["diverged", "done", "refused"])
        self.assertEqual(list(itertools.compress(table.verdict, table.verdict)), [table.verdict[1]])


if __name__ == "__main__":
    unittest.main()
