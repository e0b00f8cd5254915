#!/usr/bin/env bash
# Folders of studies that are damaged, forged, read-only or on a full disk are refused with a message (exit code 1 or 2) and without a
# crash, and rows of a journal are preserved.
# usage: hostile.sh PROGRAM
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
command -v sqlite3 >/dev/null || { skip "hostile" "sqlite3 is missing (Debian: sqlite3)"; exit 77; }
source "$root/tests/gates/two_modules.sh"
two_modules "$work" "method: {type: random}" "budget: {runs: 24}"
sweep() { "$program" sweep "$work/study.yaml" --quiet -j 1 "$@"; }
expect 0 sweep --out "$work/whole"
sqlite3 "$work/whole/study.db" 'pragma wal_checkpoint(truncate)' >/dev/null
rows "$work/whole" >"$work/rows"
size=$(stat -c %s "$work/whole/study.db")

# copy: creates a new copy of the study in $work/now.
copy() { rm -rf "$work/now" && cp -r "$work/whole" "$work/now"; }
# ends CASE CODES COMMAND...: expects one of these exit codes within a minute of CPU time. (A tenth of a second is usual, and a second with
# sanitizers.) The limit of ten minutes of real time is for commands that do not end.
ends() {
  local code=0
  (ulimit -t 60 && exec timeout 600 "${@:3}") >"$work/log" 2>&1 || code=$?
  [[ " $2 " == *" $code "* ]] || { show_log; bad "$1: exit code $code, expected one of $2: ${*:3}"; }
}

# Journals that are truncated at any position, and journals with changed bytes.
for k in $(seq 0 24); do
  copy
  truncate -s $((size * k / 25 + k)) "$work/now/study.db"
  ends "cut at $k / 25" "0 2" "$program" study show "$work/now"
  ends "cut at $k / 25" "0 1 2" "$program" sweep "$work/study.yaml" --quiet -j 1 --out "$work/now"
done
RANDOM=1
for k in $(seq 25); do
  copy
  for _ in $(seq 20); do
    printf '%b' "\\x$(printf %02x $((RANDOM % 256)))" | dd of="$work/now/study.db" bs=1 seek=$(((RANDOM * 32768 + RANDOM) % size)) conv=notrunc status=none
  done
  ends "changed bytes, $k" "0 1 2" "$program" study show "$work/now"
  ends "changed bytes, $k" "0 1 2 3" "$program" study best "$work/now"
done
ok "cut and changed journals end with a message"

# change SQL MESSAGE: expects MESSAGE from show, best and sweep with a journal that SQL has changed.
change() {
  copy
  sqlite3 "$work/now/study.db" "$1" || bad "sqlite3: $1"
  expect 2 "$program" study show "$work/now"
  said "$2"
  expect 2 sweep --out "$work/now"
  said "$2"
}
change "alter table effort rename to e; create view effort as select * from e" "is not a journal that this program wrote: its table effort is another"
change "update quantity set name = 'a\"); drop table run; --' where name = 'speed'" "is not a journal that this program wrote: its table run is another"
change "update parameter set key = 'x\" REAL); drop table run; --'" "is not a journal that this program wrote: its table run is another"
change "delete from study" "is not a journal that this program wrote: it names no study"
change "update study set runs = -1" "its numbers of runs are out of range"
change "update study set runs = 9223372036854775807" "its numbers of runs are out of range"
change "update study set replicates = 0" "its numbers of runs are out of range"
change "delete from objective" "its number of objectives is out of range"
change "pragma user_version = 99" "is a journal of format 99; this program reads format 1"
change "pragma application_id = 7" "is a database of SQLite, and not the journal of a study"
copy
sqlite3 "$work/now/study.db" "update run set verdict = 'fesible'"
expect 2 "$program" study show "$work/now"
said "has the verdict 'fesible'; did you mean 'feasible'?"
ok "a stranger's tables are refused"

# Added triggers do not run, and unusual values in rows are displayed unchanged.
copy
sqlite3 "$work/now/study.db" "create trigger t after insert on run begin delete from run; end; create trigger u after delete on attempt begin delete from run; end;
  delete from run where run = 5"
expect 0 sweep --out "$work/now"
cmp <(rows "$work/now") "$work/rows" || bad "a trigger in a journal ran"
copy
sqlite3 "$work/now/study.db" "update run set run = 9223372036854775807 where run = 23; update run set run = -5 where run = 22;
  update run set outcome = char(27) || '[31m', message = char(10) || 'x' where run = 3; update study set combine = 'quantile', quantile = 1e308, runs = 4000000000"
for verb in show best; do ends "odd rows" "0 3" "$program" study $verb "$work/now"; done
! grep -q $'\e' "$work/log" || bad "control characters of a stranger reach the terminal"
ends "odd rows" "0" "$program" study export "$work/now" --to csv "$work/now/odd.csv"
ends "odd rows" "0 2" "$program" evaluate "$work/study.yaml" --quiet --out "$work/now" </dev/null
ok "a stranger's triggers and rows are data"

# A user without write permission can display the study, and gets a message.
if ((EUID == 0)) && command -v setpriv >/dev/null && chmod 711 "$work" && setpriv --reuid=65534 --clear-groups test -x "$program" -a -r "$root/scenarios/modules/mtran.yaml"; then
  copy
  chmod -R a+rX "$work/now" "$work/two.yaml" "$work/study.yaml"
  nobody() { (cd / && setpriv --reuid=65534 --clear-groups "$@"); }
  expect 0 nobody "$program" study show "$work/now"
  expect 2 nobody "$program" sweep "$work/study.yaml" --quiet --out "$work/now"
  said "now/lock: error: cannot be opened: Permission denied"
  expect 2 nobody "$program" evaluate "$work/study.yaml" --quiet --out "$work/new"
  said "Permission denied"
  ok "a read-only folder can be looked at, and is refused"
else
  skip "a read-only folder" "needs root, setpriv, and files that others may read"
fi

# A file system that becomes full.
mkdir "$work/disk"
if unshare -m true 2>/dev/null && unshare -m mount -t tmpfs none "$work/disk" 2>/dev/null; then
  sed -i 's/runs: 24/runs: 160/' "$work/study.yaml"
  expect 0 sweep --out "$work/more"
  rows "$work/more" >"$work/more.rows"
  # shellcheck disable=SC2016 # words of the inner shell
  unshare -m bash -c 'disk=$1 program=$2 study=$3
    mount -t tmpfs -o size=256k none "$disk"
    "$program" sweep "$study" --quiet -j 1 --out "$disk/s" 2>"$disk.log"; echo $? >"$disk.code"
    sqlite3 "$disk/s/study.db" "select count(*) from run; pragma integrity_check" >"$disk.state" 2>&1
    mount -o remount,size=16m "$disk"
    "$program" sweep "$study" --quiet -j 1 --out "$disk/s" && cp -r "$disk/s" "$disk.kept"' - "$work/disk" "$program" "$work/study.yaml"
  [[ $(<"$work/disk.code") == 1 ]] || bad "a full file system: exit code $(<"$work/disk.code")"
  grep -q 'cannot be written: .*; its content is kept' "$work/disk.log" || bad "a full file system: $(<"$work/disk.log")"
  cmp <(rows "$work/disk.kept") "$work/more.rows" || bad "after a full file system: other rows"
  ok "a full file system is told ($(head -n 1 "$work/disk.state") rows kept), and the same command goes on"
else
  skip "a full file system" "needs root and mount"
fi

# No command waits for a FIFO under any name that it opens. A command that hangs is killed after two minutes.
sed -i 's/runs: 160/runs: 24/' "$work/study.yaml"
# bounded CASE CODES COMMAND...: like `ends`, with a limit of real time that is sufficient on a busy machine.
bounded() {
  local code=0
  timeout -s KILL 120 "${@:3}" >"$work/log" 2>&1 || code=$?
  [[ " $2 " == *" $code "* ]] || { show_log; bad "$1: exit code $code, expected one of $2: ${*:3}"; }
}
for name in study.db study.db-wal study.db-shm study.db-journal; do
  copy
  rm -f -- "$work/now/$name"
  mkfifo "$work/now/$name"
  for verb in show report best; do bounded "FIFO $name" 2 "$program" study $verb "$work/now"; done
  said "$name: error: cannot be read: not a regular file"
  bounded "FIFO $name" 2 "$program" study rerun "$work/now" 1
  bounded "FIFO $name" 2 "$program" sweep "$work/study.yaml" --quiet -j 1 --out "$work/now"
  bounded "FIFO $name" 2 "$program" sweep "$work/study.yaml" --quiet -j 1 --out "$work/fresh" --answers "$work/now/study.db"
done
copy
rm -f -- "$work/now/lock"
mkfifo "$work/now/lock"
bounded "FIFO lock" 0 "$program" study show "$work/now"
bounded "FIFO lock" 2 "$program" sweep "$work/study.yaml" --quiet -j 1 --out "$work/now"
said "is not the lock of a study"
mkdir -p "$work/parts/shards"
mkfifo "$work/parts/shards/0-of-4.db"
bounded "FIFO of a shard" 2 "$program" study merge "$work/parts"
ok "FIFOs in the folder of a study are refused"
# On a file system without locks (three possible errors), one process writes a study and prints the note once.
noted_once() { (($(grep -c 'the file system has no locks' "$work/log") == 1)) || { show_log; bad "$1: not one note on locks"; }; }
has_rows() { "${without_locks[@]}" study show "$work/now" 2>/dev/null | grep -qE ': [1-9][0-9]* of'; }
for error in 37 38 95; do # ENOLCK, ENOSYS, EOPNOTSUPP
  without_locks=(env "LD_PRELOAD=$(plugin no_locks)" "GAITLAB_LOCK_ERROR=$error" "$program")
  rm -rf -- "$work/now"
  # 100 000 runs cannot end before the signal. The reader must not take the log of the process that writes.
  "${without_locks[@]}" sweep "$work/study.yaml" --quiet -j 1 --runs 100000 --out "$work/now" >"$work/log" 2>&1 &
  process=$!
  wait_for "$process" "a row without locks" has_rows
  kill -TERM "$process"
  wait "$process" || true
  noted_once "error $error"
  said ": interrupted: $(count "$work/now/study.db") of 100000 runs are in the journal"
  [[ $(sqlite3 "$work/now/study.db" 'pragma integrity_check') == ok ]] || bad "error $error: the journal is damaged"
  rm -rf -- "$work/now"
  for _ in 1 2; do expect 0 "${without_locks[@]}" sweep "$work/study.yaml" --quiet -j 1 --out "$work/now"; done
  noted_once "error $error, again"
  expect 0 "${without_locks[@]}" study show "$work/now"
  ! grep -q 'no locks' "$work/log" || bad "error $error: a reader prints the note"
  cmp -- "$work/rows" <(rows "$work/now") || bad "error $error: other rows without locks"
done
ok "a study on a file system without locks"
verdict
