// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef LSM_TEXT_BYTES_H
#define LSM_TEXT_BYTES_H

#include <string>
#include <utility>

#include "files/input_bytes.h"

namespace unit {

/// The bytes of a text, as if they were those of a file.
class TextBytes : public LSM::files::Bytes {
 public:
  TextBytes(std::string text, const std::string &path) : Bytes(path), text_(std::move(text)) {}
  std::int64_t size() const override { return static_cast<std::int64_t>(text_.size()); }

 private:
  std::size_t more(char *to, std::size_t most) override {
    const std::size_t count = text_.copy(to, most, at_);
    at_ += count;
    return count;
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace unit

#endif
