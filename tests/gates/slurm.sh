#!/usr/bin/env bash
# The recipes of docs/studies.md work in a separate Slurm on loopback and give the rows of a single process: shards, of which one is
# killed and requeued, their merging, and MPI in a job.
# usage: slurm.sh PROGRAM (gaitlab-mpi must be in the folder of PROGRAM)
source "$(dirname -- "${BASH_SOURCE[0]}")/../prelude.sh"
(($#)) || usage
program=$(readlink -f -- "$1")
for needed in munged slurmctld slurmd sbatch runuser sqlite3; do
  command -v "$needed" >/dev/null || { skip "slurm" "$needed is missing (Debian: munge slurmctld slurmd slurm-client sqlite3)"; exit 77; }
done
((EUID == 0)) || { skip "slurm" "needs root, to start slurmd and munged"; exit 77; }
id munge >/dev/null 2>&1 || { skip "slurm" "there is no user munge (Debian: munge)"; exit 77; }

slurm=$work/slurm
export SLURM_CONF=$slurm/slurm.conf
# Ends the processes that this script started, by their pid files.
stop() {
  [[ ! -e $slurm/slurmctld.pid ]] || scancel --user=root >/dev/null 2>&1 || true
  local file pid
  for file in "$slurm"/slurmd.*.pid "$slurm/slurmctld.pid" "$slurm/munge/pid"; do
    [[ -s $file ]] || continue
    pid=$(<"$file")
    kill "$pid" 2>/dev/null || continue
    for _ in $(seq 50); do kill -0 "$pid" 2>/dev/null || break; sleep 0.1; done
    kill -9 "$pid" 2>/dev/null || true
  done
}
trap 'stop; rm -rf -- "$work"' EXIT

start() {
  local host port=$((20000 + $$ % 1000 * 10)) node
  host=$(hostname -s)
  mkdir -p "$slurm"/{state,spool,munge}
  chmod 711 "$work" "$slurm" "$slurm/munge"
  head -c 1024 /dev/urandom >"$slurm/munge/key"
  chmod 400 "$slurm/munge/key"
  chown -R munge "$slurm/munge"
  cat >"$SLURM_CONF" <<TEXT
ClusterName=loop
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm/munge/socket
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool/%n
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.%n.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.%n.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=100000
# Long limits, so that no answer is too late on a busy machine.
MessageTimeout=100
TCPTimeout=60
BatchStartTimeout=1200
SlurmdTimeout=0
MinJobAge=60000
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 3)) CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
TEXT
  local m=$slurm/munge
  runuser -u munge -- munged --key-file="$m/key" --socket="$m/socket" --pid-file="$m/pid" --log-file="$m/log" --seed-file="$m/seed" || return 1
  slurmctld -c || return 1
  for node in n1 n2; do slurmd -N $node || return 1; done
  wait_until $$ test -s "$slurm/slurmd.n2.pid"
}
idle() { [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]]; }
if ! start >"$work/start.log" 2>&1; then
  skip "slurm" "could not be started: $(tail -q -n 1 "$work/start.log" "$slurm/slurmctld.log" 2>/dev/null | tr '\n' ' ')"
  exit 77
fi
daemon=$(<"$slurm/slurmd.n2.pid")
wait_for "$daemon" "two idle nodes" idle
ok "a Slurm with two nodes"

# ended JOB: waits until all tasks of JOB have ended.
ended() { wait_until "$daemon" is_over "$1" || { squeue >&2 && fail "job $1 does not end"; }; }
is_over() { left=$(squeue -h -j "$1" -t PENDING,RUNNING,COMPLETING -o %i 2>/dev/null) && [[ -z $left ]]; }
# recipe NUMBER: prints the script number NUMBER of docs/studies.md.
recipe() { awk -v number="$1" '/^    #!/ { ++n } /^    / { if (n == number && !over) print substr($0, 5); next } n == number { over = 1 }' "$root/docs/studies.md"; }

source "$root/tests/gates/two_modules.sh"
two_modules "$work" "method: {type: random}" "budget: {runs: 160}" "seed: 6"
cd "$work"
# Random points with cpg.wait above 0.9 wait. With this seed the first are runs 66 and 67, the seventeenth of shards 2 and 3.
sed -i "s,^cpg: .*,cpg: {type: waits}\nplugins: [$(plugin waits)]," two.yaml
sed -i 's/^  cpg.type: .*/  cpg.wait: {low: 0, high: 0.95}/' study.yaml
PATH=$(dirname -- "$program"):$PATH
export PATH STUDY=$work/study.yaml OUT=$work/runs/map OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
recipe 1 >shards.sbatch
recipe 2 >mpi.sbatch
grep -q -- '--shard auto' shards.sbatch && grep -q '^exec mpirun gaitlab-mpi' mpi.sbatch || fail "docs/studies.md has no such recipes"
expect 0 gaitlab sweep "$STUDY" --out "$work/whole" -j 2 --quiet

hold
job=$(sbatch --parsable --array=0-3 --cpus-per-task=1 shards.sbatch)
shard=$OUT/shards/2-of-4
waits() {
  pid=$(sed 's/^process \([0-9]*\) on .*/\1/' "$shard.lock" 2>/dev/null) && [[ -n $pid && -e $GAITLAB_HOLD/$pid ]] && more_than 0 "$shard.db"
}
wait_for "$daemon" "shard 2 in the middle of its runs" waits
kill -9 "$pid"
release
ended "$job"
expect 1 gaitlab study merge "$OUT"
said "1 of 4 shards are missing or incomplete; run them again: --array=2"
ok "one of four tasks killed, and told"

scontrol requeue "${job}_2" && scontrol update "JobId=${job}_2" StartTime=now
merge=$(sbatch --parsable --dependency="afterany:$job" --wrap 'gaitlab study merge "$OUT"')
ended "$job"
ended "$merge"
grep -q ": 160 of 160 runs" "slurm-$merge.out" || bad "merge job: $(<"slurm-$merge.out")"
if cmp <(rows "$work/whole") <(rows "$OUT"); then ok "requeued and merged: the rows of one process"; else bad "requeued and merged: other rows"; fi

if [[ -x $(dirname -- "$program")/gaitlab-mpi ]] && command -v mpirun >/dev/null; then
  job=$(OUT=$work/runs/mpi sbatch --parsable --nodes=1 --ntasks=2 mpi.sbatch)
  ended "$job"
  if cmp <(rows "$work/whole") <(rows "$work/runs/mpi"); then ok "MPI in a job: the rows of one process"; else bad "MPI in a job: $(<"slurm-$job.out")"; fi
else
  skip "MPI in a job" "gaitlab-mpi or mpirun is missing (Debian: libopenmpi-dev openmpi-bin)"
fi
verdict
