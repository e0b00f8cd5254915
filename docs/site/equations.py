"""Equations of the pages: KaTeX sets them in the browser, on the pages that have some. Without JavaScript a page shows their TeX."""
from docutils import nodes


def visit(tag):
    def write(translator, node):
        translator.body.append(translator.starttag(node, tag, "", CLASS="math") + translator.encode(node.astext()) + "</" + tag + ">")
        raise nodes.SkipNode

    return write


def load(app, name, template, context, doctree):
    if doctree is not None and any(doctree.findall(lambda node: isinstance(node, (nodes.math, nodes.math_block)))):
        app.add_css_file("katex.css")
        for script in ("katex.js", "equations.js"):
            app.add_js_file(script, defer="defer")


def setup(app):
    app.add_html_math_renderer("katex", (visit("span"), None), (visit("div"), None))
    app.connect("html-page-context", load)
