# SPDX-License-Identifier: GPL-2.0-or-later
# lsm_is_left_out(<name> <out>): whether lmp_fault does without a source or header of LAMMPS, given by its name without
# ending. It has styles and commands only as far as a fault or other sources refer to them: the rest is two thirds of
# LAMMPS' objects.
set(lsm_left_out "^(angle|bond|dihedral|improper|pair|fix|compute|gran|granular|imbalance|reader|reset_atoms)_")
string(APPEND lsm_left_out "|^(balance|change_box|create_atoms|create_bonds|delete_atoms|delete_bonds|deprecated|displace_atoms|imbalance|minimize|"
       "rcb|read_dump|reader|replicate|rerun|set|table_file_reader|tabular_function|write_coeff|write_data|write_dump)$")
# Another expression, as CMake compiles none with more parentheses.
string(CONCAT lsm_unused_styles "^(atom_vec_(angle|bpm_sphere|charge|full|molecular|template)|dump_(atom|cfg|deprecated|grid.*|image|local|movie|xyz)|"
       "grid[23]d|image|min_(deprecated|fire|hftn|quickmin|sd)|nbin_multi|npair_(.*ghost|multi.*|nsq|respa.*|skip_respa)|"
       "nstencil_(ghost_bin|multi.*)|region_(cone|cylinder|deprecated|ellipsoid|intersect|plane|sphere|union))$")
set(lsm_kept "_hybrid$|^fix_(bond_history|deform|dummy|external|group|minimize|neigh_history|property_atom|read_restart|respa|store_.*)$|^compute_(chunk_atom|fragment_atom|pe|pressure|temp)$")
# Sources that include lists of styles of which lmp_fault leaves some out, beside those that include lists with the package's.
set(lsm_shorter_categories atom dump minimize nbin npair nstencil region)
set(lsm_shorter_sources atom domain neighbor output update)

function(lsm_is_left_out name out)
  if((name MATCHES "${lsm_left_out}" OR name MATCHES "${lsm_unused_styles}") AND NOT name MATCHES "${lsm_kept}")
    set(${out} TRUE PARENT_SCOPE)
  else()
    set(${out} FALSE PARENT_SCOPE)
  endif()
endfunction()
