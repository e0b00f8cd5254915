"""Files that the pages load, made whole: Debian's furo leaves one file to a web server and another one to a bundler, and its style has
lost the rules of readers whose system is dark.

Nothing here needs node: a machine without it builds the same site.
"""
import base64
import os
import re
import sys

SHARED = "/usr/share"  # Debian's web servers give /usr/share/javascript the address /javascript
KATEX = "/usr/share/javascript/katex"
FONT = re.compile(r"url\((fonts/[\w-]+\.woff2)\) format\('woff2'\)(,url\([^)]+\) format\('[a-z]+'\))*")
IMPORT_CSS = re.compile(r"@import url\((/javascript/[^)]+)\);")
DARK = re.compile(r'@media not print \{\n  body\[data-theme="dark"\] \{[^@]*\} \}\n')
IMPORT_SCRIPT = re.compile(r'^import \w+ from "\./([\w-]+\.js)";$', re.M)


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def of_the_system(rules):
    """The rules of the dark theme, and after them the same for a page without a chosen theme where the system is dark."""
    of_auto = rules.replace('body[data-theme="dark"]', 'body:not([data-theme="light"])')
    return rules + "@media (prefers-color-scheme: dark) {\n" + of_auto + "}\n"


def replace(path, mark, text):
    """Writes the file anew with the text in the place of each match of the mark."""
    old = text_of(path)
    new = mark.sub(text, old)
    if new == old:
        sys.exit("{} has no '{}': this furo is another than Debian 12's".format(os.path.basename(path), mark.pattern))
    with open(path, "w", encoding="utf-8") as file:
        file.write(new)


def write_katex(folder):
    """KaTeX with its fonts in its style: of a file, a browser may read no font from another folder."""
    def embedded(font):
        with open(os.path.join(KATEX, font.group(1)), "rb") as file:
            return "url(data:font/woff2;base64,{}) format('woff2')".format(base64.b64encode(file.read()).decode())

    for name, text in (("katex.js", text_of(KATEX, "katex.min.js")), ("katex.css", FONT.sub(embedded, text_of(KATEX, "katex.min.css")))):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


def complete(site):
    """Writes KaTeX, and puts the files that furo's style and script import into these two."""
    write_katex(os.path.join(site, "_static"))
    styles, scripts = os.path.join(site, "_static", "styles"), os.path.join(site, "_static", "scripts")
    replace(os.path.join(styles, "furo.css"), IMPORT_CSS, lambda match: text_of(SHARED + match.group(1)))
    replace(os.path.join(styles, "furo.css"), DARK, lambda match: of_the_system(match.group()))
    # The imported file gives the page its global variable where no bundler asks for it, as the import names it.
    replace(os.path.join(scripts, "furo.js"), IMPORT_SCRIPT, lambda match: text_of(scripts, match.group(1)))
    for unused in ("scripts/gumshoe-patched.js", "searchtools.js", "language_data.js"):
        os.remove(os.path.join(site, "_static", unused))
