// SPDX-License-Identifier: GPL-2.0-or-later
// Reads whole catalogues into memory.
#ifndef LSM_UNIT_READ_CATALOGUE_H
#define LSM_UNIT_READ_CATALOGUE_H

#include <cstdint>
#include <string>
#include <vector>

#include "files/catalogue.h"

namespace unit {

struct Catalogue {
  LSM::CatalogueInfo info;
  std::vector<LSM::Event> events;
  std::int64_t skipped = 0;   ///< number of bad lines (lenient reading)
  std::string first_problem;  ///< message of the first of them
};

inline Catalogue read_catalogue(const std::string &path, bool lenient = false) {
  LSM::CatalogueReader reader(LSM::files::open_plain(path), lenient);
  Catalogue catalogue;
  LSM::Event event;
  while (reader.next(event)) catalogue.events.push_back(event);
  catalogue.info = reader.info();
  catalogue.skipped = reader.skipped();
  catalogue.first_problem = reader.first_problem();
  return catalogue;
}

}  // namespace unit

#endif
