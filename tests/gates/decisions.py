#!/usr/bin/env python3
"""Gate of decisions by text: prints the places at which code searches a text for a word, with the reason; exit code 1 if a
place is new.

Words of a message are for people, and may change. Code decides by values: an enum, a type of error, a member of the problem. The places
below search for names that a format, a file or another program defines. Their numbers may only fall.
"""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ['app', 'core/scenario', 'golden', 'report', 'studies']
SEARCH = re.compile(r'[.](r?find|contains|starts_with|ends_with)\("((?:[^"\\]|\\.)*[A-Za-z]{2}(?:[^"\\]|\\.)*)"(?=([^;]*))')
ALLOWED = {  # by the name of the file: number of searches, reason
    'candidates.cpp': (1, 'placeholder in the path of a key'),
    'cpg_file.cpp': (2, 'ending of a file'),
    'command_line.cpp': (2, 'types of CLI11'), 'command_tree.cpp': (3, 'types of CLI11'), 'compare.cpp': (1, 'name of a number'),
    'curves_panel.cpp': (1, 'name of a column'), 'explain.cpp': (1, 'ending of a file'), 'journal_head.cpp': (2, 'kinds in a journal'),
    'listed_kinds.cpp': (2, 'comment of a shipped file'), 'plan_checks.cpp': (2, 'path of a key'), 'quantities.cpp': (1, 'name of a number'),
    'read_scenario.cpp': (1, 'path of a key'), 'recipe.cpp': (1, 'path of a key'), 'robot_section.cpp': (1, 'ending of a file'),
    'scenario_reader.cpp': (1, 'path of a key'), 'scenarios.cpp': (1, 'place of a setting'), 'screen.cpp': (1, 'id of a check'), 'sensor_section.cpp': (1, 'name of a column'),
    'study_file.cpp': (1, 'first key of a file'), 'study_folder.cpp': (2, 'ending of a file'), 'swapped.cpp': (1, 'path of a key'),
    'test.cpp': (1, 'start of XML'), 'verdict.cpp': (1, 'id of a check'),
}
found = {}
for path in sorted(os.path.join(at, name) for room in ROOMS for at, _, names in os.walk(os.path.join(ROOT, room)) for name in names):
    if path.endswith(('.h', '.cpp')):
        with open(path, encoding='utf-8') as file:
            code = re.sub(r'//.*', '', file.read())
        for match in SEARCH.finditer(code):
            key = match[1] in ('find', 'contains') and re.fullmatch(r'\w[\w.]*', match[2]) and 'npos' not in match[3]  # of a map
            if not key:
                place = '{}:{}: {}'.format(os.path.relpath(path, ROOT), code.count('\n', 0, match.start()) + 1, match[0])
                found.setdefault(os.path.basename(path), []).append(place)
for name in sorted(found.keys() | ALLOWED.keys()):
    number, reason = ALLOWED.get(name, (0, 'none: decide by a value'))
    print('\n'.join(found.get(name, []) + ['    {} allowed: {}'.format(number, reason)]))
wrong = [name for name in found.keys() | ALLOWED.keys() if len(found.get(name, [])) != ALLOWED.get(name, (0,))[0]]
print('\n'.join('{}: other searches than allowed in decisions.py'.format(name) for name in sorted(wrong)))
sys.exit(1 if wrong else 0)
