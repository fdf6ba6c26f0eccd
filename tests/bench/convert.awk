# SPDX-License-Identifier: GPL-2.0-or-later
# awk -v name=NAME -f convert.awk NAME.data: NAME.types.data and NAME.types.in, where links have one of 256 types by
# rest length, and NAME.geo for ESyS-Particle.

function close_to(length_of_link) {
  return 1 + int((length_of_link - 0.2) / 1.8 * 256)
}

BEGIN {
  types = name ".types.data"
  for (t = 1; t <= 256; t++)
    printf "bond_coeff %d 0.5 %.9f\n", t, 0.2 + (t - 0.5) / 256 * 1.8 > (name ".types.in")
}
/ atoms$/ { atoms = $1 }
/ bonds$/ { bonds = $1 }
/ xhi$/ { length_of_box = $2 }
/^[A-Z]/ && NR > 1 { section = $1 }
/^1 bond types|bond types$/ { print "256 bond types" > types; next }
section == "Atoms" && NF > 7 {
  radius[$1] = $7 / 2
  particles[++n] = $3 " " $4 " 0 " $7 / 2 " " $1 " " $2
}
section == "Bonds" && NF == 4 {
  type = close_to(radius[$3] + radius[$4])
  if (type > 256) type = 256
  links[++m] = $3 " " $4 " 0"
  print $1, type, $3, $4 > types
  next
}
{ print > types }
END {
  geo = name ".geo"
  printf "LSMGeometry 1.2\nBoundingBox 0 -10 -5 %g 40 5\nPeriodicBoundaries 1 0 0\nDimension 2D\n",
         length_of_box > geo
  printf "BeginParticles\nSimple\n%d\n", n > geo
  for (i = 1; i <= n; i++) print particles[i] > geo
  printf "EndParticles\nBeginConnect\n%d\n", m > geo
  for (i = 1; i <= m; i++) print links[i] > geo
  print "EndConnect" > geo
}
