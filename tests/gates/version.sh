#!/usr/bin/env bash
# The id of a build: version and commit, or the version alone at the unchanged tag of the release.
# usage: version.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"

cd -- "$work"
git init --quiet tree
export GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
commit() { git -C tree commit --quiet --allow-empty -m "$1"; }
# expect_id WHERE PATTERN [OF_COMMIT]
expect_id() {
  expect 0 cmake -DSOURCE_DIR="$work/tree" -DOUTPUT="$work/id.cpp" -DVERSION=0.1.0 -DCOMPILER=GNU -DLIBRARIES=Bullet -P "$root/cmake/build_id.cmake"
  grep -qE "return \"$2 \(GNU; Bullet\)\"" id.cpp || fail "$1: $(grep return id.cpp), not $2"
  grep -q "build_is_of_commit() { return ${3:-true}; }" id.cpp || fail "$1: build_is_of_commit() is not ${3:-true}"
  ok "$1: $2"
}
commit one
expect_id "a commit" '0\.1\.0\+[0-9a-f]{10}'
git -C tree tag v0.0.9
expect_id "the tag of another release" '0\.1\.0\+[0-9a-f]{10}'
git -C tree tag v0.1.0
expect_id "the tag of the release" '0\.1\.0'
touch tree/file && git -C tree add file
expect_id "a change after the tag" '0\.1\.0\+[0-9a-f]{10}\.dirty' false
commit two
expect_id "a commit after the tag" '0\.1\.0\+[0-9a-f]{10}'
verdict
