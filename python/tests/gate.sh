#!/usr/bin/env bash
# Tests of the Python package: `tests`, python/tests/test_*.py; `stub`, the stub _native.pyi against the module, and the types of the
# package; `tutorial`, the notebook of docs/tutorials and the examples, executed.
# usage: gate.sh tests|stub|tutorial PYTHON PACKAGES
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
what=$1 python=$2
export PYTHONPATH=$3 PYTHONDONTWRITEBYTECODE=1
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$here"
need() {
  "$python" -c "import $1" 2>/dev/null || { echo "SKIPPED $what: Python's module $1 is missing (Debian: $2)"; exit 77; }
}
case $what in
  tests)
    need numpy python3-numpy
    need pandas python3-pandas
    need h5py python3-h5py
    # A locale with a decimal comma (Debian: locales), for the tests alone.
    if localedef --force -f UTF-8 -i de_DE "$work/de_DE.UTF-8" >/dev/null 2>&1; then export LOCPATH=$work; fi
    "$python" -W ignore::UserWarning -m unittest discover --start-directory "$here" --pattern 'test_*.py' "${@:4}"
    ;;
  stub)
    need mypy mypy
    export MYPYPATH=$PYTHONPATH MYPY_CACHE_DIR=$work
    "$python" -m mypy.stubtest gaitlab._native --mypy-config-file "$here/mypy.ini" --allowlist "$here/stub_allowed.txt"
    "$python" -m mypy --config-file "$here/mypy.ini" --package gaitlab
    ;;
  tutorial)
    need nbconvert python3-nbconvert
    need ipykernel python3-ipykernel
    need optuna python3-optuna
    export PYDEVD_DISABLE_FILE_VALIDATION=1 JUPYTER_RUNTIME_DIR=$work JUPYTER_CONFIG_DIR=$work IPYTHONDIR=$work PATH=/usr/bin:$PATH
    cd -- "$work"
    "$python" -m nbconvert --execute --to markdown --output-dir "$work" --log-level WARN "$here/../../docs/tutorials/python.ipynb"
    grep -q "ZeroDivisionError" python.md || { echo "the notebook shows no outcome of its wrong class"; exit 1; }
    tail -n 3 python.md | grep -q True || { echo "the notebook does not read its own run"; exit 1; }
    "$python" "$here/../examples/tune_cma.py" 2 | tail -n 1
    "$python" "$here/../examples/tune_optuna.py" 2 6
    ;;
esac
