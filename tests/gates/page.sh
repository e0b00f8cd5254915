#!/usr/bin/env bash
# The report page: its committed bundle is what its sources give, they type-check, and in a browser it does what it says.
# usage: page.sh PROGRAM_BUILD_DIR     (exit code 77: no node, npm, Chromium or packages here; with CI=true that is an error)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")/bin/gaitlab

# left_out WHY
left_out() {
  [[ ${CI:-} != true ]] || fail "the report page: not tested, though this is CI: $1"
  skip "the report page" "$1"
  exit 77
}
for tool in node npm; do
  command -v "$tool" >/dev/null || left_out "no $tool (Debian: nodejs, npm)"
done
(($(node -p 'process.versions.node.split(".")[0]') >= 18)) || left_out "node $(node --version) is older than 18"
export CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
[[ -n $CHROMIUM ]] || left_out "no Chromium (Debian: chromium)"

# Outside of the sources: what is built there must not be what is compared.
page=$work/page
mkdir -p "$page/test"
(cd -- "$root/report/page" && cp -r -- package.json package-lock.json tsconfig.json build.mjs src "$page")
cp -- "$root"/tests/page/*.mjs "$page/test"
cd -- "$page"
if ! npm ci --ignore-scripts --no-audit --no-fund >"$work/log" 2>&1; then
  show_log
  ! grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ENETUNREACH|ETIMEDOUT' "$work/log" || left_out "the package registry cannot be reached"
  fail "npm ci"
fi
expect 0 npx --no-install tsc --noEmit
ok "report/page type-checks"
expect 0 node build.mjs
for file in dist/page.html LICENSES.txt; do
  cmp -- "$root/report/page/$file" "$file" ||
    fail "report/page/$file is stale: in report/page, npm ci --ignore-scripts && node build.mjs, and commit it"
done
size=$(stat --format=%s dist/page.html)
((size <= 760000)) || fail "the page without a run has $size bytes, more than 760000"
ok "report/page/dist/page.html is what its sources give, $size bytes"

cd -- "$work"
walk=("$root/scenarios/hexapod.yaml" --set duration=4 --set physics.engine=articulated --quiet)
expect 0 "$program" run "${walk[@]}" --set 'trace.columns=[joint.*, base.*, com.*, contact.*, body.*]' --out feasible
expect 0 "$program" export feasible --to csv trace.csv
fast=("${walk[@]}" --set cpg.frequency=1.2 --set cpg.amplitude=0.6 --demand)
expect 0 "$program" run "${fast[@]}" --out infeasible
expect 0 "$program" run "$root/scenarios/pendulum.yaml" --set duration=2 --quiet --out open
expect 0 "$program" check "$root/scenarios/hexapod.yaml" --quiet --page built.html
# A module whose text would end a script, and begin a comment.
cp -r -- "$root/scenarios" .
sed -i 's,^source: .*,source: "</script><script>window.taken = 1</script><!--",' scenarios/modules/mtran.yaml
expect 0 "$program" run scenarios/caterpillar.yaml --set duration=0.5 --set physics.engine=articulated --quiet --out markup
grep -q 'window.taken' markup/scenario.resolved.yaml || fail "the scenario has no markup in it"
# Same run, same bytes.
expect 0 "$program" run "${fast[@]}" --out again
cmp infeasible/report.html again/report.html || fail "the same run gives another page"

pages=(feasible=feasible/report.html infeasible=infeasible/report.html open=open/report.html built=built.html markup=markup/report.html)
if ! node "$page/test/page_test.mjs" "${pages[@]}" trace=trace.csv >"$work/log" 2>&1; then
  show_log
  fail "the page in $("$CHROMIUM" --version 2>/dev/null || printf %s "$CHROMIUM")"
fi
ok "the page in a browser: $(grep -E '^# pass|^ℹ pass' "$work/log")"
verdict
