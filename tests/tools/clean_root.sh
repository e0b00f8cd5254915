#!/usr/bin/env bash
# The Debian packages in a fresh Debian 12 (mmdebstrap; needs root and a network, ten minutes): apt installs them with their
# dependencies; program, Python package and a plugin built with gaitlab-dev work, without and with /proc, and without the source
# tree.
# usage: clean_root.sh FOLDER [ROOT]     FOLDER has the packages (./lab package FOLDER); ROOT is used again if it exists,
# and kept
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
packages=$(readlink -e -- "$1")
fresh=${2:-$work/fresh}

# inside COMMAND...: runs COMMAND in the fresh system.
inside() { chroot "$fresh" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }

make_root() {
  [[ -d $fresh/etc ]] || expect 0 mmdebstrap --variant=minbase bookworm "$fresh"
  cp -- /etc/resolv.conf "$fresh/etc/"
  mkdir -p "$fresh/packages"
  cp -- "$packages"/*.deb "$fresh/packages/"
  expect 0 inside apt-get update
  expect 0 inside sh -c 'apt-get install --yes --no-install-recommends --reinstall /packages/gaitlab_*.deb'
  [[ ! -e $fresh$root ]] || fail "the fresh system has the source tree"
  ok "apt installs gaitlab: $(inside dpkg -l | grep -c '^ii') packages in all"
}

check_program() {
  expect 0 inside rm -rf /root/tried
  expect 0 inside mkdir /root/tried
  expect 0 inside sh -ec 'cd /root/tried && gaitlab demo'
  said 'verdict feasible'
  expect 0 inside sh -ec 'cd /root/tried && gaitlab run hexapod --set duration=1 --set physics.engine=articulated'
  expect 0 inside sh -ec 'cd /root/tried && gaitlab run hexapod --set duration=0.2 --quiet'
  expect 0 inside sh -ec 'cd /root/tried && gaitlab rerun runs/hexapod-2 --verify --quiet'
  expect 0 inside gaitlab list
  said '/usr/share/gaitlab/scenarios/robots/hexapod.dat'
  ok "$1: demo, run hexapod, rerun, list"
}

check_plugin() {
  expect 0 inside sh -ec 'cd /root/tried && gaitlab new plugin cpg mine && cd mine && cmake -B build -DCMAKE_CXX_COMPILER=g++-12 &&
    cmake --build build && ctest --test-dir build && gaitlab run scenario.yaml --set duration=0.3 --quiet'
  ok "$1: a plugin is built with gaitlab-dev, tested and run"
}

check_python() {
  expect 0 inside python3 -c '
import os
import gaitlab
os.chdir("/root/tried")
run = gaitlab.run(gaitlab.Scenario("hexapod", {"physics.engine": "articulated", "duration": 1}))
assert run.outcome == "done", run.outcome
assert gaitlab.read("runs/hexapod").verdict["verdict"] == "feasible"
print("gaitlab", gaitlab.__version__, len(gaitlab.rollouts(gaitlab.Scenario("caterpillar", {"duration": 0.2}), [{}, {}]).outcome), "rollouts")'
  said 'gaitlab .* 2 rollouts'
  ok "$1: Python runs a shipped scenario, rollouts, and reads a run folder"
}

make_root
check_program "without /proc"
expect 0 inside sh -c 'apt-get install --yes --no-install-recommends --reinstall /packages/gaitlab-dev_*.deb /packages/python3-gaitlab_*.deb cmake make g++-12'
ok "apt installs gaitlab-dev and python3-gaitlab"
check_python "without /proc"
check_plugin "without /proc"
trap 'umount "$fresh/proc"; rm -rf --one-file-system -- "$work"' EXIT
mount -t proc proc "$fresh/proc"
check_program "with /proc"
check_python "with /proc"
check_plugin "with /proc"
expect 0 inside apt-get remove --yes gaitlab
[[ ! -e $fresh/usr/lib/python3/dist-packages/gaitlab && ! -e $fresh/usr/share/gaitlab ]] || bad "files are left after the removal"
ok "apt removes all three"
verdict
