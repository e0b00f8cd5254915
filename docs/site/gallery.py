"""The gallery of the site: every shipped scenario and every scenario of the library, run with engine articulated.

Each run has its page, its figure as the picture, and the lines of the verdict and of the gait as the program prints them.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

SETTINGS = ["--set", "physics.engine=articulated"]
HEAD = (
    "Gallery of gaits\n"
    "================\n\n"
    "Every shipped scenario and every scenario of the :doc:`library <docs/library>`, simulated with engine ``articulated``. A picture is the\n"
    "figure of the run, and leads to its page: the moving robot, every check and every curve, a single file of about 1 MB.\n"
    "``gaitlab run NAME --set physics.engine=articulated`` repeats a run.\n\n"
    ".. container:: gallery\n")
ENTRY = """
   .. container:: gait

      .. image:: pictures/{name}.svg
         :alt: figure of {name}
         :target: gallery/{name}.html

      .. rst-class:: name

      `{name} <gallery/{name}.html>`__

      {about}

      .. rst-class:: {word}

      {verdict}

      {gait}
"""


def scenarios(program):
    """Names and descriptions, as `gaitlab list scenario` prints them."""
    lines = subprocess.run([program, "list", "scenario"], check=True, capture_output=True, text=True).stdout.splitlines()
    found = [line.split(None, 1) for line in lines if line.startswith("  ")]
    return found or sys.exit("{} finds no scenarios".format(program))


def escaped(text):
    return re.sub(r"([\\*`|_])", r"\\\1", " ".join(text.split()))


def lines_of(summary, word):
    """The text behind a word of the summary, on one line."""
    found = re.search(r"^  {} +(.*(?:\n {{8,}}.*)*)".format(word), summary, re.M)
    return escaped(found.group(1)) if found else ""


def simulate(program, name, folder):
    """Runs a scenario into the folder; its summary. A run that fails has a page, too."""
    run = subprocess.run([program, "run", name, *SETTINGS, "--out", folder], capture_output=True, text=True)
    if run.returncode not in (0, 1) or not os.path.exists(os.path.join(folder, "report.html")):
        sys.exit("{}: {}".format(name, run.stderr))
    return run.stdout


def write(program, source, reports):
    """Writes the page gallery.rst and its pictures into `source`, and the pages of the runs into `reports`."""
    pictures = os.path.join(source, "pictures")
    os.makedirs(pictures)
    os.makedirs(reports)
    text = HEAD
    for name, about in scenarios(program):
        with tempfile.TemporaryDirectory(dir=os.path.dirname(source)) as work:
            folder = os.path.join(work, name)
            summary = simulate(program, name, folder)
            shutil.copyfile(os.path.join(folder, "report.html"), os.path.join(reports, name + ".html"))
            shutil.copyfile(os.path.join(folder, "figure.svg"), os.path.join(pictures, name + ".svg"))
            with open(os.path.join(folder, "verdict.json"), encoding="utf-8") as file:
                word = json.load(file)["verdict"].replace(" ", "-")
        text += ENTRY.format(name=name, about=escaped(about if about.endswith("?") else about + "."), word=word, verdict=lines_of(summary, "verdict"), gait=lines_of(summary, "gait"))
    with open(os.path.join(source, "gallery.rst"), "w", encoding="utf-8") as file:
        file.write(text)
