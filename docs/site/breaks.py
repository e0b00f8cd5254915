"""Breaks of long names in tables: after a dot, a stroke or an underscore, and between two words of a name.

Without them the longest name decides the width of a column. A break is <wbr>, so that a copied name is whole.
"""
import re

from docutils import nodes

NAME = re.compile(r"\S{13,}")  # a shorter one stays whole: it is about as wide as the word that heads its column
PLACE = re.compile(r"(?<=[./_:=|,\[({])(?=[A-Za-z_])|(?<=[a-z0-9])(?=[A-Z])")


def parts(text):
    return NAME.sub(lambda name: PLACE.sub("\0", name.group()), text).split("\0")


def add(app, doctree, docname):
    for entry in doctree.findall(nodes.entry):
        for text in list(entry.findall(nodes.Text)):
            pieces = parts(text.astext())
            if len(pieces) > 1 and not isinstance(text.parent, (nodes.math, nodes.raw)):
                new = [node for piece in pieces for node in (nodes.Text(piece), nodes.raw("", "<wbr>", format="html"))]
                text.parent.replace(text, new[:-1])


def setup(app):
    app.connect("doctree-resolved", add, priority=900)  # after the search has read the texts
