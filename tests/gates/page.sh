#!/usr/bin/env bash
# Report page: the checks of types, arrows, eslint and prettier pass, the committed bundle equals the built sources, and the page works in a
# browser.
# usage: page.sh PROGRAM_BUILD_DIR     (exit code 77 without node, npm, Chromium or packages, which is an error with CI=true)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
source "$root/tests/node.sh"
build=$(readlink -f -- "$1") program=$(readlink -f -- "$1")/bin/gaitlab
needs_browser "$build" "the report page"

# The page is built outside the sources, so that the committed bundle is not overwritten before the comparison.
page=$work/page
mkdir -p "$page"
(cd -- "$root/report/page" && cp -r -- package.json package-lock.json tsconfig.json eslint.config.mjs .prettierrc.json .prettierignore arrows.mjs build.mjs \
  src "$page")
ln -s -- "$NODE_MODULES" "$page/node_modules"
cd -- "$page"
expect 0 npm run --silent check
ok "report/page: types, arrows, eslint, prettier"
expect 0 node build.mjs
for file in dist/page.html LICENSES.txt; do
  cmp -- "$root/report/page/$file" "$file" ||
    fail "report/page/$file is stale: in report/page, npm ci --ignore-scripts && node build.mjs, and commit it"
done
size=$(stat --format=%s dist/page.html)
((size <= 800000)) || fail "the page without a run has $size bytes, more than 800000"
ok "report/page/dist/page.html is what its sources give, $size bytes"

cd -- "$work"
walk=("$root/scenarios/hexapod.yaml" --set duration=4 --set physics.engine=articulated --quiet)
expect 0 "$program" run "${walk[@]}" --set duration=8 --set 'trace.columns=[joint.*, base.*, com.*, contact.*, body.*]' --out feasible
expect 0 "$program" export feasible --to csv trace.csv
fast=("${walk[@]}" --set cpg.frequency=1.2 --set cpg.amplitude=0.6 --demand)
expect 0 "$program" run "${fast[@]}" --out infeasible
# Runs with too little current, with a robot that falls, and with ideal torque sources, whose commands are in N m.
crawl=("$root/scenarios/caterpillar.yaml" --set physics.engine=articulated --quiet)
expect 0 "$program" run "${crawl[@]}" --set actuator.i_max=0.35 --set duration=14 --out current
expect 0 "$program" remedy current --by friction --no-report
# A remedy with a map, on which the gaits with low frequency and amplitude are feasible.
cp -r -- current cured
hash=$(python3 -c 'import json, sys; print(json.load(open("current/remedy.json"))["scenario"])')
python3 - "$hash" >cured/remedy.json <<'END'
import json, sys
cells = [{"verdict": "feasible" if f < 6 and a < 6 else "infeasible", "margin": 0.1, "speed": f * a / 1000, "weakest": "current of <m1>"}
         for a in range(13) for f in range(13)]
one = {"now": 0.25, "unit": "Hz"}, {"now": None, "unit": "rad"}
print(json.dumps({"format": 1, "verdict": "infeasible", "scenario": sys.argv[1], "text": ["feasible with i_max >= 0.719 A", "not by Kp <b>"], "tones": ["good", "plain"], "runs": 200,
                  "map": {"factors": [5 ** (k / 6 - 1) for k in range(13)], "frequency": one[0], "amplitude": one[1], "cells": cells}}))
END
expect 0 "$program" report cured --page cured.html
expect 0 "$program" run "${crawl[@]}" --set duration=5 --set robot.position='[0, 0, 0.4]' --set robot.orientation='[0, -1.4, 0]' --set contact.on=all --out fall
expect 0 "$program" run "${crawl[@]}" --set duration=2 --set actuator.type=torque --set 'controller={type: pid, unit: N m, Kp: 5, Kd: 0.05}' --out torque
expect 0 "$program" run "$root/scenarios/pendulum.yaml" --set duration=2 --quiet --out open
expect 0 "$program" check "$root/scenarios/hexapod.yaml" --quiet --page built.html
# A module whose source would end a script element and begin a comment.
cp -r -- "$root/scenarios" .
sed -i 's,^source: .*,source: "</script><script>window.taken = 1</script><!--",' scenarios/modules/mtran.yaml
expect 0 "$program" run scenarios/caterpillar.yaml --set duration=0.5 --set physics.engine=articulated --quiet --out markup
grep -q 'window.taken' markup/scenario.resolved.yaml || fail "the scenario has no markup in it"
# The same module with a motor that has 1 % more torque, so that the run leaves the bands of its golden.
sed -i 's,^  Kt: 0.00395 ,  Kt: 0.0039895 ,' scenarios/modules/mtran.yaml
expect 4 "$program" test scenarios/caterpillar.yaml --out strayed
# A robot that leaves the permitted range of positions after 0.1 s.
away=(--set ground.type=none --set 'robot.position=[99000, 0, 1]' --set robot.on_ground=false --set 'initial.base_velocity=[9999, 0, 0]')
expect 1 "$program" run "${walk[@]}" "${away[@]}" --set duration=1 --out failed
expect 0 "$program" run "$root/scenarios/caterpillar.yaml" --set duration=2 --set physics.engine=articulated --set trace.period=0.02 --quiet --format csv --out csv
cp -r -- csv old
rm old/recording.h5 # leaves only the rows
expect 0 "$program" report old --page old.html
cat >ball.yaml <<'END'
gaitlab_module: 1
name: ball
bodies:
  ball: {mass: 1, com: [0, 0, 0], inertia: [0.001, 0.001, 0.001, 0, 0, 0], shape: [{sphere: 0.05}], source: chosen}
hinges: []
faces: []
contacts: {feet: [], all: [{body: ball, sphere: [0, 0, 0], radius: 0.05}]}
END
cat >jointless.yaml <<'END'
gaitlab: 1
robot: {modules: ball.yaml, position: [0, 0, 0.2]}
contact: {on: all}
actuator: {type: none}
duration: 0.5
END
expect 0 "$program" run jointless.yaml --quiet --out jointless
expect 0 "$program" check jointless.yaml --quiet --page built_ball.html
# Robots with hinges without a motor: joint 0 of two joints, and the only joint.
cp -- "$root/tests/data/castor-first.yaml" castor.yaml
sed -e '/name: arm/d' -e '/upper:/d' -e '/^cpg:/d' -e 's,^contact:,initial: {angles: 0.5}\n&,' castor.yaml >motorless.yaml
expect 0 "$program" run castor.yaml --quiet --out castor
expect 0 "$program" run motorless.yaml --quiet --out motorless
# Pairs of runs: of one robot with different durations and rows, of two robots, of a robot without joints.
expect 0 "$program" run "${walk[@]}" --set cpg.frequency=1 --no-report --out brisk
expect 0 "$program" run "${walk[@]}" --set duration=3.76 --set cpg.frequency=0.8 --set trace.period=0.02 --no-report --out slow
expect 0 "$program" report brisk slow
expect 0 "$program" report infeasible csv --page robots.html
expect 0 "$program" report feasible jointless --page ball.html
expect 0 "$program" report brisk slow --page pair.html
expect 0 "$program" report feasible infeasible --page pair_second.html
cmp brisk/compare.html pair.html || fail "the same two runs give another page"
! grep -q "$work" pair.html strayed/*.html || fail "a page names a folder"
# The same run gives a page with the same bytes.
expect 0 "$program" run "${fast[@]}" --out again
cmp infeasible/report.html again/report.html || fail "the same run gives another page"

pages=(feasible=feasible/report.html infeasible=infeasible/report.html open=open/report.html built=built.html markup=markup/report.html
  failed=failed/report.html csv=csv/report.html old=old.html jointless=jointless/report.html built_ball=built_ball.html castor=castor/report.html motorless=motorless/report.html
  current=current/report.html cured=cured.html fall=fall/report.html torque=torque/report.html pair=pair.html pair_second=pair_second.html robots=robots.html ball=ball.html strayed=strayed/caterpillar-8.failure.html)
if ! node "$root/tests/page/page_test.mjs" "${pages[@]}" trace=trace.csv >"$work/log" 2>&1; then
  grep -A 30 '^not ok' "$work/log" | head -n 300 >&2 || show_log # show_log would mostly show passed tests
  fail "the page in $("$CHROMIUM" --version 2>/dev/null || printf %s "$CHROMIUM")"
fi
ok "the page in a browser: $(grep -E '^# pass|^ℹ pass' "$work/log")"

# A page of `gaitlab watch` follows the file.
sed 's/^duration: 20 /duration: 2 /' "$root/scenarios/caterpillar.yaml" >watched.yaml
"$program" watch watched.yaml --quiet --out watched 2>"$work/log" &
watcher=$!
trap 'kill "$watcher" 2>/dev/null || true; rm -rf -- "$work"' EXIT
until [[ -s watched/report.html ]]; do
  kill -0 "$watcher" 2>/dev/null || fail "gaitlab watch has ended"
  sleep 0.1
done
node "$root/tests/page/watch_test.mjs" watched/report.html watched.yaml >"$work/log" 2>&1 || { show_log; fail "a watched page in a browser"; }
ok "a watched page follows its scenario, with all that a reader has set"
verdict
