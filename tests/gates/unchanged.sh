#!/usr/bin/env bash
# Runs a gate. In `./lab test` the gate is skipped (exit code 77) if it has passed with the same inputs: the bits of the given
# files and folders, its script and the files that gates share, and the versions of all packages of the machine. Their hash is
# stored beside the build; .ci/run removes it.
# usage: unchanged.sh STATE_FOLDER NAME INPUT... -- COMMAND...
set -euo pipefail
tests=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)
state=$1/$2 name=$2 inputs=("$tests/prelude.sh" "$tests/node.sh" "$tests/gates/unchanged.sh")
shift 2
while [[ $1 != -- ]]; do
  [[ -e $1 ]] || { printf 'BAD      %s: no input %s\n' "$name" "$1" >&2 && exit 1; }
  inputs+=("$1")
  shift
done
shift
# Names and bits of all files, except caches of node and Python.
hash=$({
  printf '%s\n' "$*"
  dpkg-query --show 2>/dev/null || true
  find -L "${inputs[@]}" -type f -not -path '*/node_modules/*' -not -path '*/__pycache__/*' -print0 |
    sort -z | xargs -0 sha256sum
} | sha256sum | head -c 64)
if [[ -n ${LAB_SKIP_UNCHANGED:-} && -f $state && $(<"$state") == "$hash" ]]; then
  printf 'SKIPPED  %s: passed with the same inputs\n' "$name" >&2
  exit 77
fi
rm -f -- "$state"
"$@"
[[ -z ${GAITLAB_QUARTER:-} ]] || exit 0 # only a part of the gate has run
mkdir -p -- "$(dirname -- "$state")"
printf '%s' "$hash" >"$state"
