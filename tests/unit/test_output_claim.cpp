// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "files/file_error.h"
#include "files/output_claim.h"
#include "files/output_file.h"
#include "unit_files.h"

namespace {

namespace fs = std::filesystem;
using LSM::bad_outputs;
using LSM::claim_outputs;
using LSM::file_identity;
using LSM::FileError;
using LSM::FileLock;
using LSM::OutputClaim;
using unit::contains;
using unit::expect_error;
using unit::message_of;
using unit::slurp;
using unit::spill;

int no_flock(int, int) {
  errno = ENOSYS;
  return -1;
}

class OutputClaims : public unit::Files {
 protected:
  void TearDown() override {
    if (child_ > 0) end_child();
    unit::Files::TearDown();
  }

  /// Starts another process that holds the lock of a file until it is killed.
  void hold(const std::string &name) {
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    child_ = fork();
    ASSERT_GE(child_, 0);
    if (child_ == 0) {
      const FileLock lock(path(name));
      const bool sent = write(ready[1], "!", 1) == 1;
      while (sent) pause();
      _exit(1);
    }
    char byte = 0;
    close(ready[1]);
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    close(ready[0]);
  }
  void end_child() {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = -1;
  }

  pid_t child_ = -1;
};

TEST_F(OutputClaims, OneFileUnderTwoNames) {
  fs::create_directory(path("sub"));
  spill(path("here.csv"), "x");
  fs::create_hard_link(path("here.csv"), path("hard.csv"));
  fs::create_symlink("here.csv", path("soft.csv"));
  fs::create_symlink("new.csv", path("dangling.csv"));
  fs::create_directory_symlink("sub", path("folder"));
  for (const auto &[one, other] :
       std::vector<std::pair<std::string, std::string>>{{"here.csv", "here.csv"},
                                                        {"here.csv", "./here.csv"},
                                                        {"here.csv", "sub/../here.csv"},
                                                        {"here.csv", "hard.csv"},
                                                        {"here.csv", "soft.csv"},
                                                        {"new.csv", "dangling.csv"},
                                                        {"new.csv", ".//new.csv"},
                                                        {"sub/new.csv", "folder/new.csv"},
                                                        {"none/new.csv", "sub/../none/new.csv"}}) {
    EXPECT_EQ(file_identity(path(one)), file_identity(path(other))) << one << " " << other;
    EXPECT_EQ(bad_outputs({{"--catalogue", path(one)}, {"--json", ""}, {"--pe", path(other)}}),
              "--catalogue " + path(one) + " and --pe " + path(other) +
                  " are the same file; give each a name of its own");
  }
  EXPECT_EQ(bad_outputs({{"a", path("here.csv")},
                         {"b", path("new.csv")},
                         {"c", path("sub/new.csv")},
                         {"d", path("sub/here.csv")}}),
            "");
}

TEST_F(OutputClaims, RelativeNamesAndDevices) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_NE(bad_outputs({{"a", "new.csv"}, {"b", path("new.csv")}}), "");
  EXPECT_NE(bad_outputs({{"a", "new.csv"}, {"b", "./new.csv"}}), "");
  fs::current_path(before);
  EXPECT_EQ(bad_outputs({{"a", "/dev/null"}, {"b", "/dev/null"}}), "");
}

TEST_F(OutputClaims, NamesOfFilesOnTheirWay) {
  EXPECT_TRUE(contains(bad_outputs({{"a", path("a.csv")}, {"b", path("a.csv.new")}}), "b "));
  EXPECT_TRUE(contains(bad_outputs({{"a", path("a.csv.new")}}), "names that end in .new"));
}

TEST_F(OutputClaims, NothingIsLeftOfALock) {
  spill(path("old.csv"), "x");
  {
    OutputClaim claim;
    claim = claim_outputs({{"a", path("a.csv")}, {"old", path("old.csv")}, {"c", ""}});
    EXPECT_FALSE(fs::exists(path("a.csv")));
    EXPECT_FALSE(fs::exists(path("old.csv.new")));
    EXPECT_EQ(slurp(path("old.csv")), "x");
  }
  fs::remove(path("old.csv"));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(OutputClaims, NothingIsHeldIfOneIsTaken) {
  OutputClaim first, second;
  first = claim_outputs({{"b", path("b.csv")}});
  const std::string message = message_of<FileError>([&] {
    second = claim_outputs({{"a", path("a.csv")}, {"b", path("b.csv")}});
  });
  EXPECT_EQ(message, path("b.csv") + ": is being written by another run; wait for its end");
  EXPECT_FALSE(fs::exists(path("a.csv.new")));
  first.clear();
  second = claim_outputs({{"a", path("a.csv")}, {"b", path("b.csv")}});
}

TEST_F(OutputClaims, AnotherRunIsNoticedWhicheverWayTheFileIsNamed) {
  fs::create_symlink("a.csv", path("link.csv"));
  for (const char *content : {"", "x"}) {
    if (content[0]) spill(path("a.csv"), content);
    hold("a.csv");
    for (const char *name : {"a.csv", "link.csv"})
      EXPECT_EQ(message_of<FileError>([&] { const FileLock lock(path(name)); }),
                path(name) + ": is being written by another run; wait for its end");
    end_child();
    { const FileLock lock(path("a.csv")); }
    EXPECT_FALSE(fs::exists(path("a.csv.new"))) << "left by the run that was killed";
  }
}

// The lock goes over to each file that takes the name, from the first to the last.
TEST_F(OutputClaims, FilesThatAreReplacedStayLocked) {
  const auto taken = [this](const char *when) {
    EXPECT_TRUE(contains(message_of<FileError>([&] { const FileLock lock(path("a.csv")); }),
                         "is being written by another run"))
        << when;
  };
  {
    OutputClaim claim;
    claim = claim_outputs({{"a", path("a.csv")}});
    taken("before there is a file");
    LSM::files::OutputFile file;
    file.create(path("a.csv"), "one\n");
    taken("while it is written");
    file.close();
    taken("after it was closed");
    for (const char *text : {"two\n", "three\n"}) {
      LSM::files::write_file(path("a.csv"), text, true);
      EXPECT_EQ(slurp(path("a.csv")), text);
      taken(text);
    }
    EXPECT_EQ(LSM::files::why_not_writable(path("a.csv")), "");
    taken("after a look whether it can be written");
  }
  { const FileLock lock(path("a.csv")); }
  EXPECT_EQ(slurp(path("a.csv")), "three\n");
}

TEST_F(OutputClaims, FileSystemsWithoutLocksAreRefused) {
  for (const char *content : {"", "x"}) {
    if (content[0]) spill(path("a.csv"), content);
    expect_error<FileError>([&] { FileLock(path("a.csv"), no_flock); },
                            path("a.csv") + ": its file system has no locks (flock)");
    EXPECT_FALSE(fs::exists(path("a.csv.new")));
  }
}

TEST_F(OutputClaims, ATemporaryFileThatIsALinkStays) {
  spill(path("victim"), "");
  fs::create_symlink("victim", path("a.csv.new"));
  expect_error<FileError>([&] { const FileLock lock(path("a.csv")); },
                          "its temporary file " + path("a.csv.new") + " is a symbolic link");
  EXPECT_TRUE(fs::exists(path("victim")));
}

TEST_F(OutputClaims, FilesThatAreOpenAlready) {
  std::ofstream log(path("log"));
  fs::create_hard_link(path("log"), path("a.csv"));
  OutputClaim claim;
  expect_error<FileError>(
      [&] {
        claim = claim_outputs({{"catalogue", path("a.csv")}});
      },
      "catalogue " + path("a.csv") + ": this run writes that file already");
  log.close();
  const std::ifstream reader(path("log"));
  claim = claim_outputs({{"catalogue", path("a.csv")}});
}

TEST_F(OutputClaims, FilesOfOthersAreComparedAndNotLocked) {
  OutputClaim claim;
  EXPECT_NE(
      message_of<FileError>([&] {
        claim = claim_outputs({{"catalogue", path("a.csv")}}, {{"emergency", path("./a.csv")}});
      }),
      "");
  claim = claim_outputs({{"catalogue", path("a.csv")}}, {{"emergency", path("b")}});
  EXPECT_FALSE(fs::exists(path("b")) || fs::exists(path("b.new")));
}

TEST_F(OutputClaims, FoldersThatCannotBeWritten) {
  expect_error<FileError>([&] { FileLock(path("none/a.csv")); },
                          path("none/a.csv") + ": cannot open for writing: No such file");
}

}  // namespace
