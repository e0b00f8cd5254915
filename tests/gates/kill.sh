#!/usr/bin/env bash
# kill -9 at random moments: no half file under a final name, an existing golden as it was.
# usage: kill.sh PROGRAM [N] (N moments a command, 50; KILL_SEED, 1: another choice of moments)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
moments=${2:-50}
RANDOM=${KILL_SEED:-1}

now() { date +%s%N; }

# Milliseconds that a command takes, left alone.
duration() {
  local start
  start=$(now)
  expect 0 "$@"
  printf '%d' $((($(now) - start) / 1000000))
}

# kill_after MILLISECONDS COMMAND...: ended by SIGKILL, or done before.
kill_after() {
  local process wait_ms=$1
  shift
  "$@" >/dev/null 2>&1 &
  process=$!
  sleep "$(printf '%d.%03d' $((wait_ms / 1000)) $((wait_ms % 1000)))"
  kill -9 "$process" 2>/dev/null || true
  wait "$process" 2>/dev/null || true
}

# Sets `moment`: between the start and a little after the end. (Not printed: in a subshell RANDOM would not go on.)
draw_moment() { moment=$((RANDOM * ($1 + $1 / 10 + 1) / 32768)); }

# Every file under a final name must be readable by what reads it.
read_it() {
  case $1 in
    */recording.h5) true ;; # `whole` compares it; it is not a trace
    *.h5 | *.csv) "$program" compare "$1" "$1" ;;
    *.json) python3 -m json.tool "$1" ;;
    *.yaml) "$program" check "$1" ;;
    *.svg) [[ $(tail -c 7 -- "$1") == "</svg>" ]] ;; # $(...) takes off the line end
    *.html) cmp -- <(tail -c 20 -- "$1") <(tail -c 20 -- "$root/report/page/dist/page.html") ;;
    *.part | *.golden | *.golden.next) true ;; # a golden is read as a whole, by gaitlab test
    *) printf 'an unknown kind of file\n' && false ;;
  esac
}
readable() {
  local file
  while IFS= read -r -d '' file; do quietly read_it "$file" || bad "unreadable: $file"; done < <(find "$1" -type f -print0)
}

# And as they are in a run that nobody killed (the summary holds times).
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
  printf '%-8s killed %d times within %d ms: %s\n' "$1" "$moments" "$2" "$text"
}

# A fine trace, so that writing takes a good part of the time; in both formats.
kill_runs() {
  local i format time out
  declare -A states=()
  local arguments=(run "$root/scenarios/caterpillar.yaml" --quiet --set duration=0.2 --set trace.period=2.5e-4)
  for format in csv h5; do
    time=$(duration "$program" "${arguments[@]}" --format "$format" --out "$work/whole-$format")
  done
  for ((i = 0; i < moments; ++i)); do
    ((i % 2)) && format=csv || format=h5
    out=$work/run-$i
    draw_moment "$time"
    kill_after "$moment" "$program" "${arguments[@]}" --format "$format" --out "$out"
    [[ ! -d $out ]] || { readable "$out"; whole "$out" "$work/whole-$format"; }
    count_state "$out"
    rm -rf -- "$out"
  done
  tell_states run "$time"
}

# In $work/golden a scenario s.yaml with its golden, and in $work/changed.yaml the gait that it is changed to later.
make_golden() {
  mkdir -p "$work/golden"
  mv -- "$work/whole-h5/scenario.resolved.yaml" "$work/golden/s.yaml"
  quietly "$program" approve "$work/golden/s.yaml" --reason "kill.sh: the first" ||
    { bad "approve failed, so killing it and test was not tested"; return 1; }
  cp -r -- "$work/golden" "$work/old"
  sed 's/amplitude: 0.6$/amplitude: 0.5/' "$work/golden/s.yaml" >"$work/changed.yaml"
  ! cmp -s -- "$work/golden/s.yaml" "$work/changed.yaml" || { bad "kill.sh cannot change the scenario"; return 1; }
}

# Of the changed gait, so that it fails and writes a figure, a table and XML.
kill_tests() {
  local i time
  local test=("$program" test "$work/changed.yaml" --golden "$work/golden/s.golden")
  time=$(start=$(now) && ("${test[@]}" --out "$work/figures" >/dev/null 2>&1 || true) && printf '%d' $((($(now) - start) / 1000000)))
  [[ -e $work/figures ]] || bad "test wrote no figure: it should have failed"
  for ((i = 0; i < moments; ++i)); do
    rm -rf -- "$work/figures" "$work/junit.xml"
    draw_moment "$time"
    kill_after "$moment" "${test[@]}" --out "$work/figures" --junit "$work/junit.xml"
    diff -r "$work/old" "$work/golden" || bad "test, killed, changed the golden"
    [[ ! -d $work/figures ]] || readable "$work/figures"
    [[ ! -e $work/junit.xml || $(tail -n 1 -- "$work/junit.xml") == "</testsuites>" ]] || bad "half a junit.xml"
  done
  printf '%-8s killed %d times within %d ms\n' test "$moments" "$time"
}

# The golden is the old one or the new one, never a mixture: it must pass with its own gait, and the gaits differ.
kill_approvals() {
  local i time old=0 new=0 half=0 of
  local golden=$work/golden/s.golden
  local approve=("$program" approve "$work/golden/s.yaml" --calibrate --reason "kill.sh: the second")
  cp -- "$work/changed.yaml" "$work/golden/s.yaml"
  time=$(duration "${approve[@]}")
  cp -r -- "$work/golden" "$work/new"
  expect 0 "${approve[@]}"
  cp -r -- "$work/golden" "$work/newer"
  for ((i = 0; i < moments; ++i)); do
    # Every other kill meets what the last one left.
    if ((i % 2 == 0)); then
      rm -rf -- "$golden"
      cp -r -- "$work/old/s.golden" "$golden"
    fi
    draw_moment "$time"
    ((i % 4 > 1)) || moment=$((time - moment * 20 / time)) # every other one near the end, where the files are written
    kill_after "$moment" "${approve[@]}"
    readable "$golden"
    if cmp -s -- "$golden/golden.json" "$work/old/s.golden/golden.json"; then of=old old=$((old + 1))
    elif cmp -s -- "$golden/golden.json" "$work/newer/s.golden/golden.json"; then of=newer new=$((new + 1))
    elif cmp -s -- "$golden/golden.json" "$work/new/s.golden/golden.json"; then of=new new=$((new + 1))
    else bad "approve, killed, left a golden that is neither the old nor the new one"; continue
    fi
    diff -rq "$work/$of/s.golden" "$golden" >/dev/null || half=$((half + 1))
    quietly "$program" test "$work/$of/s.yaml" --golden "$golden" --out "$work/out-$i" ||
      bad "approve, killed, left a golden ($of) that fails with its own scenario"
  done
  printf '%-8s killed %d times within %d ms: %d left the old golden, %d the new one; %d of them with files in between\n' \
    approve "$moments" "$time" "$old" "$new" "$half"
}

# What is left must be what an undisturbed command leaves, or less of it: kill_writer NAME ARGUMENT...; OUT stands for the target.
kill_writer() {
  local i name=$1 time left=0 out
  shift
  time=$(duration "$program" "${@/OUT/$work/expected-$name}")
  for ((i = 0; i < moments; ++i)); do
    out=$work/one/$name-$i
    mkdir -p "$work/one"
    draw_moment "$time"
    kill_after "$moment" "$program" "${@/OUT/$out}"
    if [[ -f $out ]]; then cmp -- "$out" "$work/expected-$name" || bad "$name, killed, left half a file"
    elif [[ -d $out ]]; then whole "$out" "$work/expected-$name"
    fi
    # `new plugin` has one rename for all of its files.
    [[ $name != new || ! -e $out ]] || diff -rq "$out" "$work/expected-$name" || bad "new plugin, killed, left a part"
    [[ ! -e $out ]] || left=$((left + 1))
    rm -rf -- "$work/one"
  done
  printf '%-8s killed %d times within %d ms: %d left a target, none of them a wrong one\n' "$name" "$moments" "$time" "$left"
}

kill_writers() {
  kill_writer rerun rerun "$work/whole-h5" --quiet --out OUT
  kill_writer swap swap "$root/scenarios/pendulum.yaml" --quiet --set duration=0.2 --cpg phase_oscillator,hopf --out OUT
  kill_writer csv export "$work/whole-h5" --to csv OUT
  kill_writer gltf export "$work/whole-h5" --to gltf OUT
  kill_writer mjcf export "$root/scenarios/caterpillar.yaml" --to mjcf OUT
  kill_writer new new plugin cpg mine --out OUT
}

kill_runs
kill_writers
if make_golden; then
  kill_tests
  kill_approvals
fi
verdict
