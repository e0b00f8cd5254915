#!/usr/bin/env python3
"""Builds the site: the pages of docs/, README.md and others as HTML for a browser, without a server or a network.

    build.py SITE [--program PROGRAM]     with a gallery, if PROGRAM is given

Warnings of Sphinx and broken links are errors; the folder SITE is replaced only if there is none. Needs Sphinx, myst-parser, furo,
sphinx-copybutton and PyYAML (Debian: the packages that `./lab site` installs).
"""
import argparse
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True
import assets  # noqa: E402
import gallery  # noqa: E402
import links  # noqa: E402
import pages  # noqa: E402


def build(work, program):
    """Builds the site in the folder `work`/site."""
    source, site = os.path.join(work, "source"), os.path.join(work, "site")
    os.makedirs(source)
    pages.write(source, gallery=program is not None)
    if program:
        gallery.write(program, source, os.path.join(site, "gallery"))
    sphinx = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "--keep-going", "-q", "-c", HERE, "-d", os.path.join(work, "doctrees")]
    if subprocess.run(sphinx + [source, site]).returncode:
        sys.exit(1)
    os.remove(os.path.join(site, ".buildinfo"))
    assets.complete(site)
    found = list(links.faults(site))
    if found:
        sys.exit("\n".join(found))
    return site


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("site")
    parser.add_argument("--program")
    options = parser.parse_args()
    target = os.path.abspath(options.site)
    if os.path.exists(target) and os.listdir(target) and not os.path.exists(os.path.join(target, "search.html")):
        sys.exit("{}: exists and is not a site".format(options.site))
    os.makedirs(os.path.dirname(target), exist_ok=True)
    with tempfile.TemporaryDirectory(dir=os.path.dirname(target), prefix=".site-") as work:
        site = build(work, options.program and os.path.abspath(options.program))
        if os.path.exists(target):
            os.rename(target, os.path.join(work, "old"))
        os.rename(site, target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
