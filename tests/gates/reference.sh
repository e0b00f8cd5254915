#!/usr/bin/env bash
# docs/reference and the editors' schema are written by the program: fails where a committed file differs from what it prints.
# usage: reference.sh PROGRAM_BUILD_DIR [--renew]
set -euo pipefail

program=$(readlink -f -- "$1")/bin/gaitlab
renew=${2:-}
cd -- "$(readlink -f -- "$(dirname -- "${BASH_SOURCE[0]}")")/../.."
now=$(mktemp)
trap 'rm -f -- "$now"' EXIT
stale=0

# page FILE COMMAND...
page() {
  local file=$1
  shift
  "$program" "$@" >"$now"
  [[ $renew != --renew ]] || cp -- "$now" "$file"
  if diff -u -- "$file" "$now"; then
    printf 'ok       %s\n' "$file"
  else
    stale=1
    printf 'stale    %s: renew it with tests/gates/reference.sh build/release --renew\n' "$file"
  fi
}

page docs/reference/scenario.md reference scenario
page docs/reference/plugins.md reference plugins
page scenarios/gaitlab.schema.json schema
exit "$stale"
