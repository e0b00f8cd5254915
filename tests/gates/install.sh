#!/usr/bin/env bash
# The promises of docs/ci.md and docs/tutorials: installs the build into an empty prefix and then uses only the prefix. Tests a user's
# project with find_package(gaitlab), golden tests and a plugin, the shell recipe, a new plugin of every kind, and the tutorials.
# usage: install.sh PROGRAM_BUILD_DIR (a finished build)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
build=$(readlink -f -- "$1")
prefix=$work/prefix user=$work/user
program=$prefix/bin/gaitlab
scenario=scenarios/walk.yaml

# Writes the user's project: a scenario with its own robot file, a plugin, and a CMakeLists.txt as in docs/ci.md.
write_project() {
  mkdir -p "$user/scenarios/robots" "$user/plugin"
  cp -- "$root/tests/plugin_example/wave.cpp" "$user/plugin/"
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
enable_language(CXX) # needed only for the plugin
gaitlab_add_plugin(wave plugin/wave.cpp)
add_test(NAME walk.runs COMMAND gaitlab::gaitlab run ${CMAKE_CURRENT_SOURCE_DIR}/scenarios/walk.yaml --quiet)
gaitlab_add_golden_test(walk scenarios/walk.yaml)
gaitlab_add_golden_test(walk.elsewhere scenarios/walk.yaml GOLDEN goldens/walk)
CMAKE
}

# Plugins require the compiler of the program, which may differ from the default compiler.
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")

# ctest_says CODE [ctest options]: configures, builds and tests the project.
ctest_says() {
  expect 0 cmake -S "$user" -B "$work/user-build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler"
  expect 0 cmake --build "$work/user-build"
  expect "$1" ctest --test-dir "$work/user-build" --output-on-failure --no-tests=error "${@:2}"
}

check_installation() {
  [[ -x $program ]] || fail "no program in $prefix"
  # The gate checks the folder, because the program would otherwise use the scenarios next to the sources.
  [[ -d $prefix/share/gaitlab/scenarios/modules ]] || fail "the shipped scenarios are not installed"
  expect 0 "$program" check "$prefix/share/gaitlab/scenarios/caterpillar.yaml"
  # The program uses no path of the build machine and no source tree: it finds module types and robots beside itself, also
  # through a link.
  ! grep -qaF -- "$root" "$program" || fail "the program contains the path of the source tree"
  ln -s -- "$program" "$work/linked"
  expect 0 "$work/linked" check "$prefix/share/gaitlab/scenarios/library/dtto-caterpillar.yaml"
  mv -- "$prefix/share/gaitlab/scenarios" "$work/elsewhere"
  printf 'gaitlab: 1\nrobot: {modules: mtran}\nduration: 0.1\n' >"$work/alone.yaml"
  expect 2 "$program" check "$work/alone.yaml"
  GAITLAB_DATA=$work/elsewhere expect 0 "$program" check "$work/alone.yaml"
  mv -- "$work/elsewhere" "$prefix/share/gaitlab/scenarios"
  ok "the installed program finds its data without the source tree"
}

use_plugin() {
  printf 'gaitlab: 1\nplugins: [%s]\nrobot: {modules: mtran}\nduration: 0.1\ncpg: {type: wave}\n' \
    "$work/user-build/wave.so" >"$work/with_plugin.yaml"
  expect 0 "$program" run "$work/with_plugin.yaml" --quiet --out "$work/with-plugin"
  ok "a plugin built against the installed headers runs"
}

# A changed gait must fail, and so must a missing golden.
cmake_way() {
  ctest_says 8 # the golden is missing; 8 means "tests failed" in ctest
  expect 0 "$program" approve "$user/$scenario" --reason "install.sh: the first"
  mkdir "$user/goldens"
  cp -r -- "$user/scenarios/walk.golden" "$user/goldens/walk"
  ctest_says 0
  said '3 tests passed\|tests passed, 0 tests failed out of 3'
  sed -i 's/amplitude: 0.6/amplitude: 0.63/' "$user/$scenario"
  ctest_says 8 -L golden
  said '2 tests failed out of 2'
  compgen -G "$work/user-build/walk.golden-test/runs/*/*.svg" >/dev/null || fail "no figure of what failed"
  sed -i 's/amplitude: 0.63/amplitude: 0.6/' "$user/$scenario"
  ok "gaitlab_add_golden_test: passes, fails for a changed gait, fails without a golden"
}

# The shell recipes of docs/ci.md, in the user's project.
shell_recipe() {
  cd -- "$user"
  expect 0 "$program" run "$scenario" --quiet --out reference
  expect 0 "$program" rerun reference --verify
  sed -i 's/amplitude: 0.6$/amplitude: 0.63/' reference/scenario.resolved.yaml
  expect 4 "$program" rerun reference --verify
  ok "shell: rerun --verify passes, and fails (4) for a changed gait"
  expect 0 "$program" test scenarios --strict --junit golden.xml
  [[ -s golden.xml ]] || fail "no golden.xml"
  sed -i 's/amplitude: 0.6,/amplitude: 0.63,/' "$scenario"
  expect 4 "$program" test scenarios --strict --junit golden.xml
  ok "shell: test passes, and fails (4) for a changed gait"
}

# The configuration of the project refuses a different compiler, with the name of the correct compiler.
other_compiler() {
  local other
  for other in clang++ g++; do
    [[ $("$other" --version 2>/dev/null | head -n 1) != "$("$compiler" --version | head -n 1)" ]] || continue
    command -v "$other" >/dev/null || continue
    expect 1 cmake -S "$user" -B "$work/other-build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$other"
    said "gaitlab_add_plugin(wave): this compiler is .* -DCMAKE_CXX_COMPILER="
    ok "gaitlab_add_plugin refuses $other"
    return
  done
  skip "gaitlab_add_plugin refuses another compiler" "there is only one here"
}

# The three skeletons of plugins build without warnings and pass their tests. If the plugin does nothing, the tests fail.
new_plugins() {
  local kind folder
  for kind in cpg controller actuator; do
    folder=$work/new/my_$kind
    expect 0 "$program" new plugin "$kind" "my_$kind" --out "$folder"
    expect 0 cmake -S "$folder" -B "$folder/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wconversion -Werror"
    expect 0 cmake --build "$folder/build"
    expect 0 ctest --test-dir "$folder/build" --output-on-failure --no-tests=error
    expect 0 "$program" run "$folder/scenario.yaml" --set duration=0.3 --quiet --out "$folder/run" # loads build/NAME.so
    case $kind in
      cpg) sed -i 's/setpoint\[i\] = .*/setpoint[i] = 0 * phi[i];/' "$folder/my_$kind.cpp" ;;
      controller) sed -i 's/command\[j\] = .*/command[j] = 0 * (setpoint[j] - m.angle[j]);/' "$folder/my_$kind.cpp" ;;
      actuator) sed -i 's/torque\[i\] = .*/torque[i] = 0 * command[i] * speed[i];/' "$folder/my_$kind.cpp" ;;
    esac
    expect 0 cmake --build "$folder/build"
    expect 8 ctest --test-dir "$folder/build" --output-on-failure
    said 'it does not'
  done
  ok "gaitlab new plugin: three kinds build, pass their tests, fail them when they do nothing"
}

# tutorial PAGE: writes and runs the literal blocks of the page in an empty folder. A block ```LANGUAGE FILE is a file, ```sh are
# commands, ```sh exit=N are commands of which the last has exit code N, and ```text is the output of these commands.
tutorial() {
  local page=$root/docs/tutorials/$1 name=${1%.md}
  mkdir -p "$work/$name"
  awk '
    /^```sh exit=/ { sub(/.*=/, ""); code = $0; print "("; inside = 1; next }
    /^```sh$/ { inside = 1; next }
    /^```text$/ { print "cat >said <<\047END_OF_FILE\047"; inside = 1; said = 1; next }
    /^```[a-z]+ / { print "cat >" $2 " <<\047END_OF_FILE\047"; inside = 1; file = 1; next }
    /^```$/ && inside {
      if (code != "") print ") 2>stderr && code=0 || code=$?\ncat stderr\n[[ $code == " code " ]]"
      if (file || said) print "END_OF_FILE"
      if (said) print "diff said stderr"
      inside = 0; file = 0; said = 0; code = ""; next
    }
    inside { print }' "$page" >"$work/$name.sh"
  (cd -- "$work/$name" && GAITLAB=$prefix CXX=$compiler expect 0 bash -e "$work/$name.sh") || exit 1
  ok "docs/tutorials/$1, exactly as it stands"
}
at_most() {
  local lines
  lines=$(wc -l <"$2")
  ((lines <= $1)) || fail "$2 has $lines lines, more than $1"
}

expect 0 cmake --install "$build" --prefix "$prefix"
check_installation
write_project
cmake_way
use_plugin
other_compiler
shell_recipe
new_plugins
tutorial write-a-cpg.md
at_most 40 "$work/write-a-cpg/lash.cpp"
at_most 4 "$work/write-a-cpg/CMakeLists.txt"
