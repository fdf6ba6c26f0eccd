// SPDX-License-Identifier: GPL-2.0-or-later
/// \file slider_array.h
/// Arrays of the chain, divided into chunks of blocks.
#ifndef SLIDER_ARRAY_H
#define SLIDER_ARRAY_H

#include <cstddef>
#include <new>
#include <vector>

#include "numerics/huge_pages.h"

namespace Slider {

/// Blocks per chunk, the unit of the active set; lane l of chunk c is block 8 c + l.
constexpr int chunk_size = 8;

/// Rounds a number of blocks up to whole chunks.
constexpr std::size_t whole_chunks(std::size_t n) {
  return (n + chunk_size - 1) / chunk_size * chunk_size;
}

/// Memory aligned to cache lines, so that a chunk never straddles two. Long arrays ask for huge
/// pages: in a long chain with ordinary pages, every active chunk would lie on pages of its own,
/// one for each array, which are more than the TLB holds.
template <class T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U> &) {}
  static constexpr std::size_t line = 64, huge_page = std::size_t(1) << 21;
  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t(n * sizeof(T) < 2 * huge_page ? line : huge_page);
  }
  T *allocate(std::size_t n) {
    void *const p = ::operator new(n * sizeof(T), alignment(n));
    if (alignment(n) == std::align_val_t(huge_page)) LSM::ask_for_huge_pages(p, n * sizeof(T));
    return static_cast<T *>(p);
  }
  void deallocate(T *p, std::size_t n) { ::operator delete(p, alignment(n)); }
  bool operator==(const LineAllocator &) const { return true; }
  bool operator!=(const LineAllocator &) const { return false; }
};

using Array = std::vector<double, LineAllocator<double>>;

}  // namespace Slider

#endif
