# SPDX-License-Identifier: GPL-2.0-or-later
# To be sourced before mpirun is called: allows Open MPI as root (containers), without binding
# (several runs at a time would share a core) and without advice about transports; a waiting rank
# yields its core. A program started without mpirun asks no daemon and makes no session folder: all
# such programs would share one, and the first to end would remove it while another begins.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_btl_base_warn_component_unused=0 OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1 OMPI_MCA_ess_singleton_isolated=1
export OMPI_MCA_orte_create_session_dirs=0
# Open MPI 5 starts ranks by PRRTE, with names of its own.
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
# A session folder for each: in a common one, two mpirun that start at the same moment interfere.
# The path is short, as sockets lie below it. A run ends with the script that began it, even by
# kill -9.
mpirun() {
  local session status=0
  session=$(mktemp -d "${TMPDIR:-/tmp}/mpi.XXXXXX")
  OMPI_MCA_orte_create_session_dirs=1 OMPI_MCA_orte_tmpdir_base=$session setpriv --pdeathsig TERM mpirun "$@" || status=$?
  rm -rf "$session"
  return $status
}
