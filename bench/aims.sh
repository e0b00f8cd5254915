#!/usr/bin/env bash
# Instructions of whole calls of the program, in millions: a number per aim of speed, the same on a busy machine.
# usage: bench/aims.sh PROGRAM...     (needs valgrind; a column per program, takes some minutes for each)
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
search=$work/search.yaml
sed -e "s#^scenario: .*#scenario: $root/scenarios/caterpillar.yaml#" -e 's/^budget:.*/budget: {runs: 32}/' \
  -e 's/^verify:.*/verify: {best: 1, halve_step: false, worlds: false}/' "$root/scenarios/studies/caterpillar-speed.yaml" >"$search"

# Name of an aim, then the command without --out.
aims=(
  "run: hexapod, 8 s, with the page|run $root/scenarios/hexapod.yaml --set physics.engine=articulated --set duration=8"
  "run: hexapod, 8 s, engine bullet|run $root/scenarios/hexapod.yaml --no-report --set duration=8"
  "run: caterpillar, 20 s, engine bullet|run $root/scenarios/caterpillar.yaml --no-report --set duration=20"
  "search: 32 runs, directional gears|optimize $search --method random --seed 1 -j 1"
  "sweep: 9 runs of 3 s|sweep $root/scenarios/caterpillar.yaml --grid cpg.amplitude=0.3:0.6:9 --set physics.engine=articulated --set duration=3 -j 1"
)
for aim in "${aims[@]}"; do
  printf '| %s |' "${aim%%|*}"
  read -ra command <<<"${aim#*|}"
  for program; do
    rm -rf -- "$work/out"
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "${command[@]}" --quiet --out "$work/out" >"$work/log" 2>&1 || true
    printf ' %s |' "$(awk '/Collected/ { printf "%.0f", $4 / 1e6 }' "$work/log")"
  done
  printf '\n'
done
