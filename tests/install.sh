#!/usr/bin/env bash
# What docs/ci.md promises to users: installs the build into an empty prefix, then works from that alone: a user's project with
# find_package(gaitlab), golden tests and a plugin, and the shell recipe.
# usage: install.sh PROGRAM_BUILD_DIR (a finished build)
set -euo pipefail

build=$(readlink -f -- "$1")
here=$(readlink -f -- "$(dirname -- "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
prefix=$work/prefix user=$work/user
program=$prefix/bin/gaitlab
scenario=scenarios/walk.yaml

fail() {
  printf 'install.sh: %s\n' "$*"
  [[ ! -e $work/log ]] || tail -n 40 -- "$work/log"
  exit 1
}
quietly() { "$@" >"$work/log" 2>&1 || fail "failed: $*"; }
# expect CODE COMMAND...
expect() {
  local code=0 expected=$1
  shift
  "$@" >"$work/log" 2>&1 || code=$?
  ((code == expected)) || fail "exit code $code, expected $expected: $*"
}

# The user's project: a scenario with its own robot file, a plugin, a CMakeLists.txt as in docs/ci.md.
write_project() {
  mkdir -p "$user/scenarios/robots" "$user/plugin"
  cp -- "$here/plugin_example/wave.cpp" "$user/plugin/"
  cp -- "$prefix/share/gaitlab/scenarios/robots/caterpillar-8.dat" "$user/scenarios/robots/"
  cat >"$user/$scenario" <<'YAML'
gaitlab: 1
name: walk
robot: {modules: mtran, build: robots/caterpillar-8.dat}
contact: {on: all}
cpg: {type: phase_oscillator, frequency: 0.25, amplitude: 0.6, phase_lag: 1.2}
duration: 0.6
YAML
  cat >"$user/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(my_gaits NONE)
enable_testing()

find_package(gaitlab 0.1 REQUIRED)
enable_language(CXX) # for the plugin alone
add_library(wave MODULE plugin/wave.cpp)
target_link_libraries(wave PRIVATE gaitlab::plugin)
add_test(NAME walk.runs COMMAND gaitlab::gaitlab run ${CMAKE_CURRENT_SOURCE_DIR}/scenarios/walk.yaml --quiet)
gaitlab_add_golden_test(walk scenarios/walk.yaml)
gaitlab_add_golden_test(walk.elsewhere scenarios/walk.yaml GOLDEN goldens/walk)
CMAKE
}

# Plugins must come from the compiler of the program, which need not be this machine's default.
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")

# ctest_says CODE [ctest options]: configures, builds and tests the project.
ctest_says() {
  quietly cmake -S "$user" -B "$work/user-build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler"
  quietly cmake --build "$work/user-build"
  expect "$1" ctest --test-dir "$work/user-build" --output-on-failure --no-tests=error "${@:2}"
}

check_installation() {
  [[ -x $program ]] || fail "no program in $prefix"
  # Asked for, because the program would fall back on those beside the sources.
  [[ -d $prefix/share/gaitlab/scenarios/modules ]] || fail "the shipped scenarios are not installed"
  expect 0 "$program" check "$prefix/share/gaitlab/scenarios/caterpillar.yaml"
}

use_plugin() {
  printf 'gaitlab: 1\nplugins: [%s]\nrobot: {modules: mtran}\nduration: 0.1\ncpg: {type: wave}\n' \
    "$work/user-build/libwave.so" >"$work/with_plugin.yaml"
  expect 0 "$program" run "$work/with_plugin.yaml" --quiet --out "$work/with-plugin"
  printf 'ok       a plugin built against the installed headers runs\n'
}

# A gait that was changed must fail, and so must a golden that is not there.
cmake_way() {
  ctest_says 8 # no golden yet; 8 is ctest's "tests failed"
  expect 0 "$program" approve "$user/$scenario" --reason "install.sh: the first"
  mkdir "$user/goldens"
  cp -r -- "$user/scenarios/walk.golden" "$user/goldens/walk"
  ctest_says 0
  grep -q '3 tests passed\|tests passed, 0 tests failed out of 3' "$work/log" || fail "expected three tests"
  sed -i 's/amplitude: 0.6/amplitude: 0.63/' "$user/$scenario"
  ctest_says 8 -L golden
  grep -q '2 tests failed out of 2' "$work/log" || fail "expected two failures of label golden"
  compgen -G "$work/user-build/walk.golden-test/runs/*/*.svg" >"$work/log" || fail "no figure of what failed"
  sed -i 's/amplitude: 0.63/amplitude: 0.6/' "$user/$scenario"
  printf 'ok       gaitlab_add_golden_test: passes, fails for a changed gait, fails without a golden\n'
}

# The shell recipes of docs/ci.md, in the user's project.
shell_recipe() {
  cd -- "$user"
  expect 0 "$program" run "$scenario" --quiet --out reference
  expect 0 "$program" rerun reference --verify
  sed -i 's/amplitude: 0.6$/amplitude: 0.63/' reference/scenario.resolved.yaml
  expect 4 "$program" rerun reference --verify
  printf 'ok       shell: rerun --verify passes, and fails (4) for a changed gait\n'
  expect 0 "$program" test scenarios --strict --junit golden.xml
  [[ -s golden.xml ]] || fail "no golden.xml"
  sed -i 's/amplitude: 0.6,/amplitude: 0.63,/' "$scenario"
  expect 4 "$program" test scenarios --strict --junit golden.xml
  printf 'ok       shell: test passes, and fails (4) for a changed gait\n'
}

quietly cmake --install "$build" --prefix "$prefix"
check_installation
write_project
cmake_way
use_plugin
shell_recipe
