"""Sources of the site: the project's pages, at their places, with links that stay within the site.

README.md becomes the first page, with the table of contents. A link to a file that is no page leads to a page with the text of the file, and a link
to a folder to a list of its files. A link whose text is the name of a page shows the title of that page.
"""
import json
import os
import re
import shutil
import sys

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LINK = re.compile(r"(?:\[([\w./-]+\.md)\]|\])\(([^)\s]+)\)")  # text that is the name of a page, or the end of any text; target
CODE = re.compile(r"`[^`\n]+`")
MOVED = {"README.md": "index.md", "docs/decisions": "docs/decisions.md"}
PICTURES = (".svg", ".png")
LEXERS = {".yaml": "yaml", ".py": "python", ".cpp": "cpp", ".h": "cpp", ".sh": "bash", ".dat": "text"}

# The pages in the order of their use. The code below adds the page of decisions.
CONTENTS = (
    ("First gaits", (
        ("1. Is my gait feasible?", "docs/tutorials/feasible.md"), ("2. Your own module", "docs/modules.md"),
        ("3. Tune a gait", "docs/tutorials/tune-a-gait.md"), ("4. In CI", "docs/ci.md"), ("5. In Python", "docs/tutorials/optuna.md"),
        ("The Python package", "docs/python.md"), ("Notebook", "docs/tutorials/python.ipynb.md"))),
    ("Help", (
        ("Common errors", "docs/errors.md"), ("Glossary", "docs/glossary.md"), ("Gallery of gaits", "gallery.rst"),
        ("Overview", "docs/overview.md"), ("Commands", "docs/commands.md"), ("All pages", "docs/README.md"))),
    ("More", (
        ("Remedies", "docs/remedy.md"), ("Library of modules", "docs/library.md"), ("Studies", "docs/studies.md"),
        ("The page of a run", "docs/report.md"), ("The real robot", "docs/real-robot.md"),
        ("From a URDF file", "docs/tutorials/dog.md"), ("From a data sheet", "docs/tutorials/motors.md"), ("From logs", "docs/tutorials/your-servo.md"),
        ("Write a CPG", "docs/tutorials/write-a-cpg.md"), ("Close the loop", "docs/tutorials/close-the-loop.md"), ("In MuJoCo", "docs/mujoco.md"), ("Files of others", "docs/trust.md"))),
    ("Reference", (
        ("Scenario", "docs/reference/scenario.md"), ("Module", "docs/reference/module.md"), ("Plugins", "docs/reference/plugins.md"),
        ("Verdict", "docs/reference/verdict.md"), ("Study", "docs/reference/study.md"), ("Figure", "docs/reference/figure.md"))),
    ("Conventions", (
        ("Numbers", "docs/numbers.md"), ("Files", "docs/files.md"), ("Equations", "docs/equations.md"), ("The paper's figures", "docs/paper.md"),
        ("Validation", "docs/validation.md"), ("Against measurements", "docs/measured.md"),
        ("Determinism", "docs/determinism.md"), ("Benchmarks", "docs/benchmarks.md"))),
    ("Project", (
        ("Changes", "CHANGELOG.md"), ("Contributing", "CONTRIBUTING.md"), ("Tests and tools", "tests/README.md"),
        ("Architecture", "docs/architecture.md"), ("Decisions", "docs/decisions.md"))),
)

COMMAND = re.compile(r"(\$ |gaitlab |\./lab |cmake (-|\.)|ctest |export |mpirun |python3 |tests/\S+ |npm |cd |git |[A-Z_]+=\S+ )")
PLACEHOLDER = re.compile(r"\[-|SCENARIO|\|[A-Z]")
SECTION = re.compile(r'[\w."*/-]+:( |$)')


def language(text):
    """The language of a literal block, for its colours and its button: none for output, equations and drawings."""
    line = next((line for line in text.splitlines() if line.strip() and not line.startswith("#")), "")
    if COMMAND.match(line):
        return "none" if PLACEHOLDER.search(line) else "console" if line.startswith("$ ") else "bash"
    if re.match(r"(import|from) \w|@\w+\.", line):
        return "python"
    if re.match(r"(cmake_minimum_required|gaitlab_add_)", line):
        return "cmake"
    if SECTION.match(line):
        try:
            return "yaml" if isinstance(yaml.safe_load(text), dict) else "none"
        except yaml.YAMLError:
            return "none"
    return "none"


def title(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return next((line[2:].strip() for line in file if line.startswith("# ")), path)


def version():
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        return re.search(r"^project\(\w+ VERSION ([\d.]+)", file.read(), re.M).group(1)


def repository():
    """The address that a link of README.md with the word repository has; None without such a link."""
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        found = re.search(r"\[[^\]]*\brepository\b[^\]]*\]\((https?://[^)\s]+)\)", file.read())
    return found and found.group(1)


def listed():
    """Paths of the pages of the project."""
    found = ["CHANGELOG.md", "CONTRIBUTING.md", "README.md", "tests/README.md"]
    for folder, folders, names in os.walk(os.path.join(ROOT, "docs")):
        folders[:] = sorted(name for name in folders if name != "site")
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in sorted(names) if name.endswith(".md")]
    return found


class Sources:
    """Writes the sources into a folder; `files` has the paths of files and folders that links lead to."""

    def __init__(self, folder):
        self.folder = folder
        self.pages = set(listed())
        self.files = set()

    def write(self, path, text):
        path = os.path.join(self.folder, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def place(self, page, target):
        """Where the link of a page leads to within the site, seen from that page."""
        path, anchor = re.fullmatch(r"([^#]*)(.*)", target).groups()
        if not path or re.match(r"[a-z]+:", target):
            return target
        whole = os.path.normpath(os.path.join(os.path.dirname(page), path))
        if whole.endswith(PICTURES) and os.path.exists(os.path.join(ROOT, whole)):
            os.makedirs(os.path.join(self.folder, os.path.dirname(whole)), exist_ok=True)
            shutil.copyfile(os.path.join(ROOT, whole), os.path.join(self.folder, whole))
        elif whole in MOVED:
            whole = MOVED[whole]
        elif whole.endswith(".ipynb"):
            whole += ".md"  # write_notebook
        elif not os.path.exists(os.path.join(ROOT, whole)):
            sys.exit("{}: {} does not exist".format(page, target))
        elif whole not in self.pages:
            self.files.add(whole)
            whole = os.path.join("files", whole + ("/index.md" if os.path.isdir(os.path.join(ROOT, whole)) else ".md"))
        return os.path.relpath(whole, os.path.dirname(page) or ".") + anchor

    def linked(self, page, text):
        """The text of a page with its links moved; code keeps its text."""
        parts, end = [], 0
        for code in CODE.finditer(text):
            if "](" in code.group():
                parts += [self.moved(page, text[end:code.start()]), code.group()]
                end = code.end()
        return "".join(parts) + self.moved(page, text[end:])

    def moved(self, page, text):
        return LINK.sub(lambda link: "{}({})".format(self.text(page, *link.groups()), self.place(page, link.group(2))), text)

    def text(self, page, name, target):
        """Text of a link: the title of the page in the place of its name."""
        whole = os.path.normpath(os.path.join(os.path.dirname(page), target))
        return "]" if name is None else "[{}]".format(title(whole) if whole in self.pages else name)

    def write_pages(self):
        for page in sorted(self.pages - {"README.md"}):
            with open(os.path.join(ROOT, page), encoding="utf-8") as file:
                self.write(page, self.linked(page, file.read().replace("\n```math\n", "\n```{math}\n")))
        decisions = sorted(page for page in self.pages if page.startswith("docs/decisions/"))
        self.write("docs/decisions.md", "# Decisions\n\nOne page for each decision, with its reasons and the alternatives.\n\n"
                   + toctree([os.path.relpath(page, "docs") for page in decisions], maxdepth=1))

    def write_first(self, gallery):
        with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
            text = self.linked("README.md", file.read())
        for caption, entries in CONTENTS:
            lines = ["{} <{}>".format(*entry) for entry in entries if gallery or entry[1] != "gallery.rst"]
            text += "\n" + toctree(lines, caption=caption, hidden="")
        self.write("index.md", text)

    def write_notebook(self, path):
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            cells = json.load(file)["cells"]
        text = ["".join(cell["source"]) for cell in cells]
        text = [one if cell["cell_type"] == "markdown" else fenced(one, "python") for one, cell in zip(text, cells)]
        self.write(path + ".md", self.linked(path, "\n\n".join(text)) + "\n\nThe file is `{}`, for Jupyter.\n".format(path))

    def write_files(self):
        written = set()
        while self.files - written:
            path = sorted(self.files - written)[0]
            written.add(path)
            whole = os.path.join(ROOT, path)
            head = "---\norphan: true\n---\n# {}\n\n".format(path)
            if os.path.isdir(whole):
                names = sorted(name for name in os.listdir(whole) if os.path.isfile(os.path.join(whole, name)))
                self.files |= {os.path.join(path, name) for name in names}
                self.write("files/{}/index.md".format(path), head + "".join("- [{0}]({0}.md)\n".format(name) for name in names))
            else:
                with open(whole, encoding="utf-8") as file:
                    self.write("files/{}.md".format(path), head + fenced(file.read(), LEXERS.get(os.path.splitext(path)[1], "text")))


def fenced(text, lexer):
    return "````{}\n{}\n````\n".format(lexer, text.rstrip("\n"))


def toctree(lines, **options):
    return "```{toctree}\n" + "".join(":{}: {}\n".format(*option).replace(": \n", ":\n") for option in options.items()) \
        + "\n" + "\n".join(lines) + "\n```\n"


def write(folder, gallery):
    """Writes the sources of the site into the folder; `gallery`: there is a page gallery.rst."""
    sources = Sources(folder)
    sources.write_pages()
    sources.write_notebook("docs/tutorials/python.ipynb")
    sources.write_first(gallery)
    sources.write_files()
