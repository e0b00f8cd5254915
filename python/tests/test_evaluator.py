"""Points of a study file through the child `gaitlab evaluate`, and journals of studies."""
import os
import unittest

import gaitlab

from common import ROOT, InFolder

STUDY = f"""gaitlab_study: 1
scenario: {ROOT}/scenarios/caterpillar.yaml
set: [physics.engine=articulated, duration=1]
parameters:
  cpg.frequency: {{low: 0.25, high: 1}}
  cpg.amplitude: {{low: 0.1, high: 1.2}}
objective: {{maximize: speed}}
"""


class Evaluate(InFolder):
    def setUp(self):
        super().setUp()
        with open("study.yaml", "w") as file:
            file.write(STUDY)

    def test_points(self):
        points = [{"cpg.frequency": 0.5, "cpg.amplitude": 0.1 * k} for k in range(1, 5)]
        with gaitlab.Evaluator("study.yaml", "asked") as study:
            first = study.evaluate(points[:3])
            second = study.evaluate([points[0], points[3], {"cpg.frequency": 9, "cpg.amplitude": 0.5}])
        self.assertEqual(list(first["outcome"]), ["done"] * 3)
        self.assertEqual(list(first["objective.1"]), list(first["speed"]))
        self.assertEqual(list(second["outcome"]), ["done", "done", "refused"])
        self.assertEqual(second["run"][0], first["run"][0])
        table = gaitlab.rollouts(gaitlab.Scenario("caterpillar", {"physics.engine": "articulated", "duration": 1}), points)
        self.assertEqual(list(first["speed"]), list(table["speed"][:3]))
        journal = gaitlab.study("asked")
        self.assertEqual(list(journal.points["speed"]), list(table["speed"]))
        self.assertIn("speed", list(journal.quantities["name"]))
        self.assertLessEqual(len(journal.best), 4)
        self.assertTrue(os.path.isfile("asked/table.csv"))

    def test_errors(self):
        with self.assertRaisesRegex(gaitlab.InputError, "nowhere.yaml"):
            with gaitlab.Evaluator("nowhere.yaml") as study:
                study.evaluate([{}])
        with self.assertRaisesRegex(gaitlab.InputError, "cpg.amplitude"):
            with gaitlab.Evaluator("study.yaml", "asked") as study:
                study.evaluate([{"cpg.frequency": 0.5}])
        with gaitlab.Evaluator("study.yaml", "empty") as study:
            for value in (float("nan"), None, float("inf")):
                with self.assertRaisesRegex(ValueError, "cpg.amplitude of row 0 is .*expected a value of the parameter"):
                    study.evaluate([{"cpg.frequency": 0.5, "cpg.amplitude": value}])
            self.assertEqual(list(study.evaluate([{"cpg.frequency": 0.5, "cpg.amplitude": 0.5}])["outcome"]), ["done"])
        with self.assertRaises(FileNotFoundError):
            gaitlab.study("nowhere")

    def test_left_by_an_exception(self):
        with self.assertRaises(LookupError):
            with gaitlab.Evaluator("study.yaml", "asked"):
                raise LookupError


if __name__ == "__main__":
    unittest.main()
