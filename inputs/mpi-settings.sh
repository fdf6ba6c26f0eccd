# SPDX-License-Identifier: GPL-2.0-or-later
# To be sourced before mpirun is called. Open MPI is allowed as root (containers), does not bind
# ranks to cores (several runs at a time would share a core) and gives no advice about transports; a
# waiting rank yields its core. Where other programs use the cores as well, a waiting rank of Open
# MPI 5 sleeps instead (4.1 cannot); on free cores a short fault takes 2.7 times as long with it. A
# program started without mpirun starts no daemon and makes no session folder: all such programs
# would share one, and the first to end would remove it while another starts.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_btl_base_warn_component_unused=0 OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1 OMPI_MCA_ess_singleton_isolated=1
export OMPI_MCA_orte_create_session_dirs=0
# Open MPI 5 starts ranks with PRRTE, whose settings have other names.
export PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none
[ "$(cut -d. -f1 /proc/loadavg)" -lt "$(nproc)" ] || export OMPI_MCA_threads_pthreads_yield_strategy=nanosleep
# Each mpirun has its own session folder, as two that start at the same moment would interfere in a
# common one. The path is short, as it is part of the names of sockets. A run ends with the script
# that started it, even if that is killed by kill -9.
mpirun() {
  local session status=0
  session=$(mktemp -d "${TMPDIR:-/tmp}/mpi.XXXXXX")
  OMPI_MCA_orte_create_session_dirs=1 OMPI_MCA_orte_tmpdir_base=$session setpriv --pdeathsig TERM mpirun "$@" || status=$?
  rm -rf "$session"
  return $status
}
