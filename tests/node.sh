# shellcheck shell=bash disable=SC2034,SC2154 # gates use the variables, and have read prelude.sh
# Node, npm modules and Chromium for gates. Without them a gate ends as skipped (77), or as failed with CI=true.

# left_out WHAT WHY: ends the gate.
left_out() {
  [[ ${CI:-} != true ]] || fail "$1: not tested, though this is CI: $2"
  skip "$1" "$2"
  exit 77
}

# needs_node WHAT: node 18.18 and npm.
needs_node() {
  local tool
  for tool in node npm; do
    command -v "$tool" >/dev/null || left_out "$1" "no $tool (Debian: nodejs, npm)"
  done
  (($(node -p 'const [major, minor] = process.versions.node.split("."); 1000 * major + +minor') >= 18018)) ||
    left_out "$1" "node $(node --version) is older than 18.18"
}

# install_modules WHAT SOURCE BUILD_FOLDER: sets NODE_MODULES to the modules of SOURCE/package-lock.json. They are installed once per lock file,
# beside the build.
install_modules() {
  local what=$1 source=$2 folder
  folder=$3/npm-$(sha256sum <"$source/package-lock.json" | head -c 16)
  export NODE_MODULES=$folder/node_modules
  mkdir -p "$folder"
  (
    flock 9 # two gates at once: the second waits for the first
    [[ ! -e $folder/whole ]] || exit 0
    cp -- "$source/package.json" "$source/package-lock.json" "$folder"
    (cd -- "$folder" && npm ci --ignore-scripts --no-audit --no-fund >"$work/log" 2>&1) || exit 1
    touch "$folder/whole"
  ) 9>"$folder/lock" || {
    show_log
    ! grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ENETUNREACH|ETIMEDOUT' "$work/log" || left_out "$what" "the package registry cannot be reached"
    fail "npm ci"
  }
}

# needs_browser BUILD_FOLDER WHAT: sets CHROMIUM, and NODE_MODULES to those of report/page.
needs_browser() {
  needs_node "$2"
  export CHROMIUM=${CHROMIUM:-$(command -v chromium-headless-shell || command -v chromium || true)} # the shell starts pages in half of the time
  [[ -n $CHROMIUM ]] || left_out "$2" "no Chromium (Debian: chromium-headless-shell)"
  install_modules "$2" "$root/report/page" "$1"
}
