"""Sphinx's settings of the site. The sources are those that pages.py writes, and not docs/ itself."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import breaks  # noqa: E402
import equations  # noqa: E402
import pages  # noqa: E402
import search  # noqa: E402

project = "gaitlab"
version = pages.version()
html_context = {"repository": pages.repository()}
html_title = "gaitlab"
extensions = ["myst_parser", "sphinx_copybutton"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
root_doc = "index"
myst_heading_anchors = 6
smartquotes = False  # "--" in a sentence is an option
highlight_language = "none"  # of blocks without a language: kinds_of_blocks finds it

html_math_renderer = "katex"
html_theme = "furo"
templates_path = [os.path.join(os.path.dirname(os.path.abspath(__file__)), "templates")]
html_sidebars = {"**": ["sidebar/brand.html", "project.html", "sidebar/search.html", "sidebar/scroll-start.html", "sidebar/navigation.html", "sidebar/scroll-end.html"]}
html_static_path = [os.path.join(os.path.dirname(os.path.abspath(__file__)), "static")]
html_css_files = ["site.css"]
html_show_sourcelink = False
html_copy_source = False
html_use_index = False
html_show_copyright = False
copybutton_selector = "div.copied pre"  # commands and files, neither output nor equations
copybutton_prompt_text = "$ "


def kinds_of_blocks(app, doctree):
    """Gives literal blocks without a language that of their text, and those that readers copy the class `copied`."""
    for block in doctree.findall(lambda node: node.tagname == "literal_block"):
        if block.get("language", "none") == "none":
            block["language"] = pages.language(block.astext())
        if block["language"] not in ("none", "text"):
            block["classes"].append("copied")


def setup(app):
    app.connect("doctree-read", kinds_of_blocks)
    breaks.setup(app)
    equations.setup(app)
    search.setup(app)
    return {"parallel_read_safe": True, "parallel_write_safe": False}
