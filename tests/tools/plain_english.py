#!/usr/bin/env python3
"""Counts patterns of hard-to-read English in messages, comments and docs.

    plain_english.py                   a table: hits of each rule
    plain_english.py --show RULE [N]   N random hits (20; --seed S draws others), with the advice
    plain_english.py --sample N        N random sentences of all, for a blind reading
    plain_english.py --gate            fails where a gate's count exceeds the committed one (plain_english.counts)
    plain_english.py --gate --renew    writes the counts of today
    ... PATH...                        only texts whose path begins with one of these

A rule is a gate if at least 80 % of its random hits deserve rewriting; the others are advice.
"""
import argparse
import fnmatch
import os
import random
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COUNTS = os.path.join(ROOT, 'tests', 'tools', 'plain_english.counts')
KINDS = ['message', 'comment', 'doc', 'test']

RULES = {  # name: (pattern, advice)
    'first-line': (r'', 'the first line of a header is a noun phrase: `Interface of ...`, `Rules of ...`, `Statistics over ...`'),
    'free-relative': (r'^(What|Whether|How|Who|Where|By what|In which|From what)\b(?!.*\?$)',
                      'begin with a noun: `Interface of ...`, `Check that ...`, `Statistics over ...`'),
    'headless-of': (r'^Of (?!course\b)[a-z`]', 'a note begins with the thing that it is about'),
    'that-of': (r'\b(that|those|these|the one|the ones) (of|that|which|with|there)\b', 'repeat the noun'),
    'is-no': (r'(?<![Tt]here )\b(is|are|was|were|be) no (?!longer|more\b|less\b|other\b|effect\b)[a-z]', '`is not a`, `is not part of`'),
    'but-for': (r'\b(but (for|with|where|in|of)|all but|none but|nothing but)\b', '`except`, `only`'),
    'person': (r'\b(nobody|who(ever)? (only|does|has|is|reads|wants|asks|says|looks|judges|reports|walks)|somebody)\b',
               'name the role (user, caller, plugin)'),
    'thing-talks': (r'\b(tells?(?! apart)|told(?! apart)|asks? (for|of)|is asked|are asked|was asked|is told|are told|says? (so|nothing|of|what|one)|'
                    r'knows? (of|no|nothing|only))\b', '`reports`, `prints`, `requires`, `contains`'),
    'stand': (r'\b(stands?|stood|standing) (in|at|under|behind|beside|alone)\b(?! [^.;]*\bworlds?\b)',
              '`is listed in`, `represents`, `follows`'),
    'where-if': (r'(?<![a-z] )\bwhere (it|they|there|that|those|this|nothing|none|no|one|a|an|the|[a-z]+s? (is|are|has|have|does|do|was))\b',
                 '`if` or `when`, unless it is a place'),
    'so-many': (r'\b(so (many|much|far|long)( [a-z]+)? (s|px|mm|m|runs|times|points|rows|characters|of|as)|as many as there are)\b',
                'name the number: `n seconds`'),
    'comma-that': (r', (that|which) [a-z]+ [a-z ]+, ', 'two sentences'),
    'too-end': (r', too\b(?!,? (much|many|long|small|large))', '`also` before the verb'),
    'prep-which': (r'\b(by|with|of|to|from|over|under|behind|beside|at|for|through|against|beyond) (which|what|whom|whose)\b',
                   'turn it round: `X uses Y`'),
    'what-is': (r'(?<=[a-z,;:(] )what (is|are|was|it|they|a|an|the|comes|came|goes|stays|stands|does|has|all|nobody|of|only|each|every|'
                r'both|one|else)\b', 'name the thing'),
    'come-go': (r'\b(goes on|go on|comes? (out|to|of|behind|before)|came (out|to|of)|went on|lies? (in|at|on|beside|behind)|at hand|'
                r'turns? up|end well)\b', '`continues`, `results`, `is`'),
    'own-one': (r"\b(of one's own|one's own|of (its|their|your) own)\b", '`custom`, `separate`, `user-defined`'),
    'the-way': (r'\b(the )?ways? (of|it|that|they|slid|back|round)\b|\bhow far\b', '`distance`, `path`, `by how much`'),
}
# Gates, each with the number of random hits (at most 100, seed 1) that deserved rewriting. For other rules this is half to two thirds.
GATES = {'first-line': '92 of 92', 'free-relative': '85 of 100', 'headless-of': '88 of 100', 'is-no': '24 of 29', 'but-for': '66 of 71',
         'person': '68 of 82', 'stand': '48 of 54', 'so-many': '9 of 10'}
PATTERNS = {name: re.compile(pattern) for name, (pattern, _) in RULES.items() if pattern}
NO_NOUN = re.compile(r'^(What|Whether|Which|How|Who|Where|When|Why|By (?!the)|In (?!the)|Of|For|From|With|Does|Do|Is|Are|Has|Have|May|Can|'
                     r'Between|(Counts|Lists|Fills|Reads|Writes|Finds|Runs|Tests|Everything|Does) (?!of)[a-z])\b')


class Text:
    def __init__(self, kind, path, line, sentence, of_bool=False, header=False):
        self.kind, self.path, self.line, self.sentence, self.of_bool, self.header = kind, path, line, sentence, of_bool, header

    def hit(self, rule):
        if rule == 'first-line':
            return self.header and bool(NO_NOUN.match(self.sentence))
        if rule == 'free-relative' and self.of_bool and self.sentence.startswith('Whether'):
            return False
        return bool(PATTERNS[rule].search(self.sentence))


def git(*arguments):
    """Output lines of a git command; empty without git or a checkout."""
    try:
        return subprocess.run(['git', *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    except (OSError, subprocess.CalledProcessError):
        return []


def files(*patterns):
    found = git('ls-files', '--cached', '--others', '--exclude-standard', '--', *patterns)
    if not found:  # the source tree is not a git checkout
        walk = (os.path.relpath(os.path.join(folder, f), ROOT) for folder, _, names in os.walk(ROOT) for f in names)
        found = [f for f in walk if not re.match(r'build/|.*/node_modules/', f) and any(fnmatch.fnmatch(f, p) for p in patterns)]
    return sorted(f for f in found if os.path.isfile(os.path.join(ROOT, f)))


def sentences(text):
    return [s for s in re.split(r'(?<=[.;!?]) +(?=[A-Z`(])', ' '.join(text.split())) if s]


def is_text(text):
    return ' ' in text and len(re.findall(r'[A-Za-z]{2,}', text)) >= 4


TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<d>\w*)\((?P<raw>.*?)\)(?P=d)"|"(?:[^"\\\n]|\\.)*"|(?<![0-9a-zA-Z_])\'(?:[^\'\\\n]|\\.)*\'', re.S)
TEMPLATE = re.compile(TOKEN.pattern + r'|`(?:[^`\\]|\\.)*`', re.S)
BOOL = re.compile(r'\bbool(ean)?\b')


def code_texts(path, source):
    test = path.startswith('tests/')
    lines = source.split('\n')
    comment, literal = [], []  # adjacent tokens that form one text, as (line, text)

    def end_comment():
        if comment:
            first, last = comment[0][0], comment[-1][0]
            beside = lines[first - 1].strip()
            target = beside if not beside.startswith('/') else lines[last] if last < len(lines) else ''
            # A blank line in a comment (`//` alone) ends a paragraph.
            for part in '\n'.join(t for _, t in comment).split('\n\n'):
                for n, s in enumerate(sentences(part)):
                    yield Text('test' if test else 'comment', path, first, s, bool(BOOL.search(target)),
                               path.endswith('.h') and first == 1 and n == 0)
        comment.clear()

    def end_literal():
        text = ''.join(t for _, t in literal)
        if not test and literal and is_text(text):
            for s in sentences(text.replace('\\n', ' ').replace('\\"', '"')):
                yield Text('message', path, literal[0][0], s)
        literal.clear()

    at, line = 0, 1
    for token in (TEMPLATE if path.endswith('.ts') else TOKEN).finditer(source):
        between = source[at:token.start()]
        line += between.count('\n')
        text = token.group()
        if between.strip():
            yield from end_literal()
        if between.strip() or between.count('\n') > 1:
            yield from end_comment()
        if text.startswith('//'):
            # A comment after code on the same line is a separate text.
            beside = lines[line - 1].strip()
            if comment and not beside.startswith('//'):
                yield from end_comment()
            comment.append((line, re.sub(r'^//+<?\s?', '', text)))
            if not beside.startswith('//'):
                yield from end_comment()
        elif text.startswith('/*'):
            comment.append((line, re.sub(r'(?m)^\s*\*\s?', '', text[2:-2])))
            yield from end_comment()
        elif not re.search(r'#\s*include\s*$', between):
            literal.append((line, token.group('raw') if text.startswith('R') else text[1:-1]))
        line += text.count('\n')
        at = token.end()
    yield from end_comment()
    yield from end_literal()


def doc_texts(path, source):
    code, paragraph = False, []  # paragraph contains (line, text)

    def end():
        for s in sentences(' '.join(t for _, t in paragraph)):
            yield Text('doc', path, paragraph[0][0], s)
        paragraph.clear()

    before = ''
    for number, line in enumerate(source.split('\n'), 1):
        if line.startswith('```'):
            code = not code
        is_code = code or (line.startswith('    ') and not before.strip())
        if is_code or not line.strip() or line.startswith(('#', '```', '<')):
            yield from end()
            before = '' if is_code else line
            continue
        before = line
        if line.startswith('|'):
            yield from end()
            for cell in re.split(r'(?<!\\)\|', line)[1:-1]:
                for s in sentences(cell):
                    yield Text('doc', path, number, s)
            continue
        if re.match(r'\s*([-*]|\d+\.) ', line):
            yield from end()
        paragraph.append((number, re.sub(r'^\s*([-*]|\d+\.) +', '', line)))
    yield from end()


def texts(paths):
    found = []
    for path in files('*.h', '*.cpp', 'report/page/src/*.ts', 'docs/*.md', 'README.md', 'CONTRIBUTING.md', 'tests/README.md'):
        if path.startswith('docs/reference/') or path == 'docs/validation.md' or (paths and not path.startswith(tuple(paths))):
            continue
        with open(os.path.join(ROOT, path), encoding='utf-8') as file:
            source = file.read()
        found += doc_texts(path, source) if path.endswith('.md') else code_texts(path, source)
    return found


def counted(found):
    return {rule: {kind: sum(t.kind == kind and t.hit(rule) for t in found) for kind in KINDS} for rule in RULES}


def table(found):
    counts = counted(found)
    line = '{:<14} {:>8} {:>8} {:>8} {:>8} {:>8}  {}'.format
    print(line('rule', *KINDS, 'all', 'is'))
    for rule, row in counts.items():
        print(line(rule, *row.values(), sum(row.values()), 'gate: {} real'.format(GATES[rule]) if rule in GATES else 'advice'))
    hits = [sum(t.kind == kind and any(t.hit(rule) for rule in RULES) for t in found) for kind in KINDS]
    every = [sum(t.kind == kind for t in found) for kind in KINDS]
    print(line('any', *hits, sum(hits), ''))
    print(line('sentences', *every, sum(every), ''))


def gate(found, renew):
    counts = counted(found)
    if renew:
        with open(COUNTS, 'w', encoding='utf-8') as file:
            file.write('# Most hits of each rule: {}. `tests/tools/plain_english.py --gate --renew` writes them.\n'.format(', '.join(KINDS)))
            for rule in GATES:
                file.write('{} {}\n'.format(rule, ' '.join(str(n) for n in counts[rule].values())))
        return 0
    with open(COUNTS, encoding='utf-8') as file:
        allowed = dict((line.split()[0], [int(n) for n in line.split()[1:]]) for line in file if not line.startswith('#'))
    base = git('merge-base', 'HEAD', 'origin/main') or ['HEAD']
    changed = set(git('diff', '--name-only', base[0] if base != git('rev-parse', 'HEAD') else 'HEAD~1'))
    bad = 0
    for rule in GATES:
        for kind, most in zip(KINDS, allowed.get(rule, [0] * len(KINDS))):
            count = counts[rule][kind]
            if count < most:
                print('{}: {} hits in kind {}, {} allowed: --gate --renew lowers the limit'.format(rule, count, kind, most))
            elif count > most:
                bad += 1
                print('{}: {} hits in kind {}, at most {} allowed; {}. In changed files:'.format(rule, count, kind, most, RULES[rule][1]))
                for t in [t for t in found if t.kind == kind and t.path in changed and t.hit(rule)][:20]:
                    print('  {}:{}: {}'.format(t.path, t.line, t.sentence[:200]))
    return 1 if bad else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--show', nargs='+', metavar=('RULE', 'N'))
    parser.add_argument('--sample', type=int)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--gate', action='store_true')
    parser.add_argument('--renew', action='store_true')
    parser.add_argument('paths', nargs='*')
    arguments = parser.parse_args()
    found = texts(arguments.paths)
    if arguments.gate:
        return gate(found, arguments.renew)
    draw = random.Random(arguments.seed)
    if arguments.show:
        rule, most = arguments.show[0], int(arguments.show[1]) if len(arguments.show) > 1 else 20
        hits = [t for t in found if t.hit(rule)]
        for t in sorted(draw.sample(hits, min(most, len(hits))), key=lambda t: (t.path, t.line)):
            print('{} {}:{}: {}'.format(t.kind, t.path, t.line, t.sentence[:220]))
        print('{} of {} hits; instead: {}'.format(min(most, len(hits)), len(hits), RULES[rule][1]))
    elif arguments.sample:
        for t in draw.sample(found, min(arguments.sample, len(found))):
            print('{} {}:{}: {}'.format(t.kind, t.path, t.line, t.sentence))
    else:
        table(found)
    return 0


if __name__ == '__main__':
    sys.exit(main())
