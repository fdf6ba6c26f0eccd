#!/bin/bash
# State of a job for Snakemake: running, success or failed.
state=$(scontrol -o show job "$1" 2>/dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
[ -n "$state" ] || state=$(sacct -j "$1" -X -n -o State 2>/dev/null | head -n 1)
case $state in
  COMPLETED*) echo success ;;
  PENDING* | RUNNING* | COMPLETING* | CONFIGURING* | REQUEUE* | RESIZING* | SUSPENDED*) echo running ;;
  *) echo failed ;;
esac
