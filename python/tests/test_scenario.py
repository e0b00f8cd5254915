"""Scenarios: texts of errors, warnings, settings, checks, pickling."""
import gc
import os
import pickle
import unittest
import warnings

import numpy as np

import gaitlab
from gaitlab._settings import texts

from common import FAST, ROOT, InFolder, called, caterpillar

BAD = "gaitlab: 1\nname: bad\nrobot: {modules: mtran, build: none.dat}\ncpg: {type: hopff}\nduration: x\n"


class Errors(InFolder):
    def test_text_is_that_of_check(self):
        with open("bad.yaml", "w") as file:
            file.write(BAD)
        _, told = called("check", "bad.yaml", code=2)
        with self.assertRaises(gaitlab.InputError) as caught:
            gaitlab.Scenario("bad.yaml")
        self.assertEqual(str(caught.exception), told.rstrip("\n"))
        self.assertEqual([line for _, line, _, _ in caught.exception.problems], [3, 4, 5])
        self.assertTrue(all(file == "bad.yaml" for file, *_ in caught.exception.problems))
        self.assertIsInstance(caught.exception, ValueError)

    def test_setting_has_the_place_of_the_option(self):
        with self.assertRaises(gaitlab.InputError) as caught:
            gaitlab.Scenario("caterpillar", {"cpg.frequncy": 1})
        _, told = called("check", "caterpillar", "--set", "cpg.frequncy=1", code=2)
        self.assertEqual(str(caught.exception), told.rstrip("\n"))

    def test_numbers_that_are_not_finite(self):
        for value in (float("nan"), float("inf"), -float("inf"), np.float64("nan")):
            with self.assertRaisesRegex(gaitlab.InputError, "cpg.frequency"):
                caterpillar(cpg__frequency=value)

    def test_no_such_file(self):
        with self.assertRaisesRegex(gaitlab.InputError, "nowhere.yaml"):
            gaitlab.Scenario("nowhere.yaml")

    def test_a_path_or_name_is_a_scenario(self):
        self.assertEqual(gaitlab.run("pendulum", loads=False).name, "pendulum")
        self.assertEqual(gaitlab.rollouts("pendulum", [{"duration": 0.1}]).outcome, ["done"])
        with self.assertRaisesRegex(TypeError, "a scenario must be a gaitlab.Scenario, a path or the name of a shipped scenario"):
            gaitlab.run(3)

    def test_arguments_of_another_type(self):
        for call in (lambda: gaitlab.Scenario("caterpillar", ["duration=2"]), lambda: caterpillar().with_(["duration=2"])):
            with self.assertRaisesRegex(TypeError, r'settings are a mapping from key to value, as in {"duration": 2}, not list'):
                call()
        with self.assertRaisesRegex(ValueError, "has a null character"):
            gaitlab.Scenario("caterpillar\0")
        with self.assertRaises(TypeError):
            gaitlab.Scenario("caterpillar", {"duration": object()})
        with self.assertRaises(ValueError):
            gaitlab.Scenario("caterpillar", plugins="some")


class Settings(unittest.TestCase):
    def test_texts(self):
        self.assertEqual(texts({"a": 0.1, "b": True, "c": np.float32(0.1), "d": [1, 2.5], "e": np.arange(2), "f": "x: 1"}),
                         ["a=0.1", "b=true", f"c={float(np.float32(0.1))!r}", "d=[1, 2.5]", "e=[0, 1]", "f=x: 1"])
        self.assertEqual(texts({"cpg": {"type": "hopf", "phase": [0, "a b"]}}), ['cpg={"type": "hopf", "phase": [0, "a b"]}'])

    def test_bits_survive(self):
        for value in (1 / 3, np.nextafter(0.25, 1), 5e-324):
            self.assertEqual(float(texts({"k": value})[0].split("=")[1]), value)

    def test_with_is_the_same_as_reading(self):
        one = caterpillar().with_({"cpg.frequency": 1 / 3, "duration": 2})
        two = caterpillar(cpg__frequency=1 / 3, duration=2)
        self.assertEqual(one.resolved, two.resolved)
        self.assertEqual(one.settings, two.settings)
        self.assertEqual(one.with_({"duration": 1}).resolved, two.with_({"duration": 1}).resolved)

    def test_pickle(self):
        one = caterpillar().with_({"cpg.frequency": 1 / 3})
        two = pickle.loads(pickle.dumps(one))
        self.assertEqual(one.resolved, two.resolved)

    def test_outlives_its_creator(self):
        def made():
            first = caterpillar()
            return first.with_({"duration": 0.5})

        scenario = made()
        gc.collect()
        self.assertEqual(gaitlab.run(scenario).outcome, "done")


class Checks(InFolder):
    def test_numbers_of_check(self):
        check = gaitlab.Scenario("hexapod", FAST).check()
        said, _ = called("check", "hexapod", "--set", "physics.engine=articulated", "--set", "duration=1")
        self.assertIn(f"{check.mass:.3f} kg", said)
        self.assertIn(f"records {check.rows:.0f} rows of {check.columns:.0f} columns", said)
        self.assertIn(f"{check.degrees_of_freedom} degrees of freedom", said)
        self.assertIn(f"{check.contacts} contact elements", said)
        self.assertAlmostEqual(sum(check.masses.values()), check.mass, places=9)  # the two sums have different orders
        self.assertEqual(list(check.ranges), gaitlab.Scenario("hexapod", FAST).joints)
        self.assertIn(f"takes about {check.seconds:.2g} s" if check.seconds >= 0.1 else "takes less than 0.1 s", said)
        self.assertEqual(check.fails, "")

    def test_legs(self):
        legs = gaitlab.Scenario("hexapod", FAST).legs
        self.assertEqual([leg.name for leg in legs], ["front_left", "front_right", "middle_left", "middle_right", "rear_left", "rear_right"])
        self.assertEqual([leg.side for leg in legs], [1, -1, 1, -1, 1, -1])
        self.assertEqual(legs[0].joints, ["m9/active", "m9/passive"])
        self.assertLess(legs[0].foot[2], legs[0].hip[2])
        other = {**FAST, "cpg": {"type": "sine", "amplitude": {"leg:*": 0.1}}}
        one = gaitlab.Scenario("hexapod", {**other, "robot.legs": {"probe": "m10/passive"}}).legs
        self.assertEqual([(leg.name, leg.joints) for leg in one], [("probe", ["m10/active", "m10/passive"])])
        with self.assertRaisesRegex(gaitlab.InputError, "the robot has no legs"):
            gaitlab.Scenario("hexapod", {**other, "robot.legs": "none"})

    def test_early_failure(self):
        with open("wild.yaml", "w") as file:
            file.write("gaitlab: 1\nrobot: {modules: mtran}\nduration: 1\n"
                       "cpg: {type: equations, model: {states: {phi: exp(700)*exp(700)}, output: phi}}\n")
        check = gaitlab.Scenario("wild.yaml").check()
        said, _ = called("check", "wild.yaml")
        self.assertRegex(check.fails, "^diverged at step ")
        self.assertIn(f"fails early: {check.fails}", said)

    def test_warnings_are_of_python(self):
        odd = {**FAST, "ground.friction": 30}
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            scenario = gaitlab.Scenario("caterpillar", odd)
        _, told = called("check", "caterpillar", "--set", "physics.engine=articulated", "--set", "duration=1", "--set",
                         "ground.friction=30", "--quiet")
        self.assertNotEqual(scenario.warnings, [])
        self.assertEqual([str(one.message) for one in heard], scenario.warnings)
        self.assertEqual(heard[0].category, gaitlab.Warning)
        self.assertEqual(os.path.basename(heard[0].filename), "test_scenario.py")
        self.assertEqual("\n".join(scenario.warnings), told.rstrip("\n"))

    def test_plugins_are_refused(self):
        with open("p.yaml", "w") as file:
            file.write(f"gaitlab: 1\nplugins: [{ROOT}/none.so]\nrobot: {{modules: mtran}}\nduration: 1\n")
        with self.assertRaises(gaitlab.InputError) as caught:
            gaitlab.Scenario("p.yaml", plugins="refuse")
        self.assertRegex(str(caught.exception), "none.so")


class Library(unittest.TestCase):
    def test_other_robots(self):
        """Scenarios whose modules are not M-TRAN's."""
        for name in ("dtto-caterpillar", "smores-drive", "rofi-snake"):
            run = gaitlab.run(gaitlab.Scenario(name, FAST))
            self.assertEqual(run.outcome, "done", name)


if __name__ == "__main__":
    unittest.main()
