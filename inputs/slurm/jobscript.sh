#!/bin/bash
# properties = {properties}
# Near the time limit the run is asked to end, which it does at its next restart file; then the job
# is queued again, unless it was cancelled.
told=
trap 'told=is-$(squeue -h -j "$SLURM_JOB_ID" -o %T); kill -TERM -- -$child' TERM
set -m
( {exec_job} ) &
child=$!
wait $child; code=$?
while [ -n "$told" ] && kill -0 $child 2>/dev/null; do wait $child; code=$?; done
[ "$told" != is-RUNNING ] || [ $code = 0 ] || scontrol requeue "$SLURM_JOB_ID"
exit $code
