# SPDX-License-Identifier: GPL-2.0-or-later
# awk -v most=RANKS -f tables.awk timings.csv setup.csv: tables in Markdown. Medians over the rounds.

function median(list,    value, n, i, j, t) {
  n = split(list, value, " ")
  if (n == 0) return 0
  for (i = 2; i <= n; i++) {
    t = value[i] + 0
    for (j = i - 1; j > 0 && value[j] + 0 > t; j--) value[j + 1] = value[j]
    value[j + 1] = t
  }
  return n % 2 ? value[(n + 1) / 2] : (value[n / 2] + value[n / 2 + 1]) / 2
}

# nanoseconds for each particle and step of all ranks together, median
function cost(key) { return median(costs[key]) }

function rate(key) { return cost(key) ? 1e3 / cost(key) : 0 }

# median over the rounds of the cost of one minus that of another
function difference(one, other,    r, list) {
  for (r = 1; r <= rounds; r++)
    if ((one SUBSEP r) in in_round && (other SUBSEP r) in in_round)
      list = list " " in_round[one, r] - in_round[other, r]
  return median(list)
}

# median over the rounds of the cost of one over that of another
function ratio(one, other,    r, list) {
  for (r = 1; r <= rounds; r++)
    if ((one SUBSEP r) in in_round && (other SUBSEP r) in in_round)
      list = list " " in_round[one, r] / in_round[other, r]
  return median(list)
}

BEGIN { FS = "," }

FNR == 1 { file++; next }

file == 1 {
  key = $1 "|" $2 "|" $3 "|" $4
  if (!(key in costs)) { order[++keys] = key; table[keys] = $1; label[keys] = $2; length_of[keys] = $3; ranks_of[keys] = $4 }
  ns = $8 / $6 / $7 * 1e9
  costs[key] = costs[key] " " ns
  in_round[key, $5] = ns
  atoms[key] = $6
  if ($5 > rounds) rounds = $5
  for (i = 10; i <= 16; i++) parts[key, i] = parts[key, i] " " $i / $6 / $7 * 1e9
  if ($1 != "peers" || $2 == "ours") cpu = cpu " " $9
  has[$1] = 1
  if ($1 == "peers" || $1 == "parts") size = $3
}

file == 2 {
  for (i = 3; i <= 5; i++) setup[$1, i] = setup[$1, i] " " $i
  has["setup"] = 1
}

# LAMMPS' own timers of a key
function timers(key,    i, line) {
  for (i = 11; i >= 10; i--) line = line sprintf(" %.2f |", median(parts[key, i]))
  line = line sprintf(" %.2f |", median(parts[key, 15]))
  line = line sprintf(" %.2f | %.2f | %.2f |", median(parts[key, 13]), median(parts[key, 12]),
                      median(parts[key, 14]) + median(parts[key, 16]))
  return line
}

END {
  printf "Median CPU use %.0f %%. ns are wall time per particle and step; comm of 2 ranks holds the waiting for each other.\n",
         median(cpu)

  if (has["peers"]) {
    print "\n### Side by side, PE at every step\n"
    print "| program | particles | ranks | million particle-steps/s | ns | ours is so many times faster |"
    print "|---|---|---|---|---|---|"
    for (k = 1; k <= keys; k++) {
      if (table[k] != "peers") continue
      base = "peers|ours|" length_of[k] "|" ranks_of[k]
      printf "| %s | %d | %d | %.1f | %.1f | %s |\n", label[k], atoms[order[k]], ranks_of[k], rate(order[k]), cost(order[k]),
             (order[k] == base ? "" : sprintf("%.2f", ratio(order[k], base)))
    }
    if (most > 1) {
      n = split("ours,bond harmonic,bond bpm/spring,bond harmonic with contacts,ESyS-Particle", name, ",")
      printf "\n2 ranks over 1:"
      for (i = 1; i <= n; i++)
        if (("peers|" name[i] "|" size "|2") in costs)
          printf "%s %s %.2f", (i == 1 ? "" : ","), name[i], ratio("peers|" name[i] "|" size "|1", "peers|" name[i] "|" size "|2")
      print "."
    }
  }

  if (has["parts"]) {
    print "\n### Parts, ns: saved when one after another is left out\n"
    print "| part | 1 rank |" (most > 1 ? " 2 ranks |" : "")
    print "|---|---|" (most > 1 ? "---|" : "")
    n = split("everything,events,plates,integration,contacts,links", name, ",")
    for (i = 1; i <= n + 1; i++) {
      printf "| %s |", (i == n + 1 ? "what is left" : name[i])
      for (r = 1; r <= most; r++) {
        key = "parts|" name[i == n + 1 ? n : i] "|" size "|" r
        before = "parts|" name[i - 1] "|" size "|" r
        printf " %.2f |", (i == 1 || i == n + 1 ? cost(key) : difference(before, key))
      }
      print ""
    }
    print "\nBy LAMMPS' own timers (modify: integration, plates and events):\n"
    print "| ranks | links | contacts | modify | comm | neigh | other |"
    print "|---|---|---|---|---|---|---|"
    for (k = 1; k <= keys; k++)
      if (table[k] == "parts" && label[k] == "everything") printf "| %d |%s\n", ranks_of[k], timers(order[k])
  }

  if (has["features"]) {
    printf "\n### One thing changed, %d ranks\n\n", most
    print "| change | ns | ns without the change | ratio |"
    print "|---|---|---|---|"
    for (k = 1; k <= keys; k++) {
      if (table[k] != "features" || label[k] ~ /^base of /) continue
      base = "features|base of " label[k] "|" length_of[k] "|" ranks_of[k]
      printf "| %s | %.2f | %.2f | %.3f |\n", label[k], cost(order[k]), cost(base), ratio(order[k], base)
    }
  }

  if (has["lengths"]) {
    print "\n### Against the length of the fault\n"
    print "| length | particles | ranks | million particle-steps/s | ns | links | contacts | modify | comm | neigh | other |"
    print "|---|---|---|---|---|---|---|---|---|---|---|"
    for (k = 1; k <= keys; k++)
      if (table[k] == "lengths")
        printf "| %d | %d | %d | %.1f | %.2f |%s\n", length_of[k], atoms[order[k]], ranks_of[k], rate(order[k]), cost(order[k]),
               timers(order[k])
  }

  if (has["setup"]) {
    print "\n### Set-up, seconds\n"
    print "| ranks | create_lsm_fault | first step | read_restart |"
    print "|---|---|---|---|"
    for (r = 1; r <= most; r++)
      printf "| %d | %.2f | %.2f | %.2f |\n", r, median(setup[r, 3]), median(setup[r, 4]), median(setup[r, 5])
  }
}
