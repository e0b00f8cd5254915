"""The code of docs/python.md, as it stands."""
import contextlib
import io
import os
import re
import unittest

import numpy

from common import ROOT


class Page(unittest.TestCase):
    def test_blocks(self):
        with open(os.path.join(ROOT, "docs", "python.md")) as file:
            blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", file.read(), re.M)
        code = [re.sub(r"^    ", "", block, flags=re.M) for block in blocks if "gaitlab." in block]
        self.assertEqual(len(code), 2)
        names = {"numpy": numpy}
        with contextlib.redirect_stdout(io.StringIO()) as said:
            for block in code:
                exec(compile(block, "docs/python.md", "exec"), names)
        self.assertRegex(said.getvalue(), r"^[a-z ]+ \S+\n$")
        self.assertEqual(len(names["table"]), 2)
        self.assertEqual(names["run"].outcome, "done")


if __name__ == "__main__":
    unittest.main()
