#!/usr/bin/env bash
# The Khronos validator (gltf-validator of npm, pinned in gltf/package-lock.json) reports no error and no warning for files of
# `export --to gltf`: walks, all kinds of ground and shape, moving boxes, a robot at its start. It detects a damaged file.
# usage: gltf.sh PROGRAM_BUILD_DIR     (exit code 77 without node or the validator, which is a failure with CI=true)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
build=$(readlink -f -- "$1") program=$(readlink -f -- "$1")/bin/gaitlab
source "$root/tests/node.sh"
needs_node "glTF files in the validator"
install_modules "glTF files in the validator" "$root/tests/gates/gltf" "$build"
cp -- "$root/tests/gates/gltf/validate.mjs" "$root/tests/gates/gltf/package.json" "$work"
ln -s -- "$NODE_MODULES" "$work/node_modules"
cd -- "$work"

# A ball that rolls over hills and pushes a box. It contains a piece of every other shape.
cat >ball.yaml <<'YAML'
gaitlab_module: 1
name: ball
bodies:
  ball:
    mass: 1
    com: [0, 0, 0]
    inertia: [1e-3, 1e-3, 1e-3, 0, 0, 0]
    shape:
      - {sphere: 0.05}
      - {box: [0.14, 0.02, 0.02]}
      - {cylinder: [0.01, 0.14]}
      - {half_cylinder: [0.02, 0.04], origin: [0.04, 0, 0]}
    source: "chosen"
hinges: []
faces: []
contacts: {feet: [], all: [{body: ball, sphere: [0, 0, 0], radius: 0.05}]}
YAML
head='gaitlab: 1
robot: {modules: ball.yaml, position: [0, 0]}
contact: {on: all}
actuator: {type: none}
initial: {base_velocity: [0.5, 0.1, 0]}
trace: {columns: [base.*]}
duration: 1'
printf '%s\n' "$head" "ground: {type: heightfield, heightfield: {values: [[0, 0.02, 0, 0.03], [0, 0, 0.02, 0], [0, 0.01, 0, 0]], origin: [-0.1, -0.1, 0], spacing: 0.2}}" >hills.yaml
printf '%s\n' "${head/on: all/on: all, law: bullet}" "ground: {type: boxes, boxes: [{center: [0.15, 0, 0.05], size: [0.1, 0.3, 0.1], mass: 0.1}, {center: [-0.3, 0, 0], size: [0.1, 0.1, 0.1]}]}" >push.yaml

shipped=$root/scenarios
for scenario in "$shipped/hexapod.yaml" "$shipped/caterpillar.yaml" "$shipped/rubble.yaml" "$shipped/pendulum.yaml" hills.yaml push.yaml; do
  name=$(basename -- "$scenario" .yaml)
  expect 0 "$program" run "$scenario" --set duration=1 --quiet --out "$name"
  expect 0 "$program" export "$name" --to gltf "$name.glb"
  expect 0 "$program" export "$scenario" --to gltf "$name-start.glb"
done
expect 0 node validate.mjs ./*.glb
cat -- "$work/log"
for name in hexapod caterpillar rubble pendulum hills push; do
  said "/$name.glb: 0 errors, 0 warnings, 1 animations"
  said "/$name-start.glb: 0 errors, 0 warnings, 0 animations"
done
ok "no error and no warning in 12 files"

# A file with a quaternion that is not normalised, and a truncated file.
sed '0,/"rotation":\[0.0,0.0,0.0,1.0\]/s//"rotation":[9.0,0.0,0.0,1.0]/' hexapod.glb >long.glb
head -c 5000 hexapod.glb >cut.glb
for damaged in long cut; do
  expect 1 node validate.mjs "$damaged.glb"
  said '1 errors'
done
ok "damaged files are found"
