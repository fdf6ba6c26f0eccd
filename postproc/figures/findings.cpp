// SPDX-License-Identifier: GPL-2.0-or-later
#include "findings.h"

#include <nlohmann/json.hpp>

namespace LSM::postproc {

void Findings::numbers(const std::string &name, const nlohmann::ordered_json &value) {
  all_.push_back({name, std::make_shared<const nlohmann::ordered_json>(value), {}});
}
void Findings::numbers(const std::string &name, const Table &table) { numbers(name, table.json()); }

}  // namespace LSM::postproc
