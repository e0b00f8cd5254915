#!/usr/bin/env bash
# Commands with threads have no data races, according to ThreadSanitizer.
# usage: threads.sh PROGRAM (built with the preset tsan)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
# pagmo and HDF5 are not built with the sanitizer, which therefore cannot judge their internal accesses.
export TSAN_OPTIONS="halt_on_error=1 exitcode=66 history_size=4 ignore_noninstrumented_modules=1"

source "$root/tests/gates/two_modules.sh"
two_modules "$work" "method: {type: random}" "budget: {runs: 24}"
sed '/cpg.type/d; s/^method:.*/method: {type: cma, population: 8}/; s/^budget:.*/budget: {runs: 48}/' "$work/study.yaml" >"$work/search.yaml"
echo 'guards: none' >>"$work/search.yaml"
cd -- "$work"
cp -r "$root/scenarios/pendulum.yaml" "$root/scenarios/pendulum.golden" "$root/scenarios/modules" .
cp -r pendulum.yaml second.yaml
cp -r pendulum.golden second.golden

# free CODE COMMAND...: expects this exit code, and no data race, whose exit code is 66.
free() { expect "$@" && ok "${*:2:2} ${*: -2}"; }
free 0 "$program" swap two.yaml --cpg phase_oscillator,hopf,sine --out swap -j 2
free 0 "$program" test pendulum.yaml second.yaml --out test -j 2
free 0 "$program" converge two.yaml --set duration=0.2 -j 2
free 0 "$program" sweep study.yaml --quiet --out sweep -j 2
free 0 "$program" sweep study.yaml --quiet --out lanes --lanes 1 -j 2
code=0
"$program" optimize search.yaml --quiet --out search -j 2 >"$work/log" 2>&1 || code=$?
((code == 0 || code == 3)) || { show_log; fail "optimize: exit code $code"; }
ok "optimize -j 2"
printf '{"id": 1, "parameters": {"cpg.frequency": 1, "cpg.amplitude": 0.5, "cpg.type": "hopf"}}\n\n' |
  expect 0 "$program" evaluate study.yaml --quiet --out asked -j 2
ok "evaluate -j 2"
verdict
