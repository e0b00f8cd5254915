#!/usr/bin/env bash
# Writes docs/validation.md: runs all tests that validate a row, and lists measured and required values.
# usage: tests/tools/validation.sh PROGRAM_BUILD_DIR [PAGE]     (needs jq; the same build writes the same page)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage

build=$(readlink -f -- "$1")
page=${2:-$root/docs/validation.md}

export GAITLAB_VALIDATION=$work/rows.json
unset GAITLAB_TOL_SCALE
: >"$GAITLAB_VALIDATION"

# Prints the gtest filter of all suites of a test program in the folders of tests/ whose files include validation.h, except the tests of
# rows. Each suite must have a test in the program, so that a row that a build omits cannot vanish unnoticed from the page.
filter() {
  local program=$1 suite text=
  shift
  for suite in $(cd -- "$root/tests" && grep -rl --include='*_test.cpp' '"tests/validation.h"' "$@" | grep -v '/validation_test[.]cpp$' |
    xargs -r grep -hoE '^(TEST|TEST_F|TEST_P|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\([A-Za-z0-9_]+' | sed 's/.*(//' | sort -u); do
    "$program" --gtest_list_tests --gtest_filter="$suite.*:*/$suite.*" | grep '^  ' >/dev/null || fail "$program: no test of suite $suite"
    text+="${text:+:}$suite.*:*/$suite.*"
  done
  printf '%s' "$text"
}

run() {
  local program=$build/bin/$1_tests chosen
  shift
  chosen=$(filter "$program" "$@")
  [[ -n $chosen ]] || return 0 # no file in these folders writes rows
  expect 0 "$program" --gtest_filter="$chosen" --gtest_brief=1
}
run core core controllers cpg golden physics_articulated sensors
run program app interchange program report
[[ -s $GAITLAB_VALIDATION ]] || fail "no test wrote a row"

{
  cat -- "$root/tests/validation_head.md"
  # For each id, the row that is closest to its tolerance. There is a table per subject, in the order of the list.
  jq -rs '
    [["closed", "Closed forms and textbook systems"], ["cpg", "Pattern generators"], ["published", "Published numbers"], ["order", "Order of the integrators"],
     ["property", "Laws of mechanics and symmetries"], ["format", "Other programs"], ["ledger", "Energy"],
     ["limits", "Motors at their limits"], ["play", "Gears with play"]] as $subjects
    | (group_by(.id) | map(max_by(.share) + {count: length})) as $rows
    | (($rows | map(.id | split(".")[0]) | unique) - ($subjects | map(.[0]))) as $unknown
    | if $unknown != [] then error("unknown subjects: \($unknown)") else . end
    | def cell: gsub("\\|"; "\\|") | gsub("\n"; " ");
      def unit: if .unit == "" then "" else " " + .unit end;
    $subjects[] as [$subject, $title]
    | ($rows | map(select(.id | startswith($subject + ".")))) as $mine
    | select($mine != [])
    | "\n## \($title)\n\n| row | claim | source | measured | required | residual | inside by | why this tolerance | test |\n|---|---|---|---|---|---|---|---|---|",
      ($mine[] | "| \(.id | ltrimstr($subject + ".")) | \(.what | cell) | \(.source | cell) | \(.measured)\(unit) | \(.required)\(unit) | \(.residual) | \(.inside_by) | \(.reason | cell)\(if .count > 1 then " (worst of \(.count))" else "" end) | `\(.command | sub("--gtest_filter="; ""))` |")
  ' "$GAITLAB_VALIDATION"
} >"$work/page.md"
mkdir -p -- "$(dirname -- "$page")"
replace "$page" "$work/page.md"
printf '%s: %s rows\n' "$page" "$(jq -s 'group_by(.id) | length' "$GAITLAB_VALIDATION")"
