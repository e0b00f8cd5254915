"""Searches of the program whose points Python evaluates."""
import json
import subprocess
import sys
import unittest

import gaitlab
import pandas

from common import PROGRAM, ROOT, InFolder

STUDY = f"""gaitlab_study: 1
scenario: {ROOT}/scenarios/pendulum.yaml
set: [physics.engine=articulated, duration=0.1]
parameters:
  cpg.amplitude: {{low: 0.1, high: 1.2}}
  cpg.frequency: {{low: 0.25, high: 2, scale: log}}
objective: {{minimize: speed}}
method: {{type: cma}}
budget: {{runs: 200}}
"""


def bowl(points):
    """A function with its minimum of 0 at an amplitude of 0.4 and a frequency of 1."""
    return (points["cpg.amplitude"] - 0.4) ** 2 + (points["cpg.frequency"] - 1) ** 2


class Search(InFolder):
    def setUp(self):
        super().setUp()
        with open("study.yaml", "w") as file:
            file.write(STUDY)

    def test_finds_a_minimum(self):
        with gaitlab.Search("study.yaml", "found") as search:
            while len(points := search.ask()):
                search.tell(points.assign(objective=bowl(points)))
        study = gaitlab.study("found")
        self.assertLess(study.best["objective.1"].min(), 1e-3)  # seeds 1 to 5: at most 4e-5; 200 points at random: a median of 2.5e-3
        self.assertEqual(len(study.points), 200)

    def test_order_and_pieces_do_not_matter(self):
        tables = []
        for n in (None, 3):
            with gaitlab.Search("study.yaml", f"in-{n}", runs=30, seed=5) as search:
                while len(points := search.ask(n)):
                    told = points.assign(objective=bowl(points)).sample(frac=1, random_state=1)
                    search.tell(told[:1])
                    search.tell(told[1:])
            tables.append(gaitlab.study(f"in-{n}").points)
        pandas.testing.assert_frame_equal(*tables)

    def test_goes_on(self):
        def some(folder, budget):
            with gaitlab.Search("study.yaml", folder, runs=30) as search:
                while budget > 0 and len(points := search.ask(4)):
                    search.tell(points.assign(objective=bowl(points)))
                    budget -= 4

        some("two", 9)
        some("two", 99)
        some("one", 99)
        pandas.testing.assert_frame_equal(gaitlab.study("two").points, gaitlab.study("one").points)

    def test_failed_points_and_limits(self):
        with gaitlab.Search("study.yaml", "failed", runs=16) as search:
            while len(points := search.ask()):
                told = points.assign(objective=bowl(points), outcome="done", message="", violation=0.0)
                told.loc[told["cpg.amplitude"] > 0.8, ["outcome", "message"]] = ["broken", "a leg"]
                told.loc[told["cpg.frequency"] > 1, "violation"] = 0.5
                search.tell(told)
        rows = gaitlab.study("failed").points
        self.assertTrue((rows["cpg.amplitude"][rows["outcome"] == "broken"] > 0.8).all())
        self.assertEqual(set(rows["outcome"]), {"broken", "done"})
        self.assertTrue((rows["violation"][(rows["outcome"] == "done") & (rows["cpg.frequency"] > 1)] == 0.5).all())

    def test_cells_that_pandas_fills(self):
        """An outcome in some rows only: the cells of the others are NaN, None or empty, and their points are done."""
        with gaitlab.Search("study.yaml", "filled", runs=16) as search:
            points = search.ask()
            told = points.assign(objective=1.0, message="slipped")
            for k, cell in enumerate([float("nan"), None, "", pandas.NaT, "done", pandas.NA, "broken"]):
                told.loc[k, "outcome"] = cell
            told["outcome"] = told["outcome"].astype(object)
            told.loc[6, "message"] = float("nan")
            told.loc[7:, "verdict"] = "infeasible"
            search.tell(told)
        rows = gaitlab.study("filled").points
        self.assertEqual(list(rows["outcome"][:len(points)]), ["done"] * 6 + ["broken"] + ["done"] * (len(points) - 7))
        self.assertEqual(rows["message"][6], "")
        self.assertEqual([*rows["violation"][:6], rows["violation"][7]], [0] * 6 + [0.5])

    def test_points_that_were_not_run_stay_open(self):
        with gaitlab.Search("study.yaml", "interrupted", runs=16) as search:
            points = search.ask()
            told = points.assign(objective=1.0, outcome="done")
            told.loc[told.index[2:], "outcome"] = "not run"
            search.tell(told)
            with self.assertRaisesRegex(gaitlab.RunError, f"{len(points) - 2} points of this generation have no result.*points 2, 3"):
                search.ask()
            search.tell(points[2:].assign(objective=2.0))
            search.ask()
        rows = gaitlab.study("interrupted").points
        self.assertEqual(set(rows["outcome"]), {"done"})
        self.assertEqual(list(rows["objective.1"][:4]), [1, 1, 2, 2])

    def test_refused_words_record_nothing(self):
        with gaitlab.Search("study.yaml", "words", runs=16) as search:
            points = search.ask()
            for column, value, said in (
                ("outcome", 3.5, "outcome of point 1 is 3.5; expected a text"),
                ("outcome", True, "outcome of point 1 is True; expected a text"),
                ("outcome", ["done"], "outcome of point 1 is .*expected a text"),
                ("verdict", "good", "verdict of point 1 is 'good'; expected 'feasible', 'infeasible' or 'not judged'"),
                ("verdict", 1.0, "verdict of point 1 is 1.0; expected a text"),
            ):
                told = points.assign(objective=1.0)
                told[column] = pandas.Series([value if number == 1 else None for number in told.index], index=told.index, dtype=object)
                with self.assertRaisesRegex(ValueError, said):
                    search.tell(told)
        self.assertEqual(len(gaitlab.study("words").points), 0)

    def test_told_tables_cost_their_length(self):
        """Counts of function calls, which depend on no clock: twice as many rows need at most twice as many calls, and a
        few."""
        def calls(folder, runs):
            with gaitlab.Search("many.yaml", folder, runs=runs) as search:
                told, count = search.ask().assign(objective=1.0), []
                sys.setprofile(lambda frame, event, _: count.append(1) if event == "call" else None)
                try:
                    search.tell(told)
                finally:
                    sys.setprofile(None)
            return len(count)

        with open("many.yaml", "w") as file:
            file.write(STUDY.replace("cma", "random"))
        few, many = calls("few", 250), calls("many", 500)
        self.assertLess(many, 2 * few + 100)

    def test_a_program_that_answers_each_question_at_once(self):
        """Neither pipe has room for all lines."""
        with open("many.yaml", "w") as file:
            file.write(STUDY.replace("cma", "random").replace("200", "3000"))
        command = [PROGRAM, "optimize", "many.yaml", "--ask", "--out", "many", "--quiet"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as child:
            for line in child.stdout:
                if line.strip():
                    told = {"id": json.loads(line)["id"], "objective": 1, "message": 50 * "x"}
                    print(json.dumps(told), file=child.stdin, flush=True)
                else:
                    child.stdin.close()
        self.assertEqual(child.returncode, 0)
        self.assertEqual(len(gaitlab.study("many").points), 3000)

    def test_violation_follows_from_the_verdict(self):
        with gaitlab.Search("study.yaml", "judged", runs=16) as search:
            points = search.ask()
            verdicts = ["feasible", "infeasible", "not judged", "infeasible"] * 4
            search.tell(points.assign(objective=1.0, verdict=verdicts, margin=[0.1, -0.7, 0.2, -0.1] * 4))
        self.assertEqual(list(gaitlab.study("judged").points["violation"][:4]), [0, 0.7, 0.5, 0.5])

    def test_several_objectives(self):
        with open("two.yaml", "w") as file:
            file.write(STUDY.replace("objective: {minimize: speed}", "objective: [{minimize: speed}, {maximize: distance}]").replace(
                "cma", "nsga2, population: 8"))
        both = {"objective.1": 1.0, "objective.2": 2.0}
        with gaitlab.Search("two.yaml", "two", runs=16) as search:
            points = search.ask()
            for told, said in (({"objective": 1.0}, "no column objective.1; expected objective.1 to objective.2$"),
                               ({"objective.1": 1.0}, "no column objective.2; expected objective.1 to objective.2$"),
                               ({**both, "objective.3": 3.0}, "a column objective.3; expected objective.1 to objective.2, as the study has 2")):
                with self.assertRaisesRegex(ValueError, said):
                    search.tell(points.assign(**told))
            search.tell(points.assign(**both, huge=10**400))
        self.assertEqual(list(gaitlab.study("two").points["objective.2"][:2]), [2, 2])

    def test_errors(self):
        with gaitlab.Search("study.yaml", "errors", runs=16) as search:
            points = search.ask()
            with self.assertRaisesRegex(gaitlab.RunError, "points of this generation have no result"):
                search.ask()
            with self.assertRaisesRegex(ValueError, "no row has an objective; a column assigned"):
                search.tell(points.assign(objective=float("nan")))
            for column, value, said in (
                ("objective", float("inf"), "objective of point 0 is inf; expected a number"),
                ("objective", 10**400, "objective of point 0 is 1000000.*; expected a number"),
                ("violation", 10**400, "violation of point 0 is 1000000.*; expected a number"),
                ("objective", "high", "objective of point 0 is 'high'; expected a number"),
                ("violation", -1.0, "violation of point 0 is -1.0; expected 0 or more"),
            ):
                with self.assertRaisesRegex(ValueError, said):
                    search.tell(points.assign(**{"objective": 1.0, column: value}))
            with self.assertRaisesRegex(ValueError, "point 0 is not open"):
                search.tell(pandas.concat([points[:1], points[:1]]).assign(objective=1.0))
            with self.assertRaisesRegex(TypeError, "rows must be a DataFrame"):
                search.tell([{"objective": 1}])
            with self.assertRaisesRegex(ValueError, "the table has no column objective; expected objective, or objective.1$"):
                search.tell(points)
            for columns, said in (
                (["objective.2"], "has a column objective.2; expected objective, or objective.1, as the study has 1"),
                (["objective.1", "objective.2"], "has a column objective.2; expected objective, or objective.1, as the study has 1"),
                (["objective", "objective.3"], "has a column objective.3; expected objective"),
            ):
                with self.assertRaisesRegex(ValueError, said):
                    search.tell(points.assign(**dict.fromkeys(columns, 1.0)))
            with self.assertRaisesRegex(ValueError, "point 99 is not open"):
                search.tell(points.assign(objective=1.0).set_index(points.index + 99))
        with self.assertRaisesRegex(gaitlab.RunError, "the search is closed"):
            search.ask()
        with self.assertRaisesRegex(gaitlab.InputError, "nosuch.yaml.*No such file") as caught:
            with open("absent.yaml", "w") as file:
                file.write(STUDY.replace("pendulum.yaml", "nosuch.yaml"))
            with gaitlab.Search("absent.yaml") as search:
                search.ask()
        self.assertTrue(caught.exception.problems[0][0].endswith("absent.yaml"))
        for file in ("nothing.yaml", "study.yaml\0"):
            with self.assertRaisesRegex(ValueError, "nothing.yaml.*No such file|has a null character"):
                gaitlab.Search(file)
        with self.assertRaisesRegex(gaitlab.InputError, "replicates"):
            with open("three.yaml", "w") as file:
                file.write(STUDY + "replicates: {count: 3}\n")
            with gaitlab.Search("three.yaml", "three") as search:
                search.ask()


if __name__ == "__main__":
    unittest.main()
