// SPDX-License-Identifier: GPL-2.0-or-later
// Links in the order in which lsm_link_kernel processes them

#ifndef LMP_LSM_LINK_ROWS_H
#define LMP_LSM_LINK_ROWS_H

#include <limits>
#include <vector>

namespace LAMMPS_NS {
namespace LSMLinkRows {

  constexpr int LANES = 4;        ///< rows of a slice, processed side by side
  constexpr int LONGEST = 4;      ///< links of a row; a particle with more has several rows
  constexpr int WINDOW = 1024;    ///< particles whose rows are sorted by length
  constexpr double NO_LINK =
      std::numeric_limits<double>::infinity();    ///< rest length of a place in a slice that only
                                                  ///< fills it up

  struct Link {
    int i, j;       ///< local indices; the row is one of i, unless j is owned and has fewer links
                    ///< (not if regular slices are looked for)
    double rest;    ///< rest length
  };

  /// Slices of rows of the same length.
  struct Stack {
    int slices, length;
    bool filled_up;          ///< some places hold no link
    bool regular;            ///< in each slice particles lie one after the other, and so do the
                             ///< first partners, the second, ...: only the first place is stored
    int row, link;           ///< where it begins in Rows::particle, and in Rows::other
    int rest;                ///< where it begins in Rows::rest
    int rest_step;           ///< LANES, or 0 if all of its links have the rest length there
    int fetch, fetch_end;    ///< what to fetch meanwhile, in Rows::to_fetch
  };

  struct Found {
    int i, j;    ///< local indices
    int rest;    ///< place in Rows::rest; NO_LINK there if the place is not a link
  };

  /// Links of one kind. Places are `stride` times the local index of a particle.
  struct Rows {
    int stride;
    std::vector<Stack> stacks;
    std::vector<int> windows;     ///< first stack of each window, and the number of all
    std::vector<int> particle;    ///< place of the particle of each row, LANES for each slice, or
                                  ///< 1 if it is regular
    std::vector<int> other;       ///< place of its partner, LANES or 1 for each link of a slice
    std::vector<double> rest;     ///< rest length, or NO_LINK; LANES for all links of a stack, or
                                  ///< for each of a slice
    std::vector<int> to_fetch;    ///< places to fetch into the cache

    /// The n-th link of a stack: slice by slice, LANES first links, LANES second links, ...
    Found link(const Stack &, int n) const;
  };

  /// Arranges links in rows. Their order follows from those of `owned` and `links` alone, so both
  /// orders have to follow from the particle IDs.
  /// \param owned  local indices of the particles of this rank, each once
  /// \param links  the first end of each is owned; they are freed
  /// \param nlocal particles of this rank: those with local indices from this on are ghosts and
  /// have no rows
  /// \param nall   local indices are below this
  /// \param mixed  put rows of all lengths side by side, filled up to the longest: for few links
  /// \param share  keep the rest length of a stack once where all of its links have the same
  /// \param stride of places: numbers of a particle in the array that the kernel reads
  /// \param regular look for regular slices, by IDs, for lattices. Rows are those of the first end
  /// then. Places are stored one by one if the order in memory is another, which changes no digit
  Rows make_rows(const std::vector<int> &owned, std::vector<Link> links, int nlocal, int nall,
                 bool mixed, bool share, int stride, bool regular);

}    // namespace LSMLinkRows
}    // namespace LAMMPS_NS

#endif
