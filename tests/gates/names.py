#!/usr/bin/env python3
"""Gate of names: every file that a comment or a page names exists, and every link of a page has its target.

    names.py               prints the names without a file; exit code 1 if there is one

Names are paths below a top-level folder (`core/laws/contact.h`, `docs/ci.md`, `report/plot`), files of code or pages without a folder
(`contact.h`), and targets of Markdown links. A path may omit the ending of code (`core/laws/contact`), contain `*`, or alternatives in
braces (`cpg/hopf.{h,cpp}`). CHANGELOG.md is omitted: its entries name the files of their version.
"""
import glob
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROOMS = ['core', 'actuators', 'controllers', 'cpg', 'sensors', 'physics_bullet', 'physics_articulated', 'studies', 'report', 'golden', 'interchange',
         'kit', 'python', 'app', 'tests', 'bench', 'docs', 'scenarios', 'cmake']

# Names of files that are not part of the project, with the reason.
FOREIGN = {
    'fcntl.h': 'C library', 'unistd.h': 'C library', 'tests/DynamicsTests.cc': 'tests of RBDL',
    'lash.cpp': 'written by the user: docs/tutorials/write-a-cpg.md', 'my_cpg.cpp': "a user's project in docs/ci.md",
    'scenarios/walk.yaml': "a user's project in docs/ci.md", 'scenarios/w.yaml': "a user's project in docs/ci.md",
    'tune.py': 'written by the user: docs/tutorials/optuna.md', 'test.cmake': 'written by `gaitlab new plugin`',
    'build_id.cpp': 'written by the build', 'gait.py': 'written by the user: docs/python.md',
}
# Words that represent any name.
PLACEHOLDER = re.compile(r'NAME|KIND|READER|WORD|[$<]')

PATH = re.compile(r'(?<![\w./~$}-])(?:\./)?((?:%s)/[\w.*{},/-]*[\w*}])' % '|'.join(ROOMS))
FILE = re.compile(r'(?<![\w./*}>-])([A-Za-z_]\w*\.(?:h|cpp|ts|py|sh|cmake|md))\b(?![\w./(])')
LINK = re.compile(r'\]\(([^)\s]+)\)')
CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<![0-9a-zA-Z_])\'(?:[^\'\\\n]|\\.)*\'', re.S)
SCRIPT = re.compile(r'(?:^|(?<=\s))#[^\n]*|\'\'\'.*?\'\'\'|""".*?"""', re.S)


def project_files():
    """Paths of the project's files: those that git lists, or without git all except what is built or run."""
    try:
        listed = subprocess.run(['git', 'ls-files', '--cached', '--others', '--exclude-standard'], cwd=ROOT, capture_output=True, text=True,
                                check=True).stdout.splitlines()
    except (OSError, subprocess.CalledProcessError):
        listed = [os.path.relpath(os.path.join(folder, name), ROOT) for folder, _, names in os.walk(ROOT) for name in names]
    return sorted(f for f in listed if not re.match(r'build/|runs/|\.git/|(.*/)?node_modules/', f) and os.path.isfile(os.path.join(ROOT, f)))


def texts(path, source):
    """Parts of a file that are read: (offset, text). Comments of code, whole pages."""
    if path.endswith('.md'):
        return [(0, source)]
    if path.endswith(('.h', '.cpp', '.ts')):
        return [(m.start(), m.group()) for m in CODE.finditer(source) if m.group().startswith(('//', '/*'))]
    return [(m.start(), m.group()) for m in SCRIPT.finditer(source)]


def alternatives(name):
    braces = re.search(r'\{([^{}]*)\}', name)
    if not braces:
        return [name]
    return [rest for one in braces.group(1).split(',') for rest in alternatives(name[:braces.start()] + one + name[braces.end():])]


def exists(name):
    if glob.has_magic(name):
        return bool(glob.glob(os.path.join(ROOT, name)))
    return any(os.path.exists(os.path.join(ROOT, name + ending)) for ending in ('', '.h', '.cpp'))


def headings(path, cache={}):
    """Anchors of a page, as GitHub forms them from its headings."""
    if path not in cache:
        with open(path, encoding='utf-8') as file:
            found = re.findall(r'^#+ (.*)$', file.read(), re.M)
        cache[path] = {re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-') for title in found}
    return cache[path]


def broken_link(page, target):
    if re.match(r'[a-z]+:', target):
        return False
    path, _, anchor = target.partition('#')
    whole = os.path.normpath(os.path.join(ROOT, os.path.dirname(page), path)) if path else os.path.join(ROOT, page)
    return not os.path.exists(whole) or bool(anchor and whole.endswith('.md') and anchor not in headings(whole))


def faults(path, source, basenames):
    """Names without a file: (offset, message)."""
    for start, text in texts(path, source):
        for match in PATH.finditer(text):
            names = alternatives(match.group(1))
            if not PLACEHOLDER.search(match.group(0)) and match.group(1) not in FOREIGN and not all(exists(name) for name in names):
                yield start + match.start(), match.group(1)
        for match in FILE.finditer(text):
            if match.group(1) not in basenames and match.group(1) not in FOREIGN and not PLACEHOLDER.search(match.group(1)):
                yield start + match.start(), match.group(1)
        if path.endswith('.md'):
            for match in LINK.finditer(text):
                if broken_link(path, match.group(1)):
                    yield start + match.start(), 'link ' + match.group(1)


def main():
    files = project_files()
    basenames = {os.path.basename(f) for f in files}
    bad = 0
    for path in files:
        if not path.endswith(('.h', '.cpp', '.md', '.py', '.sh', '.cmake', 'CMakeLists.txt', '.ts', 'lab', '.ci/run')) or path == 'CHANGELOG.md':
            continue
        with open(os.path.join(ROOT, path), encoding='utf-8') as file:
            source = file.read()
        for offset, name in faults(path, source, basenames):
            bad += 1
            print('{}:{}: {} does not exist'.format(path, source.count('\n', 0, offset) + 1, name))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
