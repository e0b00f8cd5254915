"""The texts that the search looks into, and its page. A browser reads no other page of a site without a server: the texts are a script.

static/search.js finds and sorts; here each page gets its group, so that pages for users stand before decisions and changes.
"""
import json
import os

import pages

# Worth of a hit by the group of its page in pages.CONTENTS: chosen; conventions count less than half as much as the reference, which users read. Pages of
# worth 0, on the project's history, stand behind all others.
WORTH = {"Start": 1.5, "First gaits": 1.5, "Help": 1.5, "More": 1.2, "Reference": 1.2, "Conventions": 0.5}


def group_of(docname):
    """Name of the group of a page."""
    if docname == "index":
        return "Start"
    for caption, entries in pages.CONTENTS:
        if any(os.path.splitext(path)[0] == docname for _, path in entries):
            return caption
    return "Decision" if docname.startswith("docs/decisions/") else "File"


def terms(parts):
    """Texts of the first cells of rows: the keys of a reference, the words of a glossary."""
    rows = [row for part in parts for row in part.findall(lambda inner: inner.tagname == "row") if row.parent.tagname == "tbody"]
    return " ".join(row[0].astext() for row in rows)


def sections(node):
    """[anchor, heading, text, terms] of each section of a page, and of each gait of the gallery; the text excludes that of sections within."""
    for section in node.findall(lambda part: part.tagname == "section"):
        parts = [part for part in section.children if part.tagname not in ("section", "title", "toctree", "compound", "math_block")]
        title = next((part.astext() for part in section.children if part.tagname == "title"), "")
        yield [section["ids"][0], title, " ".join(" ".join(part.astext() for part in parts).split()), terms(parts)]
    for gait in node.findall(lambda part: part.tagname == "container" and "gait" in part["classes"]):
        yield [gait["ids"][0], gait["ids"][0], " ".join(gait.astext().split()), ""]


def collect(app, doctree, docname):
    found = list(sections(doctree))
    if found:
        group = group_of(docname)
        texts = found if not docname.startswith("files/") else [found[0][:2] + ["", ""]]  # files of the code by name only
        app.site_texts[docname] = {"page": app.builder.get_target_uri(docname), "title": found[0][1], "group": group, "worth": WORTH.get(group, 0), "sections": texts}


def write(app, failed):
    if failed is None:
        texts = [app.site_texts[name] for name in sorted(app.site_texts)]
        with open(os.path.join(app.outdir, "_static", "search_texts.js"), "w", encoding="utf-8") as file:
            file.write("const searchTexts = " + json.dumps(texts, ensure_ascii=False, separators=(",", ":")) + ";\n")


def begin(app):
    app.builder.search = False  # Sphinx's own: from a file it has no excerpts, and its errors fill the console
    app.site_texts = {}


def setup(app):
    app.connect("builder-inited", begin)
    app.connect("doctree-resolved", collect)
    app.connect("html-collect-pages", lambda _: [("search", {"title": "Search"}, "search.html")])
    app.connect("build-finished", write)
