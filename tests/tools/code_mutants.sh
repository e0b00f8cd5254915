#!/usr/bin/env bash
# Tests if the test suite detects wrong physics. Defects are put one at a time into a copy of the tree, and each must make a test fail.
# A complete run writes its table into tests/validation_head.md and docs/validation.md at the end.
# usage: tests/tools/code_mutants.sh [--clone FOLDER] [NAME...]
#   FOLDER is a clone with a finished build/release, which is edited and restored. The default is a copy of this tree, which needs
#   a full build. With NAME, only defects with this pattern in their names are tested, and the table is only printed.
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"

clone=
if [[ ${1:-} == --clone && -d ${2:-} ]]; then
  clone=$(readlink -f -- "$2")
  shift 2
fi
[[ ${1:-} != -* ]] || usage
patterns=("$@")
if [[ -z $clone ]]; then
  clone=$work/clone
  mkdir -- "$clone"
  git -C "$root" ls-files -z | (cd -- "$root" && xargs -0 cp --parents -t "$clone")
fi
build=$clone/build/release
pages=("$root/tests/validation_head.md" "$root/docs/validation.md")
begin='<!-- defects: written by tests/tools/code_mutants.sh -->' end='<!-- end of defects -->'
# Tests of whole walks and goldens are excluded. They detect all of these defects, but a specific test must detect each defect.
left_out='-Walk*:*Golden*:*Determinism*:Rerun*:*Program*:*Command*:RunFolder*'

names=() files=() edits=()
# defect NAME FILE SED: adds a defect. An edit that changes nothing is an error, which is reported before the first build.
defect() {
  local pattern
  for pattern in "${patterns[@]:-}"; do
    if [[ $1 == *$pattern* ]]; then
      if [[ ! -f $clone/$2 ]] || sed -E "$3" "$clone/$2" | cmp -s - "$clone/$2"; then fail "$1: nothing to edit in $2"; fi
      names+=("$1") files+=("$2") edits+=("$3")
      return
    fi
  done
}

defect "a sign in the use of the articulated-body algorithm" physics_bullet/multibody.cpp \
  's/- out\.angular\.cross\(base_com_\)/+ out.angular.cross(base_com_)/'
defect "motor: back-EMF drives" core/laws/dc_motor.h 's/\(u - emf\) \/ R/(u + emf) \/ R/'
defect "contact: friction drives" physics_bullet/engine.cpp 's/touch\.normal - force\.friction_slope/touch.normal + force.friction_slope/'
defect "hinge stop: damping drives" core/laws/hinge_stop.h 's/excess - kDamping \* qd/excess + kDamping * qd/'
defect "fusion: parallel axes forgotten" core/model/assembly.cpp 's/t\.mass \* \(d\.squaredNorm/0 * (d.squaredNorm/'
defect "docking turns the other way" core/model/assembly.cpp 's/kQuarter\[static_cast<std::size_t>\(orientation\)\]/kQuarter[static_cast<std::size_t>((4 - orientation) % 4)]/'
defect "PID: the derivative forgets" controllers/pid.cpp 's/\(kd \* derivative \+ kd \* n/(kd * n/'
defect "Runge-Kutta: equal weights" core/math/runge_kutta.h 's/kWeight\{1\.0 \/ 6, 1\.0 \/ 3, 1\.0 \/ 3, 1\.0 \/ 6\}/kWeight{0.25, 0.25, 0.25, 0.25}/'
defect "no gravity on one link" physics_bullet/multibody.cpp 's/robot_\.links\[i\]\.mass \* gravity/(i == 1 ? 0.0 : robot_.links[i].mass) * gravity/'
defect "efficiency twice" core/laws/dc_motor.h 's/torque = share\.eta \* Kt/torque = share.eta * share.eta * Kt/'
defect "anti-windup looks at this tick's error" controllers/pid.cpp 's/last_error \* last_command > 0/error * last_command > 0/'
defect "PID: the derivative comes a tick late" controllers/pid.cpp \
  's/derivative = kd == 0/const double late = derivative; derivative = kd == 0/; s/integral \+ derivative;/integral + late;/'
defect "docking: orientations 2 and 3 exchanged" core/model/assembly.cpp 's/\{0, 1\}, \{-1, 0\}, \{0, -1\}/{0, 1}, {0, -1}, {-1, 0}/'
defect "CPG: nothing couples the last joint" cpg/phase_oscillator.cpp \
  's/const double weight = s_\.model/const double weight = to + 1 == joints_ ? 0.0 : s_.model/'
defect "legs: the right ones come first" core/model/legs.cpp 's/legs\[a\]\.side > legs\[b\]\.side/legs[a].side < legs[b].side/'
defect "articulated: no Coriolis term in the recursion" physics_articulated/body.h 's/p \+= I \* l\.c;//'
defect "articulated: the bias in contacts' resistances is the base's" physics_articulated/body.h \
  's/l\.bias = parent\.bias \+ l\.c;/l.bias = parent.bias;/'
defect "articulated: friction's slope along the slip drives" physics_articulated/contacts.h \
  's/add_square\(-h \* gt, along\)/add_square(h * gt, along)/'
defect "articulated: the ledger gains what stops take" physics_articulated/implicit.h \
  's/done\.stops = done\.stops - h/done.stops = done.stops + h/'

defect "a stuck hinge is held at once" core/laws/hinge_stop.h 's/share = since \* \(1 \/ kRamp\)/share = since * (1 \/ kRamp) + T(1.0)/'
defect "docks: no loads where a hinge meets its stop" core/simulation/met_stops.cpp 's/side = met_stop\(/side = 0 * met_stop(/'

build() {
  [[ -f $build/build.ninja ]] || (cd -- "$clone" && expect 0 cmake --preset release)
  expect 0 cmake --build "$build" --target gaitlab core_tests program_tests
}
# Prints the names of the failed tests.
red() {
  local tests
  for tests in core_tests program_tests; do
    timeout 600 "$build/bin/$tests" --gtest_filter="$left_out" --gtest_brief=1 2>&1 |
      sed -nE 's/^\[  FAILED  \] ([A-Za-z0-9_]+[.\/][A-Za-z0-9_.\/]+).*/\1/p' | sort -u || true
  done
}
# try NAME FILE SED: prints the defect's row of the table. The file is restored, also if the defect does not compile.
try() (
  file=$clone/$2
  cp -- "$file" "$build/whole"
  trap 'cp -- "$build/whole" "$file"' EXIT
  sed -i -E "$3" "$file"
  build
  found=$(red)
  if [[ -n $found ]]; then
    printf '| %s | %s | %s |\n' "$1" "$(wc -l <<<"$found")" "$(head -n 3 <<<"$found" | sed "s/.*/\`&\`/" | paste -sd ' ')"
  else
    printf '| %s | 0 | NONE |\n' "$1"
  fi
)
# Succeeds if the page has a place for the table.
has_place() { [[ $(grep -xF -e "$begin" -e "$end" -- "$1") == "$begin"$'\n'"$end" ]]; }
# renew PAGE: replaces the table in PAGE by the new table.
renew() {
  awk -v begin="$begin" -v end="$end" -v table="$work/table" '
    $0 == end { inside = 0 }
    !inside
    $0 == begin { inside = 1; print ""; while ((getline line <table) > 0) print line; print "" }' "$1" >"$work/page"
  replace "$1" "$work/page"
}

((${#names[@]})) || fail "no defect is named so: ${patterns[*]}"
for page in "${pages[@]}"; do has_place "$page" || fail "$page: no lines '$begin' and '$end'"; done
build
before=$(red)
[[ -z $before ]] || fail "red without a defect:"$'\n'"$before"

printf '| defect | tests red | among them |\n|---|---|---|\n' | tee "$work/table"
for i in "${!names[@]}"; do try "${names[i]}" "${files[i]}" "${edits[i]}" | tee -a "$work/table"; done
((${#patterns[@]})) || for page in "${pages[@]}"; do renew "$page"; done
! grep -q '| NONE |$' "$work/table" || fail "no test notices the defects with NONE"
