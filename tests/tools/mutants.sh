#!/usr/bin/env bash
# Table of the sensitivity of goldens, as effect divided by band. Small changes of the shipped scenarios must fail by at least two bands.
# Changes without a meaning must have less than half of every band.
# usage: tests/tools/mutants.sh PROGRAM [OTHER_PROGRAM...]   (OTHER_PROGRAM is built by another compiler or with other flags)
# Takes minutes. JOBS=N is the number of parallel simulations (default all cores), ROBOTS="caterpillar hexapod" selects the scenarios.
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
shift
others=("$@")
scenarios=$root/scenarios
jobs=${JOBS:-$(nproc)}
read -r -a robots <<<"${ROBOTS:-caterpillar hexapod}"
least=2 most=0.5

cp -r -- "$scenarios/modules" "$scenarios/robots" "$work/"

# --- cases: each has a number, robot, kind (mutant, innocent, told), name and program; its scenario is $work/NUMBER.yaml

count=0
declare -a robot_of kind_of name_of program_of

# new ROBOT KIND NAME [PROGRAM]: adds a case with a copy of the scenario in $file, which the caller then edits.
new() {
  count=$((count + 1))
  robot_of[count]=$1 kind_of[count]=$2 name_of[count]=$3 program_of[count]=${4:-$program}
  file=$work/$count.yaml
  cp -- "$scenarios/$1.yaml" "$file"
}

# key SECTION KEY VALUE: sets a value in $file, whose sections are block maps. Fails if the file does not change.
key() {
  local before
  before=$(cat -- "$file")
  if grep -qE "^ +$2:" "$file"; then sed -i -E "s|^( +$2:).*|\1 $3|" "$file"
  elif grep -qE "^$1:" "$file"; then sed -i -E "s|^$1:.*|&\n  $2: $3|" "$file"
  else printf '\n%s: {%s: %s}\n' "$1" "$2" "$3" >>"$file"
  fi
  [[ $(cat -- "$file") != "$before" ]] || fail "$file: nothing to edit for $1.$2"
}

# turned BUILD ROW TURNED_ROW: writes a build file in which one dock is turned by a quarter.
turned() {
  sed "s/^$2\$/$3/" "$work/robots/$1" >"$work/robots/turned-$1"
  ! cmp -s "$work/robots/$1" "$work/robots/turned-$1" || fail "no row $2 in $1"
  key robot build "robots/turned-$1"
}

# Prints the compiler and the folder of a build. The name of the folder should indicate its flags.
build_of() {
  local build
  build=$(basename -- "$(dirname -- "$(dirname -- "$(readlink -f -- "$1")")")")
  printf '%s: %s' "$build" "$("$1" --version | sed -E 's/.*[(]([^;)]*).*/\1/')"
}

# Finds the first doubled step whose error in `converge` exceeds 1 %. All smaller doublings also appear in the table.
doubled_steps() {
  local robot=$1 step=2.5e-5 error note
  while :; do
    step=$(awk -v h="$step" 'BEGIN { printf "%g", 2 * h }')
    if ! "$program" converge "$scenarios/$robot.yaml" --quiet --halvings 1 --set "physics.step=$step" >"$work/converge" 2>&1; then
      notes+=("$robot, step $step s: refused: $(sed -E 's/.*error: //' "$work/converge" | head -n 1)")
      return 0
    fi
    error=$(awk '$1 == "worst:" { print $3 }' "$work/converge")
    note="$robot, step $step s: converge error $error %"
    if awk -v e="$error" 'BEGIN { exit !(e > 1) }'; then
      new "$robot" mutant "step $step s (converge error $error %)"
      key physics step "$step"
      notes+=("$note")
      return 0
    fi
    new "$robot" told "step $step s (converge error $error %)"
    key physics step "$step"
    notes+=("$note, not above 1 %: no mutant")
  done
}

sed -E 's/^name: mtran$/name: heavier/; 0,/mass: 0[.]16$/s//mass: 0.1632/' "$work/modules/mtran.yaml" >"$work/modules/heavier.yaml"

declare -a notes=()
for robot in "${robots[@]}"; do
  new "$robot" mutant "motor constant Kt +1 %" && key actuator Kt 0.0039895
  new "$robot" mutant "motor constant Ks +1 %" && key actuator Ks 0.0039895
  new "$robot" mutant "m3/active: mass +2 %" && key robot modules "{default: mtran, 3: modules/heavier.yaml}"
  new "$robot" mutant "Kp +2 %" && key controller Kp 102
  new "$robot" mutant "friction +5 %" && key ground friction 0.84
  new "$robot" mutant "contact stiffness +20 %" && key contact stiffness 12000
  case $robot in
    caterpillar)
      new "$robot" mutant "one phase lag +1 %" && key cpg phase_lag "{default: 1.2, m4/active: 1.212}"
      new "$robot" mutant "one dock turned" && turned caterpillar-8.dat "1 4 4 3 0" "1 4 4 3 1"
      ;;
    *)
      new "$robot" mutant "amplitude +1 %" && key cpg amplitude 0.404
      [[ $robot != hexapod ]] || { new "$robot" mutant "one dock turned" && turned hexapod.dat "1 4 4 3 3" "1 4 4 3 2"; }
      ;;
  esac
  doubled_steps "$robot"
  new "$robot" innocent "nothing"
  new "$robot" innocent "half the step" && key physics step 1.25e-5
  for other in "${others[@]}"; do
    new "$robot" innocent "$(build_of "$other")" "$other"
  done
done

# --- runs

for ((i = 1; i <= count; ++i)); do
  while (($(jobs -rp | wc -l) >= jobs)); do wait -n || true; done
  (
    code=0
    "${program_of[i]}" test "$work/$i.yaml" --golden "$scenarios/${robot_of[i]}.golden" --out "$work/out-$i" \
      >"$work/$i.out" 2>"$work/$i.err" || code=$?
    printf '%s\n' "$code" >"$work/$i.code"
  ) &
done
wait

# --- the table

printf '%-12s %-9s %-40s %4s  %-18s %9s  %-30s %9s  %s\n' robot kind change exit "worst column" RMS/band "worst number" chg/band is
for ((i = 1; i <= count; ++i)); do
  code=$(cat -- "$work/$i.code")
  IFS='|' read -r _ column ratio number change _ < <(sed -nE '2s/  +/|/gp' "$work/$i.out") || true
  if [[ $code != 0 && $code != 4 ]]; then
    verdict="BAD: $(head -n 1 "$work/$i.err")" column=- ratio=- number=- change=-
  else
    verdict=$(awk -v kind="${kind_of[i]}" -v code="$code" -v r="$ratio" -v c="$change" -v least=$least -v most=$most 'BEGIN {
      if (kind == "mutant") print code == 4 && (r >= least || c >= least) ? "seen" : "BAD: not seen"
      else if (kind == "innocent") print code == 0 && r <= most && c <= most ? "innocent" : "BAD: not innocent"
      else print code == 4 ? "seen" : "not seen" }')
  fi
  [[ $verdict != BAD* ]] || failed=1
  printf '%-12s %-9s %-40s %4s  %-18s %9s  %-30s %9s  %s\n' "${robot_of[i]}" "${kind_of[i]}" "${name_of[i]}" "$code" \
    "$column" "$ratio" "$number" "$change" "$verdict"
done
((${#notes[@]} == 0)) || printf '%s\n' "" "${notes[@]}"
((failed == 0))
