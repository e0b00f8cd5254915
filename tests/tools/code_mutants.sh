#!/usr/bin/env bash
# Whether the tests notice wrong physics: nineteen defects, one at a time, put into a copy of the tree; each must turn a test red.
# usage: tests/tools/code_mutants.sh [CLONE]     (CLONE: a scratch clone with a finished build/release, which is edited and put back;
# default: a copy of this tree, which takes a full build more)
set -euo pipefail

root=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../..
work=${1:-}
if [[ -z $work ]]; then
  work=$(mktemp -d)
  trap 'rm -rf -- "$work"' EXIT
  git -C "$root" ls-files -z | (cd -- "$root" && xargs -0 cp --parents -t "$work")
fi
build=$work/build/release log=$work/build/mutants.log
# Whole walks and goldens see any of these, of course; what counts is that the tests which name the cause do.
left_out='-Walk*:*Golden*:*Determinism*:Rerun*:*Program*:*Command*:RunFolder*'

mkdir -p -- "$work/build"
build() {
  { [[ -f $build/build.ninja ]] || (cd -- "$work" && cmake --preset release); } >"$log" 2>&1 &&
    cmake --build "$build" --target gaitlab core_tests lab_tests >>"$log" 2>&1 || { tail -n 20 -- "$log"; exit 1; }
}
# The names of the failed tests.
red() {
  local tests
  for tests in core_tests lab_tests; do
    timeout 600 "$build/bin/$tests" --gtest_filter="$left_out" --gtest_brief=1 2>&1 |
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
  cp -- "$work/$file" "$work/build/whole"
  sed -i -E "$3" "$work/$file"
  ! cmp -s "$work/build/whole" "$work/$file" || { printf '%s: nothing to edit in %s\n' "$name" "$file"; exit 1; }
  build
  found=$(red)
  mv -- "$work/build/whole" "$work/$file"
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
mutant "contact: friction drives" physics_bullet/engine.cpp 's/touch\.normal - force\.friction_slope/touch.normal + force.friction_slope/'
mutant "hinge stop: damping drives" core/laws/hinge_stop.h 's/excess - kDamping \* qd/excess + kDamping * qd/'
mutant "fusion: parallel axes forgotten" core/model/assembly.cpp 's/t\.mass \* \(d\.squaredNorm/0 * (d.squaredNorm/'
mutant "docking turns the other way" core/model/assembly.cpp 's/kQuarter\[static_cast<std::size_t>\(orientation\)\]/kQuarter[static_cast<std::size_t>((4 - orientation) % 4)]/'
mutant "PID: the derivative forgets" controllers/pid.cpp 's/\(kd \* derivative \+ kd \* n/(kd * n/'
mutant "Runge-Kutta: equal weights" core/simulation/integrator.h 's/kWeight\{1\.0 \/ 6, 1\.0 \/ 3, 1\.0 \/ 3, 1\.0 \/ 6\}/kWeight{0.25, 0.25, 0.25, 0.25}/'
mutant "no gravity on one link" physics_bullet/multibody.cpp 's/robot_\.links\[i\]\.mass \* gravity/(i == 1 ? 0.0 : robot_.links[i].mass) * gravity/'
mutant "efficiency twice" core/laws/dc_motor.h 's/return \{share\.eta \* Kt/return {share.eta * share.eta * Kt/'
mutant "anti-windup looks at this tick's error" controllers/pid.cpp 's/last_error \* last_command > 0/error * last_command > 0/'
mutant "PID: the derivative comes a tick late" controllers/pid.cpp \
  's/derivative = kd == 0/const double late = derivative; derivative = kd == 0/; s/integral \+ derivative;/integral + late;/'
mutant "docking: orientations 2 and 3 exchanged" core/model/assembly.cpp 's/\{0, 1\}, \{-1, 0\}, \{0, -1\}/{0, 1}, {0, -1}, {-1, 0}/'
mutant "CPG: nothing couples the last joint" cpg/phase_oscillator.cpp \
  's/const double weight = s_\.model/const double weight = to + 1 == joints_ ? 0.0 : s_.model/'
mutant "legs: found in the order of numbers" core/plugin/legs.h 's/std::reverse\(order\.begin\(\) \+ first, order\.end\(\)\)/static_cast<void>(first)/'
mutant "articulated: no Coriolis term in the recursion" physics_articulated/body.h 's/p \+= I \* l\.c;//'
mutant "articulated: the bias in contacts' resistances is the base's" physics_articulated/body.h \
  's/l\.bias = parent\.bias \+ l\.c;/l.bias = parent.bias;/'
mutant "articulated: friction's slope along the slip drives" physics_articulated/contacts.h \
  's/add_square\(-h \* gt, along\)/add_square(h * gt, along)/'
mutant "articulated: the ledger gains what stops take" physics_articulated/implicit.h \
  's/done\.stops = done\.stops - h/done.stops = done.stops + h/'
exit "$bad"
