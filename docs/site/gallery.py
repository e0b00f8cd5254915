"""The gallery of the site: every shipped scenario and every scenario of the library, run with engine articulated.

Each run has its page, as the picture side views of its robot (`gaitlab figure`), and the lines of the verdict and of the gait as the
program prints them.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

SETTINGS = ["--set", "physics.engine=articulated"]
HEAD = (
    "Gallery of gaits\n"
    "================\n\n"
    "Every shipped scenario and every scenario of the :doc:`library <docs/library>`, simulated with engine ``articulated``. A picture shows\n"
    "the robot at instants of its last period, and leads to the page of the run: the moving robot, every check and every curve, a single file of\n"
    "about 1 MB.\n"
    "``gaitlab run NAME --set physics.engine=articulated`` repeats a run.\n\n"
    ".. container:: gallery\n")
WIDTH, HIGHEST = 84, 63  # mm of a picture: as wide as a card, with the font of a printed column, and not higher than 3/4 of it
RECIPE = """gaitlab: 1
size: {width}
runs: {{run: {run}}}
letters: false
panels: [{{kind: views, legend: false, times: {times}}}]
"""
ENTRY = """
   .. container:: gait
      :name: {name}

      .. image:: pictures/{name}.svg
         :alt: side views of {name}
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


def in_folder(page, folder):
    """The page, whose commands name the folder of the run that the command of HEAD repeats."""
    head = '<html lang="en"'
    if page.count(head) != 1:
        sys.exit("{}: the page has not one {}".format(folder, head))
    return page.replace(head, head + ' data-folder="{}"'.format(folder))


def draw(program, folder, target):
    """Side views at up to three instants of the last period of a run, or of its last two seconds: as many as one picture has room for."""
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    end, span = summary["simulated"], summary["limit_cycle"].get("period") or 2
    for views in (3, 2, 1):
        recipe = folder + ".yaml"
        with open(recipe, "w", encoding="utf-8") as file:
            file.write(RECIPE.format(width=WIDTH, run=folder, times=[round(max(0, end - span * (1 - k / views)), 3) for k in range(views)]))
        said = subprocess.run([program, "figure", recipe, "--out", target], check=True, capture_output=True, text=True).stdout
        if float(re.search(r"x ([\d.]+) mm", said).group(1)) <= HIGHEST:
            return


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
            with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
                runs = "runs/" + json.load(file)["name"]
            with open(os.path.join(folder, "report.html"), encoding="utf-8") as file:
                page = file.read()
            with open(os.path.join(reports, name + ".html"), "w", encoding="utf-8") as file:
                file.write(in_folder(page, runs))
            draw(program, folder, os.path.join(pictures, name + ".svg"))
            with open(os.path.join(folder, "verdict.json"), encoding="utf-8") as file:
                word = json.load(file)["verdict"].replace(" ", "-")
        text += ENTRY.format(name=name, about=escaped(about if about.endswith("?") else about + "."), word=word, verdict=lines_of(summary, "verdict"), gait=lines_of(summary, "gait"))
    with open(os.path.join(source, "gallery.rst"), "w", encoding="utf-8") as file:
        file.write(text)
