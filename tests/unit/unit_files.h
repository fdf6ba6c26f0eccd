// SPDX-License-Identifier: GPL-2.0-or-later
// Files and locales for the unit tests.
#ifndef LSM_UNIT_FILES_H
#define LSM_UNIT_FILES_H

#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <string>

namespace unit {

/// A separate folder for each test, which exists before the members of the fixture are constructed
/// and is removed afterwards.
class Files : public ::testing::Test {
 protected:
  Files() {
    std::string name = (std::filesystem::temp_directory_path() / "lsm-unit-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) folder_ = name;
  }
  void SetUp() override { ASSERT_FALSE(folder_.empty()) << "no temporary folder"; }
  void TearDown() override {
    std::error_code code;
    std::filesystem::remove_all(folder_, code);
  }
  std::string path(const std::string &name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

inline std::string slurp(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void spill(const std::string &path, const std::string &text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Continues a file as a run does that is restarted after this step, for a catalogue this event.
/// \return number of rows kept
template <class Writer, class Info>
std::int64_t resume(Writer &writer, const std::string &path, const Info &info, std::int64_t last) {
  writer.find_cut(path, info, last);
  writer.cut();
  return writer.rows();
}

/// Message of the exception of type Error thrown by call; fails the test if there is none.
template <class Error, class Call>
std::string message_of(Call &&call) {
  try {
    call();
  } catch (const Error &error) {
    return error.what();
  } catch (const std::exception &error) {
    ADD_FAILURE() << "another exception: " << error.what();
    return {};
  }
  ADD_FAILURE() << "no exception";
  return {};
}

inline ::testing::AssertionResult contains(const std::string &text, const std::string &part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << part << "' is not in: " << text;
}

/// Expects that the call throws an Error with this part in its message.
template <class Error, class Call>
void expect_error(Call &&call, const std::string &part) {
  EXPECT_TRUE(contains(message_of<Error>(call), part));
}

/// A locale with decimal comma and digit grouping, as in many languages.
class CommaFacet : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Makes such a locale the global one for the lifetime of the object, and that of C as well if one
/// of this kind is installed.
class CommaLocale {
 public:
  CommaLocale()
      : before_(std::locale::global(std::locale(std::locale::classic(), new CommaFacet))),
        c_before_(std::setlocale(LC_ALL, nullptr)) {
    for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8"})
      if (std::setlocale(LC_ALL, name)) break;
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, c_before_.c_str());
  }
  CommaLocale(const CommaLocale &) = delete;
  CommaLocale &operator=(const CommaLocale &) = delete;

 private:
  std::locale before_;
  std::string c_before_;
};

}  // namespace unit

#endif
