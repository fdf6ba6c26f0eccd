# SPDX-License-Identifier: GPL-2.0-or-later
# lsm_is_left_out(<name> <out>): whether lmp_fault does without a source or header of LAMMPS, given by its name without
# ending. It has interactions, fixes and computes only as far as other sources refer to them: the rest is half of
# LAMMPS' objects.
set(lsm_left_out "^(angle|bond|dihedral|improper|pair|fix|compute|gran|granular)_")
set(lsm_kept "_(hybrid|write|deprecated|zero)$|^fix_(bond_history|deform|dummy|external|group|minimize|neigh_history|property_atom|read_restart|respa|store_.*)$|^compute_(chunk|chunk_atom|fragment_atom|pe|pressure|temp)$")

function(lsm_is_left_out name out)
  if(name MATCHES "${lsm_left_out}" AND NOT name MATCHES "${lsm_kept}")
    set(${out} TRUE PARENT_SCOPE)
  else()
    set(${out} FALSE PARENT_SCOPE)
  endif()
endfunction()
