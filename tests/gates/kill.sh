#!/usr/bin/env bash
# The program is killed during a run, at each call that changes a file, and at random moments. This leaves no incomplete file under
# a final name, and existing goldens are unchanged.
# usage: kill.sh PROGRAM [N] (N is the number of kills per command, 50 by default; KILL_SEED, 1 by default, selects the moments)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
moments=${2:-50}
RANDOM=${KILL_SEED:-1}

# The reader of each file must accept every file under a final name.
read_it() {
  case $1 in
    */recording.h5) true ;; # no trace; compared by `whole`
    *.h5 | *.csv) "$program" compare "$1" "$1" ;;
    *.json) python3 -m json.tool "$1" ;;
    *.yaml) "$program" check "$1" ;;
    */junit.xml) [[ $(tail -n 1 -- "$1") == "</testsuites>" ]] ;;
    *.svg) [[ $(tail -c 7 -- "$1") == "</svg>" ]] ;; # $(...) removes the line end
    *.html) cmp -- <(tail -c 20 -- "$1") <(tail -c 20 -- "$root/report/page/dist/page.html") ;;
    *.part | *.golden | *.golden.next) true ;; # gaitlab test reads a complete golden
    *) printf 'an unknown kind of file\n' && false ;;
  esac
}
readable() {
  local file
  while IFS= read -r -d '' file; do quietly read_it "$file" || bad "unreadable: $file"; done < <(find "$1" -type f -print0)
}

# Files must equal those of an undisturbed run, except the summary, which contains computing times.
whole() {
  local file name
  for file in "$1"/*; do
    name=${file##*/}
    [[ -e $file && $name != *.part && $name != summary.json ]] || continue
    cmp -- "$file" "$2/$name" || bad "not the file of an undisturbed run: $file"
  done
}

count_state() {
  local folder=$1 what=nothing
  if compgen -G "$folder/.*.part" >/dev/null; then what="a .part file"
  elif [[ -e $folder/summary.json ]]; then what="a whole run"
  elif compgen -G "$folder/*" >/dev/null; then what="some of the files"
  fi
  states[$what]=$((${states[$what]:-0} + 1))
}

tell_states() {
  local text="" what
  for what in "${!states[@]}"; do text+="${text:+, }${states[$what]} left $what"; done
  kills_told "$1 ($text)"
}

# Kills runs with a fine trace in both formats, so that writing takes a large part of the time.
kill_runs() {
  local format out
  declare -A states=()
  local arguments=(run "$root/scenarios/caterpillar.yaml" --quiet --set duration=0.2 --set trace.period=2.5e-4)
  for format in csv h5; do cpu_time 0 "$program" "${arguments[@]}" --format "$format" --out "$work/whole-$format"; done
  kills "$moments"
  while kills_left; do
    ((tries % 2)) && format=csv || format=h5
    out=$work/run-$tries
    try_to_kill 0 "$took" "$program" "${arguments[@]}" --format "$format" --out "$out" && count_state "$out"
    [[ ! -d $out ]] || { readable "$out"; whole "$out" "$work/whole-$format"; }
    rm -rf -- "$out"
  done
  tell_states run
}

# Creates the scenario s.yaml with its golden in $work/golden, and the later, changed gait in $work/changed.yaml.
make_golden() {
  mkdir -p "$work/golden"
  sed 's/accuracy: 0.01$/accuracy: 0.001/' "$work/whole-h5/scenario.resolved.yaml" >"$work/golden/s.yaml"
  quietly "$program" approve "$work/golden/s.yaml" --reason "kill.sh: the first" ||
    { bad "approve failed, so killing it and test was not tested"; return 1; }
  cp -r -- "$work/golden" "$work/old"
  sed 's/amplitude: 0.6$/amplitude: 0.5/' "$work/golden/s.yaml" >"$work/changed.yaml"
  ! cmp -s -- "$work/golden/s.yaml" "$work/changed.yaml" || { bad "kill.sh cannot change the scenario"; return 1; }
}

# Kills tests of the changed gait, which fail and write a figure, a table and XML.
kill_tests() {
  local test=("$program" test "$work/changed.yaml" --golden "$work/golden/s.golden" --out "$work/figures")
  cpu_time 4 "${test[@]}"
  [[ -e $work/figures ]] || bad "test wrote no figure: it should have failed"
  kills "$moments"
  while kills_left; do
    rm -rf -- "$work/figures" "$work/junit.xml"
    try_to_kill 0 "$took" "${test[@]}" --junit "$work/junit.xml" || true
    diff -r "$work/old" "$work/golden" || bad "test, killed, changed the golden"
    [[ ! -d $work/figures ]] || readable "$work/figures"
    [[ ! -e $work/junit.xml ]] || read_it "$work/junit.xml" || bad "half a junit.xml"
  done
  kills_told test
}

# After a kill the golden is the old or the new golden and not a mixture: it must pass with the old or the new gait, which differ.
kill_approvals() {
  local old=0 new=0 half=0 of
  local golden=$work/golden/s.golden
  local approve=("$program" approve "$work/golden/s.yaml" --calibrate --reason "kill.sh: the second")
  cp -- "$work/changed.yaml" "$work/golden/s.yaml"
  cpu_time 0 "${approve[@]}"
  cp -r -- "$work/golden" "$work/new"
  expect 0 "${approve[@]}"
  cp -r -- "$work/golden" "$work/newer"
  kills "$moments"
  while kills_left; do
    # Every second kill acts on the files that the previous kill left.
    if ((tries % 2 == 0)); then
      rm -rf -- "$golden"
      cp -r -- "$work/old/s.golden" "$golden"
    fi
    try_to_kill 0 "$took" "${approve[@]}" || true
    readable "$golden"
    if cmp -s -- "$golden/golden.json" "$work/old/s.golden/golden.json"; then of=old old=$((old + 1))
    elif cmp -s -- "$golden/golden.json" "$work/newer/s.golden/golden.json"; then of=newer new=$((new + 1))
    elif cmp -s -- "$golden/golden.json" "$work/new/s.golden/golden.json"; then of=new new=$((new + 1))
    else bad "approve, killed, left a golden that is neither the old nor the new one"; continue
    fi
    diff -rq "$work/$of/s.golden" "$golden" >/dev/null || half=$((half + 1))
    quietly "$program" test "$work/$of/s.yaml" --golden "$golden" --out "$work/out-$tries" ||
      bad "approve, killed, left a golden ($of) that fails with its own scenario"
  done
  kills_told "approve ($old left the old golden, $new the new one; $half of them with files in between)"
}

# kill_writer NAME ARGUMENT...: the files after a kill must equal those of an undisturbed command, or a part of them. OUT in the
# arguments is replaced by the folder.
kill_writer() {
  local name=$1 out
  declare -A states=()
  shift
  cpu_time 0 "$program" "${@/OUT/$work/expected-$name}"
  kills "$moments"
  while kills_left; do
    out=$work/$name-$tries
    try_to_kill 0 "$took" "$program" "${@/OUT/$out}" && count_state "$out"
    [[ ! -d $out ]] || whole "$out" "$work/expected-$name"
    rm -rf -- "$out"
  done
  tell_states "$name"
}

# Creates a small scenario in a folder without other files.
make_small() {
  mkdir "$work/small" && cd "$work/small"
  cat >s.yaml <<TEXT
gaitlab: 1
plugins: [$(plugin waits)]
robot: {modules: $root/scenarios/modules/mtran.yaml, base: fixed}
ground: {type: none}
contact: {on: none}
physics: {engine: articulated, accuracy: 0.001}
cpg: {type: waits, amplitude: 0.6}
duration: 0.3
TEXT
}
restore() {
  [[ $PWD == "$work"/* ]] || fail "$PWD is not in the temporary folder"
  find . -mindepth 1 -delete
  cp -r -- "$work/before/." .
}

# in_the_middle NAME COMMAND...: a command that is killed during its run leaves no new file, and existing files are unchanged.
in_the_middle() {
  cp -r -- . "$work/before"
  kill_in_the_middle "$@"
  find . -type d -empty -delete
  diff -r . "$work/before" || bad "$1, killed in the middle of a run, changed what was there"
  restore
  rm -rf -- "$work/before"
}

# at_every_call NAME CODE COMMAND...: kills a command at each call that changes files, and lets one such call, or all from one
# on, fail. Every file must be unchanged or as after an undisturbed command. The command of `after`, if any, must still succeed.
sums() { find . -type f -exec sha256sum -- {} +; }
check_left() {
  local file
  while read -r _ file; do
    case $file in
      *.part | *.golden.next | ./.new.*) ;; # not a final name
      */summary.json | */junit.xml) quietly read_it "$file" || bad "$1: it left half of $file" ;; # contain times
      *) bad "$1: it left another $file" ;;
    esac
  done < <(sums | grep -vxFf "$work/sums")
  for file in "${there[@]}"; do [[ -e $file ]] || bad "$1: it took $file away"; done
  ((${#after[@]} == 0)) || quietly "${after[@]}" || bad "$1: ${after[*]}"
}
at_every_call() {
  local calls call how there first=1 stride=1
  [[ -z ${GAITLAB_QUARTER:-} ]] || first=$((1 + GAITLAB_QUARTER)) stride=4 # in CI every fourth call
  cp -r -- . "$work/before"
  mapfile -t -d '' there < <(find . -type f -print0)
  sums >"$work/sums"
  expect "$2" "${@:3}"
  sums >>"$work/sums"
  for ((calls = first;; calls += stride)); do
    restore
    kill_at_call "$calls" "${@:3}" || break
    check_left "$1, killed at call $calls"
  done
  ((code == $2)) || bad "$1: exit code $code at call $calls, expected $2"
  for ((call = first; call < calls; call += stride)); do
    for how in once on; do
      restore
      fail_at_call "$call" "$how" "${@:3}"
      ((code == 1 || code == 2 || code == $2)) || bad "$1, call $call fails $how: exit code $code"
      check_left "$1, call $call fails $how"
    done
  done
  restore
  expect "$2" "${@:3}"
  rm -rf -- "$work/before"
  ok "$1, of which $(((calls - first) / stride)) calls end or fail: files as they were, or whole"
}

passes_old_or_new() {
  local scenario
  for scenario in s old; do
    rm -rf -- "$work/tested"
    "$program" test "$scenario.yaml" --golden s.golden --out "$work/tested" && return
  done
  return 1
}

# again COMMAND...: the folder out that seems empty to a user can be used.
again() { [[ -n $(ls out 2>/dev/null) ]] || "$@"; }

kill_small() {
  local after=()
  make_small
  sed 's/amplitude: 0.6/amplitude: 0.5/' s.yaml >t.yaml
  in_the_middle run "$program" run s.yaml --out out
  after=(again "$program" run s.yaml --quiet --out out)
  at_every_call run 0 "${after[@]:1}"
  after=()
  mv out "$work/run"
  in_the_middle rerun "$program" rerun "$work/run" --plugin "$(plugin waits)" --out out
  at_every_call rerun 0 "$program" rerun "$work/run" --plugin "$(plugin waits)" --quiet --out out
  rm -r out
  in_the_middle swap "$program" swap s.yaml --cpg waits,sine --out out
  after=(again "$program" swap s.yaml --cpg "waits,sine" --out out)
  at_every_call swap 0 "${after[@]:1}"
  after=()
  rm -r out
  at_every_call csv 0 "$program" export "$work/run" --plugin "$(plugin waits)" --to csv run.csv
  at_every_call gltf 0 "$program" export "$work/run" --plugin "$(plugin waits)" --to gltf run.glb
  at_every_call mjcf 0 "$program" export s.yaml --plugins-from-scenario --to mjcf s.xml
  at_every_call "new plugin" 0 "$program" new plugin cpg mine --out new
  rm -r run.csv run.glb s.xml new
  in_the_middle approve "$program" approve s.yaml --reason first
  after=("$program" approve s.yaml --reason first)
  at_every_call approve 0 "${after[@]}"
  after=()
  in_the_middle "approve --calibrate" "$program" approve s.yaml --calibrate --reason second
  after=("$program" test s.yaml --out "$work/tested")
  at_every_call "approve --calibrate" 0 "$program" approve s.yaml --calibrate --reason second
  cp s.yaml old.yaml
  sed -i 's/amplitude: 0.6/amplitude: 0.62/' s.yaml
  after=(passes_old_or_new)
  at_every_call "approve of another gait" 0 "$program" approve s.yaml --reason third
  after=()
  in_the_middle test "$program" test s.yaml --out out
  at_every_call test 4 "$program" test old.yaml --golden s.golden --out out --junit junit.xml
  cd -- "$work"
  ok "run, rerun, swap, approve and test, killed in the middle of a run: nothing is left, and nothing changed"
}

# The child that tries a plugin ends with the program, also if the plugin never returns.
kill_trial() {
  local process child end=$((SECONDS + 600))
  printf 'gaitlab: 1\nplugins: [%s]\nrobot: {modules: mtran}\nduration: 1\n' "$(plugin spins_at_load)" >"$work/spins.yaml"
  GAITLAB_PAUSES=$work/child "$program" check "$work/spins.yaml" --plugins-from-scenario >"$work/log" 2>&1 &
  process=$!
  wait_for "$process" "the trial of a plugin" test -s "$work/child"
  child=$(<"$work/child")
  kill -9 "$process"
  wait "$process" 2>/dev/null || true
  while kill -0 "$child" 2>/dev/null && [[ $(ps -o stat= -p "$child") != Z* ]] && ((SECONDS < end)); do sleep 0.05; done
  if ((SECONDS < end)); then ok "check, killed while it tries a plugin: the child ends"; else bad "check, killed while it tries a plugin: its child goes on"; fi
  kill -9 "$child" 2>/dev/null || true
}

kill_trial
kill_small
kill_runs
kill_writer rerun rerun "$work/whole-h5" --quiet --out OUT
kill_writer swap swap "$root/scenarios/pendulum.yaml" --quiet --set duration=0.2 --cpg phase_oscillator,hopf --out OUT
if make_golden; then
  kill_tests
  kill_approvals
fi
verdict
