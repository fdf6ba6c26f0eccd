// SPDX-License-Identifier: GPL-2.0-or-later
/// \file numerics/huge_pages.h
/// Long arrays on huge pages, where the system has them.
#ifndef LSM_HUGE_PAGES_H
#define LSM_HUGE_PAGES_H

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>

namespace LSM {

/// Asks for huge pages for memory that has not been used yet: fewer entries of the TLB, and fewer
/// page faults when it is filled.
inline void ask_for_huge_pages([[maybe_unused]] const void *memory,
                               [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + page - 1) / page * page;
  const std::uintptr_t end = (address + bytes) / page * page;
  if (begin < end) madvise(reinterpret_cast<void *>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace LSM

#endif
