#!/usr/bin/env bash
# The Debian packages (docs/overview.md), made from a finished build without building anything: lintian finds no error, no file contains a path
# of this machine, and the unpacked program and Python module work from there. Tests the completion in bash and the manual page, too.
# usage: packages.sh PROGRAM_BUILD_DIR     (exit code 77 without dpkg-deb or lintian)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
build=$(readlink -f -- "$1")
for tool in dpkg-deb dpkg-shlibdeps lintian man groff strace; do
  command -v "$tool" >/dev/null || {
    skip "the packages" "$tool is missing (Debian: dpkg-dev lintian man-db groff strace)"
    exit 77
  }
done
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
packages=(gaitlab gaitlab-dev)
! grep -qx 'GAITLAB_PYTHON:BOOL=ON' "$build/CMakeCache.txt" || packages+=(python3-gaitlab)
prefix=$work/root/usr program=$work/root/usr/bin/gaitlab

# Every package has the version of the project, its notices and its changelog.
check_contents() {
  local name file
  for name in "${packages[@]}"; do
    file=$work/packages/${name}_$version-1_$(dpkg --print-architecture).deb
    [[ -s $file ]] || fail "there is no package $file"
    mkdir -p "$work/parts/$name"
    dpkg-deb -x "$file" "$work/root"
    dpkg-deb -x "$file" "$work/parts/$name"
    [[ -s $prefix/share/doc/$name/copyright ]] || bad "$name has no copyright"
    zcat "$prefix/share/doc/$name/changelog.Debian.gz" | grep "^$name ($version-1)" >/dev/null || bad "the changelog of $name has another version"
    [[ $name == gaitlab ]] || dpkg-deb -f "$file" Depends | grep -F "gaitlab (= $version-1)" >/dev/null || bad "$name depends on any gaitlab"
  done
  for name in "BSD 3-Clause" three.js "Leon Sorokin" "SIL OPEN FONT" libpagmo-dev libcli11-dev nlohmann-json3-dev libeigen3-dev; do
    grep -F -- "$name" "$prefix/share/doc/gaitlab/copyright" >/dev/null || bad "the notice of $name is missing"
  done
  for file in bin/gaitlab share/gaitlab/scenarios/hexapod.yaml share/gaitlab/scenarios/gaitlab.schema.json share/man/man1/gaitlab.1.gz \
    share/bash-completion/completions/gaitlab share/doc/gaitlab/docs/README.md; do
    [[ -s $work/parts/gaitlab/usr/$file ]] || bad "gaitlab lacks $file"
  done
  [[ -s $work/parts/gaitlab-dev/usr/include/gaitlab/core/plugin/plugin.h ]] || bad "gaitlab-dev has no headers"
  ! readelf -S "$program" | grep -E '[.](symtab|debug_info)' >/dev/null || bad "the program is not stripped"
  ok "${packages[*]}: version $version, notices, changelogs, files"
}

# Errors of lintian fail. The warnings are known, with the reason in docs/overview.md.
check_lintian() {
  lintian --fail-on none --allow-root --no-tag-display-limit "$work"/packages/*.deb >"$work/lintian" 2>&1 || { cat "$work/lintian" && fail "lintian"; }
  ! grep '^E:' "$work/lintian" >&2 || bad "errors of lintian"
  ! grep '^W:' "$work/lintian" | grep -v ' initial-upload-closes-no-bugs' >&2 || bad "new warnings of lintian"
  ok "lintian: no error, $(grep -c '^W:' "$work/lintian" || true) known warnings"
}

check_paths() {
  local found
  found=$(grep -rlaF -e "$root" -e "$build" -e "$work" "$work/root") && bad "a path of this machine is in: $found"
  ok "no file contains a path of this machine"
}

# From a folder that is not /usr, without the source tree.
check_program() {
  expect 0 "$program" demo --out "$work/demo"
  expect 0 "$program" list robot
  said "$prefix/share/gaitlab/scenarios/robots/hexapod.dat"
  expect 0 "$program" check hexapod
  expect 0 "$program" new plugin cpg mine --out "$work/mine"
  said "CMAKE_PREFIX_PATH=$prefix"
  # A program that does not find its data prints the absolute paths that it has searched.
  cp -- "$program" "$work/alone"
  printf 'gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.1\n' >"$work/mtran.yaml"
  cd -- "$work"
  expect 2 ./alone check mtran.yaml
  said "looked in $work/modules, $(dirname -- "$work")/modules, $(dirname -- "$work")/share/gaitlab/scenarios/modules"
  said 'GAITLAB_DATA names another folder'
  # Without /proc (tests/tools/clean_root.sh): a scenario within a trace is read without a name below it.
  cp -- demo/trace.h5 other.h5
  expect 0 strace -f -qq -e trace=%file -o files "$program" report other.h5
  ! grep -F '/proc/self/fd' files >&2 || bad "the program opens files through /proc"
  ok "the unpacked program finds its data; without them it names whole paths"
}

check_python() {
  [[ " ${packages[*]} " == *" python3-gaitlab "* ]] || { skip "python3-gaitlab" "GAITLAB_PYTHON is off"; return; }
  cd -- "$work"
  PYTHONPATH=$prefix/lib/python3/dist-packages expect 0 /usr/bin/python3 - "$work/demo" "$version" <<'PYTHON'
import sys
import gaitlab
assert gaitlab.__version__ == sys.argv[2], gaitlab.__version__
run = gaitlab.run(gaitlab.Scenario("hexapod", {"physics.engine": "articulated", "duration": 1}))
assert run.outcome == "done", run.outcome
read = gaitlab.read(sys.argv[1])
assert read.verdict["verdict"] == "feasible", read.verdict["verdict"]
PYTHON
  ok "the unpacked Python package runs a shipped scenario and reads a folder"
}

# completes LINE WORD...: succeeds if the completion of LINE, with the cursor at its end, offers each WORD.
completes() {
  local line=$1 word
  # shellcheck disable=SC2016 # words of the other bash
  printf '%s\n' "$line" | PATH=$prefix/bin:$PATH bash --norc --noprofile -c '
    source "$1"
    IFS= read -r COMP_LINE
    read -r -a COMP_WORDS <<<"${COMP_LINE//=/ = }"
    [[ $COMP_LINE != *[\ ] ]] || COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _gaitlab
    printf "%s\n" "${COMPREPLY[@]}"' bash "$prefix/share/bash-completion/completions/gaitlab" >"$work/offered" 2>"$work/log"
  [[ ! -s $work/log ]] || { show_log; bad "the completion of '$line' complains"; }
  for word in "${@:2}"; do
    grep -xF -e "$word" "$work/offered" >/dev/null || bad "'$line' is not completed to '$word', but to: $(tr '\n' ' ' <"$work/offered")"
  done
}
check_completion() {
  cd -- "$work"
  completes "gaitlab ex" explain export
  completes "gaitlab study " show merge
  completes "gaitlab run --dem" --demand
  completes "gaitlab help ru" run
  completes "gaitlab run cater" caterpillar
  completes "gaitlab run mtr" mtran.yaml
  completes "gaitlab run x --format " h5 csv
  completes "gaitlab run x --format=c" csv
  completes "gaitlab swap x --cpg sine,ho" sine,hopf
  completes "gaitlab run x --set physics.en" physics.engine=
  completes "gaitlab run x --set physics.engine=art" articulated
  completes "gaitlab explain cp" cpg
  completes "gaitlab explain cpg ho" hopf
  completes "gaitlab new scenario x --module mt" mtran
  ok "bash completes commands, options, files, names and values"
}

check_manual() {
  zcat "$prefix/share/man/man1/gaitlab.1.gz" >"$work/gaitlab.1"
  expect 0 groff -ww -man -Tutf8 -z "$work/gaitlab.1"
  [[ ! -s $work/log ]] || { show_log; bad "groff warns"; }
  MANWIDTH=100 LC_ALL=C.UTF-8 expect 0 man --warnings=all -l "$work/gaitlab.1"
  said 'gaitlab run SCENARIO'
  said '\-\-fail-infeasible'
  ok "the manual page renders without warnings"
}

expect 0 cpack --config "$build/CPackConfig.cmake" -B "$work/packages"
check_contents
check_lintian
check_paths
check_program
check_python
check_completion
check_manual
verdict
