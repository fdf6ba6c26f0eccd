# SPDX-License-Identifier: GPL-2.0-or-later
# awk -v most=RANKS -f tables.awk timings.csv setup.csv scale.csv analysis.csv triad.csv: tables in Markdown. Medians over the rounds.

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

# median of nanoseconds per particle and step, of all ranks together
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
  cpu_costs[key] = cpu_costs[key] " " ns * $9 / 100
  atoms[key] = $6
  if ($5 > rounds) rounds = $5
  for (i = 10; i <= 16; i++) parts[key, i] = parts[key, i] " " $i / $6 / $7 * 1e9
  if ($17 > 0) { resident[key] = resident[key] " " $17; any_resident = 1 }
  if ($1 != "peers" || $2 == "ours") cpu = cpu " " $9
  has[$1] = 1
  if ($1 == "peers" || $1 == "parts") size = $3
}

file == 2 {
  for (i = 3; i <= 6; i++) setup[$1, i] = setup[$1, i] " " $i
  has["setup"] = 1
}

file == 3 {
  scales++
  for (i = 1; i <= 10; i++) scale[scales, i] = $i
  has["scale"] = 1
}

file == 4 {
  events = $1
  if (!($2 in analysis)) command[++commands] = $2
  analysis[$2] = analysis[$2] " " $3
  kilobytes[$2] = kilobytes[$2] " " $4
}

file == 5 {
  triads[$1]++
  triad_at[$1, triads[$1]] = $2
  triad[$1, triads[$1]] = $3
}

# Bytes that a step reads and writes per particle: clearing of forces 24; 2.53 links of 16, positions 24, forces in both directions 48;
# integration: forces 24, velocities and positions in both directions 96, mass, viscosity and type 16.
function bytes_of_step() { return 24 + 2.53 * 16 + 24 + 48 + 24 + 96 + 16 }

# size of these data
function bytes_of_data() { return 72 + 2.53 * 16 + 16 }

# bandwidth of each rank, GB/s, for the given megabytes on each
function bandwidth_of(ranks, megabytes,    i) {
  if (megabytes <= triad_at[ranks, 1]) return triad[ranks, 1]
  for (i = 2; i <= triads[ranks]; i++)
    if (megabytes <= triad_at[ranks, i])
      return triad[ranks, i - 1] + (triad[ranks, i] - triad[ranks, i - 1]) * log(megabytes / triad_at[ranks, i - 1]) / log(triad_at[ranks, i] / triad_at[ranks, i - 1])
  return triad[ranks, triads[ranks]]
}

# ns per particle and step on one rank with the given number of particles, interpolated between measurements
function cost_of_share(particles,    k, n, at, value, i) {
  for (k = 1; k <= keys; k++)
    if (table[k] == "lengths" && ranks_of[k] == 1) { at[++n] = log(atoms[order[k]]); value[n] = cost(order[k]) }
  if (log(particles) <= at[1]) return value[1]
  for (i = 2; i <= n; i++)
    if (log(particles) <= at[i])
      return value[i - 1] + (value[i] - value[i - 1]) * (log(particles) - at[i - 1]) / (at[i] - at[i - 1])
  return value[n]
}

# microseconds of a step: computation of the largest share, messages to both neighbours at the same time, and
# collective calls that go up and down a tree
function step_time(particles, ranks, bytes, collectives, spread,    share, t, levels, sum) {
  share = particles / ranks
  t = (ranks == 1 ? share : share + spread * sqrt(share)) * cost_of_share(share) * 1e-3
  if (ranks == 1) return t
  levels = int(log(ranks) / log(2) + 0.999)
  sum = 2 * levels * latency    # of the forces on the plates: beside the integration only
  return t + latency + bytes / 2 / bandwidth * 1e-3 + collectives * 2 * levels * latency + (sum > 0.25 * t ? sum - 0.25 * t : 0)
}

# a further column, if any program was measured
function memory(text) { return any_resident ? " " text " |" : "" }

function memory_of(key) { return memory(sprintf("%.0f", median(resident[key]) * 1024 / atoms[key])) }

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
    print "| program | particles | ranks | million particle-steps/s | ns | speed of ours over it |" memory("memory, bytes per particle")
    print "|---|---|---|---|---|---|" (any_resident ? "---|" : "")
    for (k = 1; k <= keys; k++) {
      if (table[k] != "peers") continue
      base = "peers|ours|" length_of[k] "|" ranks_of[k]
      printf "| %s | %d | %d | %.1f | %.1f | %s |", label[k], atoms[order[k]], ranks_of[k], rate(order[k]), cost(order[k]),
             (order[k] == base ? "" : sprintf("%.2f", ratio(order[k], base)))
      print memory_of(order[k])
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

  if (has["causes"]) {
    printf "\n### From the scene of the comparisons to a run, CPU time on one rank\n\n"
    print "| what | ns | more than the run, ns |"
    print "|---|---|---|"
    for (k = 1; k <= keys; k++)
      if (table[k] == "causes") {
        base = "causes|in shear as in the campaign|" length_of[k] "|" ranks_of[k]
        printf "| %s | %.2f | %.2f |\n", label[k], median(cpu_costs[order[k]]), median(cpu_costs[order[k]]) - median(cpu_costs[base])
      }
  }

  if (has["campaign"]) {
    print "\n### Slices of the campaign\n"
    print "| length | particles | ranks | ns | hours for 1.2e6 steps | links | contacts | modify | comm | neigh | other |"
    print "|---|---|---|---|---|---|---|---|---|---|---|"
    for (k = 1; k <= keys; k++)
      if (table[k] == "campaign") {
        hours = cost(order[k]) * 1e-9 * atoms[order[k]] * 1.2e6 / 3600
        all[ranks_of[k]] += hours
        printf "| %d | %d | %d | %.2f | %.3f |%s\n", length_of[k], atoms[order[k]], ranks_of[k], cost(order[k]), hours, timers(order[k])
      }
    for (r = 1; r <= most; r++) printf "\n%d ranks: %.2f hours, %.2f core-hours.\n", r, all[r], r * all[r]
  }

  if (has["lengths"]) {
    print "\n### Against the length of the fault\n"
    print "| length | particles | ranks | million particle-steps/s | ns | links | contacts | modify | comm | neigh | other |" memory("memory, bytes per particle")
    print "|---|---|---|---|---|---|---|---|---|---|---|" (any_resident ? "---|" : "")
    for (k = 1; k <= keys; k++)
      if (table[k] == "lengths")
        printf "| %d | %d | %d | %.1f | %.2f |%s%s\n", length_of[k], atoms[order[k]], ranks_of[k], rate(order[k]), cost(order[k]),
               timers(order[k]), memory_of(order[k])
    if (1 in triads) {
      printf "\n### Against the bandwidth: %.0f bytes for each particle and step, %.0f bytes of data\n\n", bytes_of_step(), bytes_of_data()
      print "| length | ranks | data of a rank, MB | GB/s of a rank | triad with as much data, GB/s | share | speed over that of the shortest |"
      print "|---|---|---|---|---|---|---|"
      for (k = 1; k <= keys; k++) {
        if (table[k] != "lengths") continue
        r = ranks_of[k]
        if (!(r in shortest)) shortest[r] = cost(order[k])
        megabytes = atoms[order[k]] * bytes_of_data() / r * 1e-6
        speed = bytes_of_step() / cost(order[k]) / r
        printf "| %d | %d | %.1f | %.1f | %.1f | %.0f %% | %.2f |\n", length_of[k], r, megabytes, speed, bandwidth_of(r, megabytes),
               speed / bandwidth_of(r, megabytes) * 100, shortest[r] / cost(order[k])
      }
    }
  }

  if (has["scale"]) {
    print "\n### What ranks send each other, each step and rank (counted)\n"
    print "| length | ranks | particles of a rank, mean | largest over mean | ghosts | messages | bytes | collective calls that wait | that do not | PE beside 1 rank |"
    print "|---|---|---|---|---|---|---|---|---|---|"
    for (k = 1; k <= scales; k++) {
      if (scale[k, 2] == 1) base = scale[k, 10]
      printf "| %d | %d | %.0f | %.3f | %.0f | %.2f | %.0f | %.2f | %.2f | %.1e |\n", scale[k, 1], scale[k, 2], scale[k, 3] / scale[k, 2],
             scale[k, 4], scale[k, 5], scale[k, 6], scale[k, 7], scale[k, 8], scale[k, 9], scale[k, 10] / base - 1
      if (scale[k, 2] > 1) {
        if (scale[k, 7] > halo) halo = scale[k, 7]
        waits = scale[k, 8]
        s = (scale[k, 4] - 1) * sqrt(scale[k, 3] / scale[k, 2])    # excess over the mean, divided by its square root
        if (s > spread) spread = s
      }
    }
    print "\nOf the calls that wait 0.1 ask whether neighbour lists are out of date; every 100th step gathers PE and looks whether the run is sound."
  }

  if (has["scale"] && has["lengths"]) {
    latency = 1.5; bandwidth = 10
    print "\n### Predicted, not measured\n"
    printf "Latency %g us, %g GB/s, %.0f bytes a step to two neighbours, %.2f collective calls that wait (2 log2(ranks) latencies each), one that does not but is needed after the integration, a quarter of the arithmetic; largest share mean + %.2f sqrt(mean), cost of a particle that of one rank with as many in the table above.\n\n",
           latency, bandwidth, halo, waits, spread
    line = "| ranks |"; under = "|---|"
    n = split("1890 3780 7560 15120", size_at, " ")
    for (i = 1; i <= n; i++) { line = line " length " size_at[i] ", us a step | million particle-steps/s | efficiency |"; under = under "---|---|---|" }
    print line; print under
    for (ranks = 1; ranks <= 512; ranks *= 2) {
      if (ranks > 1 && ranks < 8) continue
      printf "| %d |", ranks
      for (i = 1; i <= n; i++) {
        particles = 63.15 * size_at[i]
        t = step_time(particles, ranks, halo, waits, spread)
        one = step_time(particles, 1, 0, 0, 0)
        printf " %.1f | %.0f | %.0f %% |", t, particles / t, one / t / ranks * 100
      }
      print ""
    }
  }

  if (has["setup"]) {
    print "\n### Set-up, seconds\n"
    print "| ranks | create_lsm_fault | first step | write_restart | read_restart |"
    print "|---|---|---|---|---|"
    for (r = 1; r <= most; r++)
      printf "| %d | %.2f | %.2f | %.2f | %.2f |\n", r, median(setup[r, 3]), median(setup[r, 4]), median(setup[r, 6]), median(setup[r, 5])
  }

  if (commands) {
    printf "\n### postproc on a catalogue of %g events\n\n", events
    print "| command | seconds | memory, MB |"
    print "|---|---|---|"
    for (i = 1; i <= commands; i++) printf "| %s | %.1f | %.0f |\n", command[i], median(analysis[command[i]]), median(kilobytes[command[i]]) / 1024
  }
}
