# SPDX-License-Identifier: GPL-2.0-or-later
# To be sourced. slurm_begin FOLDER [OPTION=VALUE...]: a Slurm of one node with two cores on this
# machine, all of it in FOLDER, with further lines of slurm.conf; returns 1 with the reason in
# slurm_missing. slurm_end ends what was begun.
slurm_begin() {
  local folder=$1 host program
  host=$(hostname -s)
  shift
  [ "$(id -u)" = 0 ] || { slurm_missing="not root"; return 1; }
  for program in munged slurmctld slurmd sbatch; do
    command -v $program >/dev/null || { slurm_missing="no $program (Debian packages slurm-wlm, munge)"; return 1; }
  done
  mkdir -p "$folder"/{state,spool,munge}
  chmod 755 "$folder"
  dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 status=none
  chmod 400 "$folder/munge/key"
  cat >"$folder/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$((20000 + $$ % 10000))
SlurmdPort=$((30000 + $$ % 10000))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
KillWait=5
MpiDefault=none
$(printf '%s\n' "$@")
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=2000 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
  export SLURM_CONF=$folder/slurm.conf
  slurm_folder=$folder
  munged --force --socket="$folder/munge/socket" --key-file="$folder/munge/key" --pid-file="$folder/munge.pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" 2>"$folder/munge.txt" ||
    { slurm_missing="munged does not start: $(head -n 1 "$folder/munge.txt")"; return 1; }
  slurmctld && slurmd || { slurm_missing="Slurm does not start, see $folder"; return 1; }
  for program in $(seq 100); do
    sinfo -h -o %t 2>/dev/null | grep -qE 'idle|mix|alloc' && return 0
    sleep 0.2
  done
  slurm_missing="the node does not come up: $(tail -n 1 "$folder/slurmd.log")"
  return 1
}
slurm_end() {
  local file
  [ -n "${slurm_folder:-}" ] || return 0
  scancel -u root 2>/dev/null
  for file in slurmd.pid slurmctld.pid munge.pid; do
    [ ! -s "$slurm_folder/$file" ] || kill "$(cat "$slurm_folder/$file")" 2>/dev/null
  done
}
