#!/usr/bin/env bash
# The program writes docs/reference and the schema for editors. Fails if a committed file differs from the output of the program.
# usage: reference.sh PROGRAM_BUILD_DIR [--renew]
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")/bin/gaitlab
renew=${2:-}
now=$work/now
cd -- "$root"

# page FILE COMMAND...: compares FILE with the output of COMMAND, or renews FILE.
page() {
  local file=$1
  shift
  "$program" "$@" >"$now"
  [[ $renew != --renew ]] || replace "$file" "$now"
  if diff -u -- "$file" "$now"; then
    ok "$file"
  else
    bad "$file is stale: renew it with tests/gates/reference.sh build/release --renew"
  fi
}

page docs/reference/scenario.md reference scenario
page docs/reference/plugins.md reference plugins
page docs/reference/module.md reference module
page docs/reference/figure.md reference figure
page docs/reference/study.md reference study
page docs/reference/verdict.md reference verdict
page scenarios/gaitlab.schema.json schema
page scenarios/gaitlab-module.schema.json schema --module
page scenarios/gaitlab-study.schema.json schema --study
verdict
