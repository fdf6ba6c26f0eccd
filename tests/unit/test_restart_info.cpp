// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "files/file_error.h"
#include "files/checksum.h"
#include "files/restart_info.h"
#include "unit_files.h"

namespace {

namespace fs = std::filesystem;
using LSM::check_restart;
using LSM::FileError;
using LSM::seal_restart;
using unit::contains;
using unit::message_of;
using unit::slurp;
using unit::spill;

class RestartInfo : public unit::Files {
 protected:
  void SetUp() override {
    unit::Files::SetUp();
    for (int n = 0; n < 5000; ++n) bytes += static_cast<char>(n * n % 251);
    spill(path("draft"), bytes);
    seal_restart(path("draft"), file, settings);
  }
  std::string refusal() {
    return message_of<FileError>([&] { check_restart(file); });
  }

  std::string bytes;
  const std::string file = path("r.500"), info = file + ".info";
  const LSM::files::Parameters settings = {{"step", "500"}, {"leaping", ""}, {"law", "a b = c"}};
};

TEST(Checksum, KnownSums) {
  // printf 123456789 | gzip | tail -c 8 | od -An -tu4
  EXPECT_EQ(LSM::crc32(""), 0U);
  EXPECT_EQ(LSM::crc32("6789", LSM::crc32("12345")), 3421780262U);
}

TEST_F(RestartInfo, SettingsComeBack) {
  EXPECT_EQ(check_restart(file), settings);
  EXPECT_EQ(slurp(file), bytes);
  EXPECT_FALSE(fs::exists(path("draft")));
  EXPECT_FALSE(fs::exists(info + ".new"));
}

TEST_F(RestartInfo, EveryBitCounts) {
  for (std::size_t at : {std::size_t{0}, bytes.size() / 2, bytes.size() - 1})
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ (1 << bit));
      spill(file, other);
      EXPECT_EQ(refusal(), file + ": is damaged, its checksum is not that in " + info +
                               "; use an earlier restart file");
    }
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, bytes.size() - 1}) {
    spill(file, bytes.substr(0, length));
    EXPECT_TRUE(contains(refusal(), "it has " + std::to_string(length) + " bytes, expected 5000"));
  }
  spill(file, bytes);
  EXPECT_EQ(check_restart(file), settings);
}

TEST_F(RestartInfo, TheSettingsAreCheckedAsWell) {
  const std::string text = slurp(info);
  for (std::size_t at = 0; at < text.size(); ++at) {
    std::string other = text;
    other[at] = static_cast<char>(other[at] ^ 1);
    spill(info, other);
    try {
      // Only the name at the end, which is meant for people, may differ.
      EXPECT_EQ(check_restart(file), settings);
      EXPECT_GT(at, text.rfind(' ')) << "place " << at << " of\n" << text;
    } catch (const FileError &) {
    }
  }
  for (std::size_t length = 0; length < text.rfind(' '); ++length) {
    spill(info, text.substr(0, length));
    EXPECT_THROW(check_restart(file), FileError) << length;
  }
}

TEST_F(RestartInfo, FilesThatAreMissing) {
  fs::remove(info);
  EXPECT_EQ(refusal(), file + ": its checksum file " + info +
                           " is missing, so it may be incomplete; use an earlier restart file");
  fs::remove(file);
  EXPECT_TRUE(contains(refusal(), file + ": cannot open: No such file"));
}

// A file that has an info file is complete, whatever was interrupted.
TEST_F(RestartInfo, OlderFileOfTheNameIsReplaced) {
  spill(path("draft"), "newer");
  fs::create_directory(info + ".new");  // the info cannot be written
  EXPECT_THROW(seal_restart(path("draft"), file, settings), FileError);
  EXPECT_TRUE(contains(refusal(), "is missing"));
  fs::remove(info + ".new");
  spill(path("draft"), "newest");
  seal_restart(path("draft"), file, settings);
  EXPECT_EQ(check_restart(file), settings);
  EXPECT_EQ(slurp(file), "newest");
}

}  // namespace
