#!/usr/bin/env python3
"""Checks a built site: every link has its file and its anchor, no page loads anything from elsewhere, and its styles and
scripts have what they load.

    links.py SITE          prints the faults; exit code 1 if there is one

Pages of runs, in the folder gallery, are not read: they are single files of the program.
"""
import html.parser
import os
import re
import sys
import urllib.parse

LOADS = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src", "video": "src", "object": "data"}


class Page(html.parser.HTMLParser):
    """Anchors of a page, and its links: (line, target, whether it is loaded)."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = {"", "top"}, []
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        if tag == "a" and attributes.get("href") is not None:
            self.links.append((self.getpos()[0], attributes["href"], False))
        elif attributes.get(LOADS.get(tag)):
            self.links.append((self.getpos()[0], attributes[LOADS[tag]], True))


STYLE_LOADS = re.compile(r"url\(\s*[\"']?([^\"')]+)")
SCRIPT_IMPORT = re.compile(r"^import\b.*", re.M)


def faults(site):
    yield from faults_of_pages(site)
    for folder, _, names in os.walk(os.path.join(site, "_static")):
        for path in sorted(os.path.join(folder, name) for name in names if name.endswith((".css", ".js"))):
            with open(path, encoding="utf-8") as file:
                text = file.read()
            # The pages load scripts as such, and not as modules: none can import.
            pattern = STYLE_LOADS if path.endswith(".css") else SCRIPT_IMPORT
            for load in pattern.finditer(text):
                target = load.group(load.lastindex or 0)
                if not target.startswith("data:") and not os.path.isfile(os.path.join(folder, target)):
                    yield "{}:{}: {} does not exist".format(os.path.relpath(path, site), text.count("\n", 0, load.start()) + 1, target)


def faults_of_pages(site):
    pages = {}
    for folder, folders, names in os.walk(site):
        folders[:] = [name for name in folders if os.path.join(folder, name) != os.path.join(site, "gallery")]
        pages.update((os.path.join(folder, name), None) for name in names if name.endswith(".html"))
    pages = {path: Page(path) for path in sorted(pages)}
    for path, page in pages.items():
        for line, target, loaded in page.links:
            url = urllib.parse.urlsplit(target)
            if url.scheme or url.netloc:
                if loaded and url.scheme != "data":
                    yield "{}:{}: loads {} from elsewhere".format(os.path.relpath(path, site), line, target)
                continue
            file = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(url.path))) if url.path else path
            if not os.path.isfile(file):
                yield "{}:{}: {} does not exist".format(os.path.relpath(path, site), line, target)
            elif file in pages and urllib.parse.unquote(url.fragment) not in pages[file].anchors:
                yield "{}:{}: {} has no such anchor".format(os.path.relpath(path, site), line, target)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = list(faults(os.path.abspath(sys.argv[1])))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
