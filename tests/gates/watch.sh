#!/usr/bin/env bash
# `gaitlab watch` runs again when the scenario or its module is saved. After an error the previous run remains; other files are
# kept.
# usage: watch.sh PROGRAM
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
cd -- "$work"
cp -r -- "$root/scenarios/modules" .
cat >two.yaml <<'END'
gaitlab: 1
robot: {modules: modules/mtran.yaml, docks: [[1, 1, 4, 0, 0]]}
contact: {on: all}
physics: {engine: articulated}
cpg: {type: phase_oscillator, frequency: 1, amplitude: 0.6}
duration: 0.2
END
# begin FILE [OPTIONS]: starts a watch. number, height: print the numbers in stamp.svg.
begin() {
  "$program" watch "$@" --out seen >out 2>err &
  watcher=$!
}
trap 'kill "$watcher" 2>/dev/null || true; rm -rf -- "$work"' EXIT
number() { sed -n 's/.* width="\([0-9]*\)".*/\1/p' seen/stamp.svg 2>/dev/null; }
height() { sed -n 's/.* height="\([0-9]*\)".*/\1/p' seen/stamp.svg 2>/dev/null; }
runs() { grep -c 'waiting for a change' err || true; }
have_runs() { (($(runs) == $1)); }
is_height() { [[ $(height) == "$1" ]]; }
in_page() { grep -q "data-watch=\"$(number)\"" seen/report.html; }

begin two.yaml
wait_for "$watcher" "run 1" have_runs 1
first=$(number)
in_page && is_height 1 || bad "the page of the first run has no number $first"
[[ -s seen/trace.h5 && -s seen/summary.json && ! -e seen/.next && ! -e seen/.read ]] || bad "files: $(ls -A . seen)"
grep -q 'waiting for a change of 2 files' err || bad "the scenario and its module are not both watched: $(<err)"
grep -q 'seen/report.html' out || bad "the page is not named"
code=0
"$program" watch two.yaml --out seen >/dev/null 2>second || code=$?
((code == 2)) && grep -q 'being written by another process' second || bad "a second watch of a folder: exit code $code, $(<second)"

echo mine >seen/notes.txt
sed -i 's/amplitude: 0.6/amplitude: 0.5/' two.yaml
wait_for "$watcher" "run 2" have_runs 2
(($(number) == first + 1)) && in_page || bad "a saved scenario: run $(number) after $first"
grep -q 'amplitude: 0.5' seen/scenario.resolved.yaml || bad "the run is not of the saved scenario"

sed -i 's/^name:/# saved again\n&/' modules/mtran.yaml
wait_for "$watcher" "run 3" have_runs 3
(($(number) == first + 2)) || bad "a saved module: run $(number) after $first"

echo 'duration: -1' >>two.yaml
wait_for "$watcher" "run 4" have_runs 4
is_height 2 && (($(number) == first + 2)) || bad "an error: stamp $(<seen/stamp.svg)"
grep -q "two.yaml:7:" err || bad "the error is not printed"
grep -q ">two.yaml:7:.*</text>" seen/error.svg || bad "the error is not shown: $(<seen/error.svg)"
sed -i '$d' two.yaml
# An editor that writes a new file and renames it.
cp -- two.yaml saved && sed -i 's/0.5/0.4/' saved && mv -- saved two.yaml
wait_for "$watcher" "run 5" have_runs 5
is_height 1 && in_page && ! grep -q "<text" seen/error.svg || bad "mended: stamp $(<seen/stamp.svg), $(ls seen)"

kill -TERM "$watcher" # (a background process of a script ignores SIGINT)
code=0
wait "$watcher" || code=$?
((code == 0)) || bad "interrupted: exit code $code"
[[ ! -e seen/.next && $(<seen/notes.txt) == mine ]] || bad "the folder has $(ls -A seen)"
ok "watch: scenario, module, error, editor"

# Another process continues with the number of the page, even if its first run is an error. A signal ends it in the middle of a
# run.
last=$(number)
echo 'duration: -1' >>two.yaml
begin two.yaml
wait_for "$watcher" "an error" have_runs 1
is_height 2 && [[ $(number) == "$last" ]] && in_page || bad "an error at the start: stamp $(<seen/stamp.svg) after $last"
sed -i '$d' two.yaml
wait_for "$watcher" "a run after the error" have_runs 2
is_height 1 && (($(number) == last + 1)) && in_page || bad "after the error: stamp $(<seen/stamp.svg)"
sed -i 's/^duration:.*/duration: 20000/' two.yaml
wait_for "$watcher" "a long run" test -d seen/.next
kill -TERM "$watcher"
code=0
wait "$watcher" || code=$?
((code == 0)) && [[ ! -e seen/.next ]] || bad "ended within a run: exit code $code, $(ls -A seen)"
sed -i 's/^duration:.*/duration: 0.2/' two.yaml
ok "watch: begun again, and ended within a run"

# A watch that is killed, with its run, at each call that changes a file of its first run can be started again in the same folder.
sed 's/^duration:.*/duration: 0.01/' two.yaml >brief.yaml
ended_or_waiting() { ! kill -0 "$watcher" 2>/dev/null || have_runs 1; }
end_watch() {
  code=0
  kill -TERM "$watcher" 2>/dev/null || true
  wait "$watcher" 2>/dev/null || code=$?
}
for ((calls = 1;; ++calls)); do
  rm -rf -- seen
  : >err # an earlier line would end the wait
  # The library is preloaded into the program alone, because a build with sanitizers needs symbols that setsid lacks.
  setsid env LD_PRELOAD="$(plugin dies_at_call)" GAITLAB_DIES_AT=$calls GAITLAB_DIES_TOGETHER=1 "$program" watch brief.yaml --out seen >out 2>err &
  watcher=$!
  wait_for "$watcher" "a kill or a run" ended_or_waiting
  end_watch
  ((code == 128 + 9)) || break
  : >err
  begin brief.yaml
  wait_for "$watcher" "a run after a kill at call $calls" have_runs 1
  in_page && is_height 1 && [[ ! -e seen/.next && ! -e seen/.read ]] || bad "killed at call $calls: $(ls -A seen)"
  end_watch
  ((code == 0)) || bad "watch after a kill at call $calls: exit code $code, $(<err)"
done
((code == 0)) || bad "watch without a kill: exit code $code, $(<err)"
ok "watch: killed at each of $((calls - 1)) calls of its first run, and begun again"

mkdir other icons && touch other/thesis.txt && echo '<svg xmlns="http://www.w3.org/2000/svg" width="16" height="16"/>' >icons/stamp.svg
code=0
"$program" watch two.yaml --out icons >/dev/null 2>err || code=$?
((code == 2)) && [[ $(ls icons) == stamp.svg ]] || bad "a folder with another stamp.svg: exit code $code"
code=0
"$program" watch two.yaml --out other >/dev/null 2>err || code=$?
((code == 2)) && [[ $(ls other) == thesis.txt ]] && grep -q 'is not a folder of gaitlab watch' err || bad "a folder of something else: exit code $code"
for file in absent.yaml modules/mtran.yaml; do
  code=0
  "$program" watch "$file" --out fresh >/dev/null 2>err || code=$?
  ((code == 2)) && [[ ! -e fresh ]] || bad "watch $file: exit code $code, $(<err)"
done
ok "watch: other folders and files are refused"

# A copy of a shipped scenario, alone in a folder.
mkdir copy && cp -- "$root/scenarios/hexapod.yaml" copy/my.yaml && cd copy
begin my.yaml --set duration=0.2 --set physics.engine=articulated
wait_for "$watcher" "a run of a copy" have_runs 1
is_height 1 && in_page || bad "a copy of scenarios/hexapod.yaml: $(<err)"
kill -TERM "$watcher"
wait "$watcher" || true
ok "watch: a copy of a shipped scenario"
verdict
