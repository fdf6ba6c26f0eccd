// SPDX-License-Identifier: GPL-2.0-or-later
/// \file header_keys.h
/// The keys that our programs themselves write into the headers of files. Scenes and users add
/// others, which are texts about the model.
#ifndef LSM_HEADER_KEYS_H
#define LSM_HEADER_KEYS_H

#include <string>
#include <string_view>
#include <vector>

namespace LSM {

struct HeaderKey {
  enum class Type { text, number, whole, yes_no, reading };
  /// Whether files of one run may have other values: no for what the model is, yes for what of it
  /// is recorded and how.
  enum class Of { model, recording };

  std::string_view key;
  Of of = Of::model;
  Type type = Type::text;
  /// Range of a number that programs use; `expected` names it in messages. Without it any finite
  /// number will do.
  double least = 0.0, below = 0.0;
  const char *expected = nullptr;
  /// Whether a run that continues may have another value. The old one stays in the file, unless its
  /// writer replaces the header (ResumableFile::cut_with_new_header).
  bool may_change = false;
};

const std::vector<HeaderKey> &header_keys();

/// The entry of a key, or nullptr. Numbered keys such as viscosity_2 have that of the first.
const HeaderKey *header_key(std::string_view key);

/// Returns what is wrong with the value of a parameter, or "". An invalid value is an error: with a
/// default in its place, results would silently be those of another run.
std::string bad_value(const std::string &key, const std::string &value);

}  // namespace LSM

#endif
