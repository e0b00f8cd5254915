# shellcheck shell=bash disable=SC2034,SC2154 # gates use the variables, and have read prelude.sh
# Chromium and the npm modules of report/page, for gates that open pages. They are installed once per package-lock.json, beside the build.

# needs_browser BUILD_FOLDER WHAT: sets CHROMIUM and NODE_MODULES; without them the script ends as skipped (77), or as failed with CI=true.
needs_browser() {
  local folder lock=$root/report/page/package-lock.json tool what=$2
  left_out() {
    [[ ${CI:-} != true ]] || fail "$what: not tested, though this is CI: $1"
    skip "$what" "$1"
    exit 77
  }
  for tool in node npm; do
    command -v "$tool" >/dev/null || left_out "no $tool (Debian: nodejs, npm)"
  done
  (($(node -p 'const [major, minor] = process.versions.node.split("."); 1000 * major + +minor') >= 18018)) ||
    left_out "node $(node --version) is older than 18.18"
  export CHROMIUM=${CHROMIUM:-$(command -v chromium || true)}
  [[ -n $CHROMIUM ]] || left_out "no Chromium (Debian: chromium)"
  folder=$1/npm-$(sha256sum <"$lock" | head -c 16)
  export NODE_MODULES=$folder/node_modules
  mkdir -p "$folder"
  (
    flock 9 # two gates at once: the second waits for the first
    [[ ! -e $folder/whole ]] || exit 0
    cp -- "$root/report/page/package.json" "$lock" "$folder"
    (cd -- "$folder" && npm ci --ignore-scripts --no-audit --no-fund >"$work/log" 2>&1) || exit 1
    touch "$folder/whole"
  ) 9>"$folder/lock" || {
    show_log
    ! grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ENETUNREACH|ETIMEDOUT' "$work/log" || left_out "the package registry cannot be reached"
    fail "npm ci"
  }
}
