# SPDX-License-Identifier: GPL-2.0-or-later
# lsm_is_left_out(<name> <out>): whether lmp_fault does without a source or header of LAMMPS, given by its name without
# ending. It has interactions, fixes, computes and commands only as far as a fault or other sources refer to them: the rest
# is three fifths of LAMMPS' objects.
set(lsm_left_out "^(angle|bond|dihedral|improper|pair|fix|compute|gran|granular|imbalance|reader|reset_atoms)_")
string(APPEND lsm_left_out "|^(balance|change_box|create_atoms|create_bonds|delete_atoms|delete_bonds|deprecated|displace_atoms|imbalance|minimize|"
       "rcb|read_dump|reader|replicate|rerun|set|table_file_reader|tabular_function|write_coeff|write_data|write_dump)$")
set(lsm_kept "_hybrid$|^fix_(bond_history|deform|dummy|external|group|minimize|neigh_history|property_atom|read_restart|respa|store_.*)$|^compute_(chunk_atom|fragment_atom|pe|pressure|temp)$")

function(lsm_is_left_out name out)
  if(name MATCHES "${lsm_left_out}" AND NOT name MATCHES "${lsm_kept}")
    set(${out} TRUE PARENT_SCOPE)
  else()
    set(${out} FALSE PARENT_SCOPE)
  endif()
endfunction()
