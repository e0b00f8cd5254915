#!/usr/bin/env bash
# Whether the tests notice wrong physics: ten defects, one at a time, put into a copy of the tree; each must turn a test red.
# usage: tests/code_mutants.sh     (a quarter of an hour on 2 cores; leaves the tree alone)
set -euo pipefail

root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/..
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
# Whole walks and goldens see any of these, of course; what counts is that the tests which name the cause do.
left_out='-Walk.*:Golden*:*Determinism*:Rerun*:Program*'

git -C "$root" ls-files -z | (cd -- "$root" && xargs -0 cp --parents -t "$work")
build() {
  cmake -S "$work" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 >"$work/log" 2>&1 &&
    cmake --build "$work/build" --target gaitlab core_tests lab_tests >>"$work/log" 2>&1 ||
    { tail -n 20 -- "$work/log"; exit 1; }
}
# The names of the failed tests.
red() {
  local tests
  for tests in core_tests lab_tests; do
    timeout 600 "$work/build/bin/$tests" --gtest_filter="$left_out" --gtest_brief=1 2>&1 |
      sed -nE 's/^\[  FAILED  \] ([A-Za-z0-9_]+[.\/][A-Za-z0-9_.\/]+).*/\1/p' | sort -u || true
  done
}

build
before=$(red)
[[ -z $before ]] || { printf 'red without a defect:\n%s\n' "$before"; exit 1; }

bad=0
# mutant NAME FILE SED: a defect; an edit that finds nothing is an error.
mutant() {
  local name=$1 file=$2 found
  cp -- "$work/$file" "$work/whole"
  sed -i -E "$3" "$work/$file"
  ! cmp -s "$work/whole" "$work/$file" || { printf '%s: nothing to edit in %s\n' "$name" "$file"; exit 1; }
  build
  found=$(red)
  mv -- "$work/whole" "$work/$file"
  touch "$work/$file"
  if [[ -n $found ]]; then
    printf '| %s | %s | %s |\n' "$name" "$(wc -l <<<"$found")" "$(head -n 3 <<<"$found" | sed 's/.*/`&`/' | paste -sd ' ')"
  else
    printf '| %s | 0 | NONE |\n' "$name"
    bad=1
  fi
}

printf '| defect | tests red | among them |\n|---|---|---|\n'
mutant "a sign in the use of the articulated-body algorithm" physics_bullet/multibody.cpp \
  's/- out\.angular\.cross\(base_com_\)/+ out.angular.cross(base_com_)/'
mutant "motor: back-EMF drives" core/laws/dc_motor.h 's/\(u - emf\) \/ R/(u + emf) \/ R/'
mutant "contact: damping pushes when leaving" core/laws/contact.h 's/power\(p, k\) - damping \* vn/power(p, k) + damping * vn/'
mutant "hinge stop: damping drives" core/laws/hinge_stop.h 's/excess - kDamping \* qd/excess + kDamping * qd/'
mutant "fusion: parallel axes forgotten" core/model/assembly.cpp 's/t\.mass \* \(d\.squaredNorm/0 * (d.squaredNorm/'
mutant "docking turns the other way" core/model/assembly.cpp 's/kQuarter\[static_cast<std::size_t>\(orientation\)\]/kQuarter[static_cast<std::size_t>((4 - orientation) % 4)]/'
mutant "PID: the derivative forgets" controllers/pid.cpp 's/\(kd \* derivative \+ kd \* n/(kd * n/'
mutant "Runge-Kutta: equal weights" core/simulation/integrator.h 's/kWeight\{1\.0 \/ 6, 1\.0 \/ 3, 1\.0 \/ 3, 1\.0 \/ 6\}/kWeight{0.25, 0.25, 0.25, 0.25}/'
mutant "no gravity on one link" physics_bullet/multibody.cpp 's/robot_\.links\[i\]\.mass \* gravity/(i == 1 ? 0.0 : robot_.links[i].mass) * gravity/'
mutant "efficiency twice" core/laws/dc_motor.h 's/return \{share\.eta \* Kt/return {share.eta * share.eta * Kt/'
exit "$bad"
