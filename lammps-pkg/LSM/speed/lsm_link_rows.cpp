// SPDX-License-Identifier: GPL-2.0-or-later

#include "lsm_link_rows.h"

#include <algorithm>
#include <array>

namespace LAMMPS_NS {
namespace LSMLinkRows {

  static constexpr int LINE = 8;    // doubles of a cache line

  struct Row {
    int i, first, length;    // links of i from the first on
  };

  // Links by the particle whose rows they are in.
  struct Owners {
    std::vector<int> begin;    // of the links of each particle, and the end of the last
    std::vector<int> other;
    std::vector<double> rest;
    std::vector<int> rank;    // of owned particles by ID, if regular slices are looked for

    Owners(const std::vector<Link> &links, int nlocal, bool balanced);
  };

  // Number of rows of a particle with so many links.
  static int pieces_of(int links)
  {
    return (links + LONGEST - 1) / LONGEST;
  }

  // Place of the k-th of n links, dealt to the rows like cards. Neighbors in a lattice that follow
  // on each other by ID are partners in different rows, so that successive stores do not overlap:
  // a load that overlaps with two stores has to wait for both.
  static int dealt(int k, int n)
  {
    const int pieces = pieces_of(n), piece = k % pieces;
    return piece * (n / pieces) + std::min(piece, n % pieces) + k / pieces;
  }

  Owners::Owners(const std::vector<Link> &links, int nlocal, bool balanced) :
      begin(nlocal + 1, 0), other(links.size()), rest(links.size())
  {
    std::vector<bool> swapped(links.size());
    std::vector<int> count(nlocal, 0);
    for (std::size_t n = 0; n < links.size(); n++) {
      const Link &link = links[n];
      swapped[n] = balanced && link.j < nlocal && count[link.j] < count[link.i];
      count[swapped[n] ? link.j : link.i]++;
    }
    for (int i = 0; i < nlocal; i++) begin[i + 1] = begin[i] + count[i];
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (std::size_t n = 0; n < links.size(); n++) {
      const Link &link = links[n];
      const int i = swapped[n] ? link.j : link.i, k = next[i]++ - begin[i];
      const int place = begin[i] + (balanced ? k : dealt(k, count[i]));
      other[place] = swapped[n] ? link.i : link.j;
      rest[place] = link.rest;
    }
  }

  // Whether LANES numbers follow on each other.
  template <class Number> static bool are_consecutive(const Number &number)
  {
    for (int c = 1; c < LANES; c++)
      if (number(c) != number(0) + c) return false;
    return true;
  }

  // Whether LANES rows are those of particles in order, and their partners, too, where `number`
  // is that of a particle.
  template <class Number>
  static bool are_regular(const Owners &of, const Row *rows, int length, const Number &number)
  {
    bool regular = are_consecutive([&](int c) {
      return number(rows[c].i);
    });
    for (int n = 0; n < length && regular; n++)
      regular = are_consecutive([&](int c) {
        return number(of.other[rows[c].first + n]);
      });
    return regular;
  }

  // Takes rows that are regular by ID out of those of a length. Rows of particles with several are
  // sorted first: all first ones, all second ones, ...
  static std::vector<Row> take_regular(const Owners &of, std::vector<Row> &rows, int length)
  {
    std::stable_sort(rows.begin(), rows.end(), [&](const Row &a, const Row &b) {
      return a.first - of.begin[a.i] < b.first - of.begin[b.i];
    });
    std::vector<Row> taken, kept;
    for (std::size_t n = 0; n < rows.size();)
      if (n + LANES <= rows.size() && are_regular(of, &rows[n], length, [&](int i) {
            return i < static_cast<int>(of.rank.size()) ? of.rank[i] : -LANES;
          })) {
        taken.insert(taken.end(), &rows[n], &rows[n] + LANES);
        n += LANES;
      } else
        kept.push_back(rows[n++]);
    rows.swap(kept);
    return taken;
  }

  static void add_stack(Rows &o, const Owners &of, std::vector<Row> &rows, int length,
                        bool filled_up, bool share)
  {
    if (rows.empty()) return;
    const double first = of.rest[rows[0].first];
    const bool once =
        share && !filled_up && std::all_of(rows.begin(), rows.end(), [&](const Row &r) {
          return std::all_of(&of.rest[r.first], &of.rest[r.first] + r.length, [first](double rest) {
            return rest == first;
          });
        });
    while (rows.size() % LANES) rows.push_back({rows.back().i, rows.back().first, 0});
    bool regular = !of.rank.empty() && !filled_up;
    for (std::size_t slice = 0; slice < rows.size() && regular; slice += LANES)
      regular = are_regular(of, &rows[slice], length, [](int i) {
        return i;
      });
    const int stored = regular ? 1 : LANES;
    o.stacks.push_back({static_cast<int>(rows.size()) / LANES, length, filled_up, regular,
                        static_cast<int>(o.particle.size()), static_cast<int>(o.other.size()),
                        static_cast<int>(o.rest.size()), once ? 0 : LANES, 0, 0});
    if (once) o.rest.insert(o.rest.end(), LANES, first);
    for (std::size_t slice = 0; slice < rows.size(); slice += LANES) {
      for (int c = 0; c < stored; c++) o.particle.push_back(o.stride * rows[slice + c].i);
      for (int n = 0; n < length; n++)
        for (int c = 0; c < LANES; c++) {
          const Row &row = rows[slice + c];
          const bool is_link = n < row.length;
          const int link = row.first + (is_link ? n : 0);
          if (c < stored) o.other.push_back(o.stride * of.other[link]);
          if (!once) o.rest.push_back(is_link ? of.rest[link] : NO_LINK);
        }
    }
  }

  // Adds the rows of the particles of a window, the longest first. Rows left over that do not fill
  // a slice form one of mixed lengths.
  static void add_window(Rows &o, const Owners &of, const int *first, const int *last, bool mixed,
                         bool share)
  {
    std::array<std::vector<Row>, LONGEST + 1> rows;
    for (; first < last; first++) {
      const int i = *first, count = of.begin[i + 1] - of.begin[i];
      const int pieces = pieces_of(count);
      for (int p = 0, done = 0; p < pieces; p++) {
        const int length = (count - done + pieces - p - 1) / (pieces - p);
        rows[length].push_back({i, of.begin[i] + done, length});
        done += length;
      }
    }
    std::vector<Row> left;
    for (int length = LONGEST; length > 0; length--) {
      std::vector<Row> &full = rows[length];
      if (!of.rank.empty() && !mixed) {
        std::vector<Row> regular = take_regular(of, full, length);
        add_stack(o, of, regular, length, false, share);
      }
      const auto end = mixed ? full.begin() : full.end() - full.size() % LANES;
      left.insert(left.end(), end, full.end());
      full.erase(end, full.end());
      add_stack(o, of, full, length, false, share);
    }
    add_stack(o, of, left, LONGEST, true, share);
  }

  // Lists the cache lines used by the stacks from `first` on and not by those of the previous
  // window. They are prefetched evenly during the previous window, as waiting for each when it is
  // needed would take longer than the arithmetic.
  static void fetch_ahead(Rows &o, std::size_t before, std::size_t first, std::vector<int> &used,
                          int window)
  {
    const std::size_t begin = o.to_fetch.size();
    const auto use = [&](const std::vector<int> &places, int from) {
      for (std::size_t n = from; n < places.size(); n++) {
        int &last = used[places[n] / LINE];
        if (last < window - 1 && before < first) o.to_fetch.push_back(places[n]);
        last = window;
      }
    };
    if (first == o.stacks.size()) return;
    use(o.particle, o.stacks[first].row);
    use(o.other, o.stacks[first].link);

    double slices = 0.0, done = 0.0;
    for (std::size_t r = before; r < first; r++) slices += o.stacks[r].slices;
    const auto share = [&] {
      return static_cast<int>(begin + (o.to_fetch.size() - begin) * done / slices);
    };
    for (std::size_t r = before; r < first; r++) {
      o.stacks[r].fetch = share();
      done += o.stacks[r].slices;
      o.stacks[r].fetch_end = share();
    }
  }

  Rows make_rows(const std::vector<int> &owned, std::vector<Link> links, int nlocal, int nall,
                 bool mixed, bool share, int stride, bool regular)
  {
    Owners of(links, nlocal, !regular);
    if (regular) {
      of.rank.resize(nlocal);
      for (int n = 0; n < static_cast<int>(owned.size()); n++) of.rank[owned[n]] = n;
    }
    Rows o;
    o.stride = stride;
    o.other.reserve(links.size() + links.size() / 16);
    std::vector<Link>().swap(links);
    std::vector<int> used(static_cast<std::size_t>(stride) * nall / LINE + 1, -2);
    std::size_t before = 0;    // where the stacks of the window before begin
    const int n = static_cast<int>(owned.size());
    for (int from = 0, window = 0; from < n; from += WINDOW, window++) {
      const std::size_t first = o.stacks.size();
      o.windows.push_back(static_cast<int>(first));
      add_window(o, of, &owned[from], &owned[0] + std::min(n, from + WINDOW), mixed, share);
      fetch_ahead(o, before, first, used, window);
      before = first;
    }
    o.windows.push_back(static_cast<int>(o.stacks.size()));
    for (auto *all : {&o.particle, &o.other, &o.to_fetch}) all->shrink_to_fit();
    o.rest.shrink_to_fit();
    return o;
  }

  Found Rows::link(const Stack &s, int n) const
  {
    const int lane = n % LANES, slice = n / (s.length * LANES);
    const int stored = s.regular ? 1 : LANES, apart = s.regular ? lane : 0;
    const auto at = [&](const std::vector<int> &places, int first) {
      return places[first + (s.regular ? 0 : lane)] / stride + apart;
    };
    return {at(particle, s.row + slice * stored), at(other, s.link + n / LANES * stored),
            s.rest + (s.rest_step ? n : 0)};
  }

}    // namespace LSMLinkRows
}    // namespace LAMMPS_NS
