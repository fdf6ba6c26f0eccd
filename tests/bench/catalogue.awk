# SPDX-License-Identifier: GPL-2.0-or-later
# awk -v n=EVENTS -f catalogue.awk: a catalogue of so many events, sizes 1e-3 to 1 with exponent 1.07, intervals exponential.
BEGIN { srand(1)
  print "# lsm-catalogue 1\n# model = lsm\n# dt = 0.12\n# completeness = 0.001"
  print "event_id,t_start,t_end,step_start,step_end,size,pe_start,pe_end"
  for (i = 1; i <= n; i++) {
    do size = 1e-3 * (1 - rand()) ^ (-1 / 0.07); while (size > 1)
    start = end + 1 + int(-log(1 - rand()) * 300)
    end = start + 1 + int(rand() * 300)
    printf "%d,%.2f,%.2f,%.0f,%.0f,%.9g,1.5,%.9g\n", i, start * 0.12, end * 0.12, start, end, size, 1.5 - size
  }
}
