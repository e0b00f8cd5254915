#!/usr/bin/env bash
# The site of the documentation (docs/site) builds without warnings, without its gallery; its links have their targets, and no page loads
# anything from elsewhere. In Chromium, six pages load all files that they name, light and dark, wide and narrow; the search
# works.
# usage: site.sh BUILD_DIR     (exit code 77 without Sphinx and its packages, or without a browser)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
python=/usr/bin/python3 # Python of Debian
for module in sphinx myst_parser furo sphinx_copybutton yaml; do
  "$python" -c "import $module" 2>/dev/null || {
    skip "the site" "Python's module $module is missing (Debian: python3-sphinx python3-myst-parser furo python3-sphinx-copybutton python3-yaml)"
    exit 77
  }
done
[[ -e /usr/share/javascript/katex/katex.min.js ]] || {
  skip "the site" "KaTeX is missing (Debian: libjs-katex)"
  exit 77
}
export PYTHONDONTWRITEBYTECODE=1
site=$work/site
links=("$python" "$root/docs/site/links.py" "$site")

expect 0 "$python" "$root/docs/site/build.py" "$site"
[[ -s $site/index.html && -s $site/docs/tutorials/feasible.html ]] || fail "the site has no pages"
[[ ! -e $site/docs/site ]] || fail "the site contains its own sources"
ok "the site builds without warnings: $(find "$site" -name '*.html' | wc -l) pages"

expect 0 "${links[@]}"
# Each fault that the check looks for is found if it is put into the first page.
for fault in '<a href="docs/no-page.html">' '<a href="docs/glossary.html#no-anchor">' '<a href="#no-anchor">' '<img src="no-picture.svg">' \
  '<script src="https://example.org/a.js">' '<link href="//example.org/a.css">'; do
  cp -- "$site/index.html" "$work/first"
  sed -i "s,</body>,$fault&," "$site/index.html"
  "${links[@]}" >"$work/log" && bad "not found: $fault"
  (($(wc -l <"$work/log") == 1)) || bad "$fault is not one fault: $(<"$work/log")"
  mv -- "$work/first" "$site/index.html"
done
printf '@import url(/javascript/none.css);\n' >"$site/_static/fault.css"
printf 'import None from "./none.js";\n' >"$site/_static/fault.js"
"${links[@]}" >"$work/log" && bad "not found: a style and a script that load what is not there"
(($(wc -l <"$work/log") == 2)) || bad "a style and a script are not two faults: $(<"$work/log")"
rm -- "$site"/_static/fault.*
! grep -q "copied" "$site/docs/equations.html" || bad "an equation has a button to copy it"
grep -q "copied" "$site/docs/tutorials/feasible.html" || bad "a command has no button to copy it"
ok "every link has its target, and nothing is loaded from elsewhere"

# A folder with other contents is kept.
mkdir "$work/mine"
touch "$work/mine/file"
expect 1 "$python" "$root/docs/site/build.py" "$work/mine"
said "is not a site"
[[ -e $work/mine/file ]] || bad "the build removes a folder that is no site"

# The look, the buttons and the search, in a browser.
source "$root/tests/node.sh"
needs_browser "$(readlink -f -- "$1")" "the site in a browser"
if ! node "$root/tests/site/site_test.mjs" "$site" >"$work/log" 2>&1; then
  grep -A 30 '^not ok' "$work/log" | head -n 300 >&2 || show_log
  fail "the site in $("$CHROMIUM" --version 2>/dev/null || printf %s "$CHROMIUM")"
fi
ok "the site in a browser, light and dark, wide and narrow, and its search: $(grep -E '^# pass|^ℹ pass' "$work/log")"
verdict
