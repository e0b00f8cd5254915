#!/usr/bin/env bash
# Every sentence of the terminal, of verdict.json and of the page (sentences.py), with a browser for the pages.
# usage: sentences.sh PROGRAM_BUILD_DIR [options of sentences.py]     (exit code 77 without a browser or Python's modules)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
source "$root/tests/node.sh"
needs_browser "$(readlink -f -- "$1")" "the sentences of pages"
/usr/bin/python3 "$root/tests/gates/sentences.py" "$1/bin/gaitlab" "$root/scenarios" "${@:2}"
