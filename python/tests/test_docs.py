"""The code of docs/python.md, as it stands."""
import contextlib
import io
import os
import re
import unittest

import numpy

import gaitlab

from common import ROOT, InFolder


class Page(InFolder):
    def test_blocks(self):
        with open(os.path.join(ROOT, "docs", "python.md")) as file:
            blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", file.read(), re.M)
        code = [re.sub(r"^    ", "", block, flags=re.M) for block in blocks if "gaitlab." in block]
        self.assertEqual(len(code), 6)
        study = next(re.sub(r"^    ", "", block, flags=re.M) for block in blocks if "gaitlab_study: 1" in block)
        with open("study.yaml", "w") as file:  # with four points, for a short test
            file.write(study.replace("scenarios/", f"{ROOT}/scenarios/").replace("cma", "random").replace("96", "4"))
        names = {"numpy": numpy}
        with contextlib.redirect_stdout(io.StringIO()) as said:
            for block in code:
                exec(compile(block, "docs/python.md", "exec"), names)
        verdict, best = said.getvalue().split("\n", 1)
        self.assertRegex(verdict, r"^[a-z ]+ \S+$")
        self.assertRegex(best, r"^-?0\.\d+\n$")
        self.assertEqual(len(names["table"]), 4)  # made by the last block
        self.assertEqual(names["run"].outcome, "done")


class Tutorial(InFolder):
    def test_the_loop_in_python(self):
        with open(os.path.join(ROOT, "docs", "tutorials", "close-the-loop.md")) as file:
            blocks = re.findall(r"^```(\w+)\n(.*?)^```$", file.read(), re.M | re.S)
        with open("balance.yaml", "w") as file:
            file.write(next(block for language, block in blocks if language == "yaml" and "gaitlab: 1" in block))
        names = {"numpy": numpy, "gaitlab": gaitlab}
        with contextlib.redirect_stdout(io.StringIO()) as said:
            exec(compile(next(block for language, block in blocks if language == "python"), "close-the-loop.md", "exec"), names)
        envs = names["envs"]
        self.assertEqual(list(envs.ended), [""] * 8, said.getvalue())  # it stands after 3 s
        envs.reset()
        for _ in range(300):
            if all(envs.ended):
                break
            envs.step(numpy.zeros((8, 2)))
        self.assertEqual(list(envs.ended), ["stopped"] * 8)  # without the reflex it falls


if __name__ == "__main__":
    unittest.main()
