#!/usr/bin/env python3
"""Cuts figures of logs out of the page of an identification, as in docs/measured/.

    tests/tools/page_pictures.py PAGE.html FOLDER LOG...

PAGE.html is that of `gaitlab identify --page`; FOLDER/LOG.svg has the figure of the log with this name.
"""
import pathlib, re, sys


def main():
    page, folder, *logs = sys.argv[1:]
    text = pathlib.Path(page).read_text(encoding="utf-8")
    for log in logs:
        found = re.search(rf"<b>{re.escape(log)}</b>.*?(<svg.*?</svg>)", text, re.S)
        if not found:
            sys.exit(f"{page} has no log {log}")
        pathlib.Path(folder, log + ".svg").write_text(found[1] + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
