# SPDX-License-Identifier: GPL-2.0-or-later
# To be sourced before mpirun is called: Open MPI as root (containers), no binding (several runs at
# a time would share a core), no advice about transports, and a rank that waits gives its core to
# others. A program that is started without mpirun asks no daemon and makes no session folder: all
# such programs would share one, and the first to end removes it while another begins.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_btl_base_warn_component_unused=0 OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1 OMPI_MCA_ess_singleton_isolated=1
export OMPI_MCA_orte_create_session_dirs=0
# A session folder of its own for each: two that begin at the same moment get in each other's way in
# the common one. The path is short, as sockets lie below it.
mpirun() {
  local session status=0
  session=$(mktemp -d "${TMPDIR:-/tmp}/mpi.XXXXXX")
  OMPI_MCA_orte_create_session_dirs=1 OMPI_MCA_orte_tmpdir_base=$session command mpirun "$@" || status=$?
  rm -rf "$session"
  return $status
}
