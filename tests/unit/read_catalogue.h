// SPDX-License-Identifier: GPL-2.0-or-later
// Reads whole catalogues into memory.
#ifndef LSM_UNIT_READ_CATALOGUE_H
#define LSM_UNIT_READ_CATALOGUE_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/catalogue.h"

namespace unit {

/// A catalogue of events of one kind; numbers without a column are 0.
template <class Kind>
struct Catalogue {
  LSM::CatalogueInfo info;
  std::vector<Kind> events;
  std::int64_t skipped = 0;   ///< number of bad lines (lenient reading)
  std::string first_problem;  ///< message of the first of them
};

template <class Kind = LSM::Event>
Catalogue<Kind> read_catalogue(const std::string &path, bool lenient = false) {
  LSM::CatalogueReader reader(LSM::files::open_plain(path), lenient);
  Catalogue<Kind> catalogue;
  catalogue.info = reader.info();
  LSM::EventRow row;
  while (reader.next(row)) {
    Kind event{row};
    for (const std::string_view column : catalogue.info.columns)
      if (double *const number = LSM::number_in(event, column))
        *number = catalogue.info.number(row, column);
    catalogue.events.push_back(event);
  }
  catalogue.skipped = reader.skipped();
  catalogue.first_problem = reader.first_problem();
  return catalogue;
}

}  // namespace unit

#endif
