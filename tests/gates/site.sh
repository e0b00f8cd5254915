#!/usr/bin/env bash
# The site of the documentation (docs/site) builds without warnings, without its gallery; its links have their targets, no page loads
# anything from elsewhere, and the search works from a file.
# usage: site.sh     (exit code 77 without Sphinx and its packages)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
python=/usr/bin/python3 # Python of Debian
for module in sphinx myst_parser furo sphinx_copybutton yaml; do
  "$python" -c "import $module" 2>/dev/null || {
    skip "the site" "Python's module $module is missing (Debian: python3-sphinx python3-myst-parser furo python3-sphinx-copybutton python3-yaml)"
    exit 77
  }
done
export PYTHONDONTWRITEBYTECODE=1
site=$work/site
links=("$python" "$root/docs/site/links.py" "$site")

expect 0 "$python" "$root/docs/site/build.py" "$site"
[[ -s $site/index.html && -s $site/docs/tutorials/feasible.html ]] || fail "the site has no pages"
[[ ! -e $site/docs/site ]] || fail "the site contains its own sources"
ok "the site builds without warnings: $(find "$site" -name '*.html' | wc -l) pages"

expect 0 "${links[@]}"
# Each fault that the check looks for, put into the first page, is found.
for fault in '<a href="docs/no-page.html">' '<a href="docs/glossary.html#no-anchor">' '<a href="#no-anchor">' '<img src="no-picture.svg">' \
  '<script src="https://example.org/a.js">' '<link href="//example.org/a.css">'; do
  cp -- "$site/index.html" "$work/first"
  sed -i "s,</body>,$fault&," "$site/index.html"
  "${links[@]}" >"$work/log" && bad "not found: $fault"
  (($(wc -l <"$work/log") == 1)) || bad "$fault is not one fault: $(<"$work/log")"
  mv -- "$work/first" "$site/index.html"
done
! grep -q "copied" "$site/docs/equations.html" || bad "an equation has a button to copy it"
grep -q "copied" "$site/docs/tutorials/feasible.html" || bad "a command has no button to copy it"
ok "every link has its target, and nothing is loaded from elsewhere"

# A folder with other contents is kept.
mkdir "$work/mine"
touch "$work/mine/file"
expect 1 "$python" "$root/docs/site/build.py" "$work/mine"
said "is not a site"
[[ -e $work/mine/file ]] || bad "the build removes a folder that is no site"

chromium=$(command -v chromium || true)
if [[ -n $chromium ]]; then
  "$chromium" --headless --no-sandbox --disable-gpu --virtual-time-budget=20000 --user-data-dir="$work/chromium" \
    --dump-dom "file://$site/search.html?q=no-load+speed+of+the+motors" >"$work/log" 2>/dev/null || fail "Chromium does not open the search"
  grep -q 'href="docs/[a-z/-]*.html' "$work/log" || { show_log; fail "the search finds nothing"; }
  ok "the search works from a file"
else
  skip "the search of the site" "no Chromium (Debian: chromium)"
fi
verdict
