#!/usr/bin/env python3
"""Gate of the commands in pages: blocks of commands in README.md and docs/ run as they stand, and print the output that the page shows.

    blocks.py PROGRAM              searches and sweeps with --dry-run, no remedy of docs/remedy.md
    blocks.py PROGRAM --all        with docs/remedy.md, and the search of docs/tutorials/tune-a-gait.md; minutes of CPU time
    blocks.py PROGRAM PAGE...      these pages alone

Each page has a folder with the project's scenarios. A scenario or study on the page is a file there. `...` in an output is any text, and times are
not compared. A block that is not run is an entry of NOT_RUN with the reason. Exit code 77: Python's module yaml is missing.
"""
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(ROOT, 'docs', 'site'))
try:
    import yaml
    import pages
except ImportError as error:
    print('SKIPPED  the commands of pages: NOT TESTED: {} (Debian: python3-yaml)'.format(error))
    sys.exit(77)

# Pages, or beginnings of blocks, that are not run.
NOT_RUN = {
    'CONTRIBUTING.md': 'stages of ./lab', 'tests/README.md': 'npm', 'docs/benchmarks.md': 'a quarter of an hour', 'docs/ci.md': 'Install.Gate',
    'docs/tutorials/write-a-cpg.md': 'Install.Gate', 'docs/tutorials/optuna.md': 'Python.Gate', 'docs/python.md': 'Python.tests',
    'docs/validation.md': 'writes the page', './lab ': 'builds', 'export STUDY': 'Slurm.Gate, Mpi.Gate',
    'gaitlab identify xl330': 'logs of a bench, minutes of CPU time',
}
PLACEHOLDER = re.compile(r'\b(DIR|FILE|KEYS|SCENARIO|RUN|NAME|PROGRAM)\b')
SLOW = re.compile(r'gaitlab (optimize|sweep|remedy scenarios/hexapod.yaml --set cpg)')
COMPARED = ('docs/remedy.md', 'docs/tutorials/tune-a-gait.md')  # pages whose slow commands run with --all
# Pages on which literal blocks without a command are the output of the last command.
OUTPUTS = ('docs/tutorials/feasible.md', 'docs/tutorials/tune-a-gait.md')
BLOCK = re.compile(r'^```(\w*)[^\n]*\n(.*?)^```$|((?:^    [^\n]*\n|^\n(?=(?:\n)*    ))+)', re.M | re.S)
CLOCK = re.compile(r'simulated in [\d.]+ s')


def blocks(text):
    """Literal blocks of a page: (text in front of it, language, block)."""
    end = 0
    for match in BLOCK.finditer(text):
        block = match.group(2) if match.group(3) is None else re.sub(r'^    ', '', match.group(3), flags=re.M)
        if block.strip():
            word = match.group(1) if match.group(3) is None else ''
            yield text[end:match.start()], word if word not in ('', 'text') else pages.language(block.strip('\n')), block.strip('\n')
            end = match.end()


def write_file(folder, before, block):
    """Writes a scenario, a study or a CPG file to a file, whose name is in the text in front of the block or is the key `name` in it."""
    content = yaml.safe_load(block)
    named = re.findall(r'`([\w-]+\.yaml)`', before.strip().split('\n\n')[-1])
    if isinstance(content, dict) and {'gaitlab', 'gaitlab_study', 'gaitlab_cpg'} & set(content) and (named or 'name' in content):
        with open(os.path.join(folder, named[0] if named else content['name'] + '.yaml'), 'w', encoding='utf-8') as file:
            file.write(block)


def same(expected, said):
    """True if the parts of the expected output between `...` follow one another in the output."""
    said, at = ' '.join(CLOCK.sub('', said).split()), 0
    for part in expected.split('...'):
        part = ' '.join(CLOCK.sub('', part).split())
        at = said.find(part, at)
        if at < 0:
            return False
        at += len(part)
    return True


class Page:
    def __init__(self, path, program, everything):
        self.path, self.everything, self.bad, self.ran = path, everything, 0, 0
        self.environment = dict(os.environ, PATH=os.path.dirname(program) + ':' + os.environ['PATH'])
        self.said = None  # output of the last command

    def fault(self, what, text):
        self.bad += 1
        print('BAD      {}: {}\n{}'.format(self.path, what, text))

    def run(self, folder, command):
        slow = SLOW.match(command)
        self.said = None
        if slow and not (self.everything and self.path in COMPARED):
            if slow.group(1).startswith('remedy'):
                return
            command += ' --dry-run'
        result = subprocess.run(['bash', '-c', command], cwd=folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.ran += 1
        if result.returncode:
            self.fault('exit code {} of {}'.format(result.returncode, command), result.stdout[-3000:])
        elif not command.endswith('--dry-run'):
            self.said = result.stdout

    def compare(self, expected):
        if self.said is not None and not same(expected, self.said):
            self.fault('another output', self.said[-6000:])

    def block(self, folder, before, language, block):
        if language == 'yaml':
            write_file(folder, before, block)
        elif language == 'console':
            command, _, output = block[2:].partition('\n')
            self.run(folder, command)
            self.compare(output)
        elif language == 'bash' and not PLACEHOLDER.search(block) and not any(block.startswith(start) for start in NOT_RUN):
            for command in block.replace('\\\n', ' ').splitlines():
                self.run(folder, re.sub(r'\s+# .*', '', command))
        elif language == 'none' and self.path in OUTPUTS:
            self.compare(block)

    def test(self):
        with open(os.path.join(ROOT, self.path), encoding='utf-8') as file:
            text = file.read()
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(os.path.join(ROOT, 'scenarios'), os.path.join(folder, 'scenarios'))
            for before, language, block in blocks(text):
                self.block(folder, before, language, block)
            # Commands of a numbered list (README.md).
            for command in re.findall(r'^\d+\. `(gaitlab [^`]*)`', text, re.M):
                self.run(folder, command)
        if self.ran:
            print('{:8} {}: {} commands'.format('BAD' if self.bad else 'ok', self.path, self.ran))
        return self.bad


def main():
    options = [word for word in sys.argv[1:] if word.startswith('--')]
    words = [word for word in sys.argv[1:] if not word.startswith('--')]
    if not words or set(options) - {'--all'}:
        sys.exit(__doc__)
    program = os.path.abspath(words[0])
    chosen = words[1:] or [page for page in pages.listed() if page not in NOT_RUN and page != 'CHANGELOG.md']
    if not words[1:] and 'GAITLAB_QUARTER' in os.environ:
        chosen = chosen[int(os.environ['GAITLAB_QUARTER'])::4]  # in CI every fourth page
    bad = sum(Page(path, program, bool(options)).test() for path in chosen)
    print('{} bad'.format(bad))
    return 1 if bad else 0


if __name__ == '__main__':
    sys.exit(main())
