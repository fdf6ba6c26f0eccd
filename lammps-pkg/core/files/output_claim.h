// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/output_claim.h
/// The files that a run is about to write: no two of them may be one file, whatever its names, and
/// no other run may write them at the same time. (Ours.)
///
/// A run holds FILE.lock for as long as it writes FILE: locked by flock, so that a killed run
/// releases it, and with host and process for the message of the next run. File systems without
/// flock are refused.
#ifndef LSM_OUTPUT_CLAIM_H
#define LSM_OUTPUT_CLAIM_H

#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace LSM {

/// A file that a run will write; what: the option or keyword that names it, for messages.
struct Output {
  std::string what;
  std::string path;
};

/// The process that holds a lock, as its file says.
struct LockHolder {
  std::string host, started;
  std::int64_t process = 0;
};

/// The same text for two paths that lead to one file: "./a" and "a", hard and symbolic links, even
/// for files that do not exist yet. "" for devices such as /dev/null, which any number may write.
std::string file_identity(const std::string &path);

/// Whether this process already has a file open for writing, under any name: a log, a file of
/// another part of the program.
bool is_open_for_writing(const std::string &path);

/// What is wrong with the names of a run's outputs, or "". Empty paths are skipped.
std::string bad_outputs(const std::vector<Output> &outputs);

/// Holds the lock of one file, or of none.
class FileLock {
 public:
  using Flock = int (*)(int, int);

  FileLock() = default;
  FileLock(const FileLock &) = delete;
  FileLock &operator=(const FileLock &) = delete;
  ~FileLock();

  /// \throws FileError if another run holds it, which it names, or if the lock cannot be written.
  /// flock: another one than the system's, for tests.
  explicit FileLock(const std::string &path, Flock flock = ::flock);

 private:
  static constexpr int most_attempts = 100;

  int open_lock(int flags) const;
  void drop();
  [[noreturn]] void stop(const std::string &message);
  [[noreturn]] void fail(const std::string &what, int reason);

  /// Whether the name still leads to the open file.
  bool is_there() const;

  /// Who signed the file; a process that has just made it is given time to do so.
  std::optional<LockHolder> holder();

  void sign();
  [[noreturn]] void refuse(const std::optional<LockHolder> &by);

  int descriptor_ = -1;
  std::string path_, lock_;
};

/// Locks of the outputs of a run, from before the first is written until the last is closed.
using OutputClaim = std::list<FileLock>;

/// Empty paths are skipped; devices and pipes need no lock. others: files that something else
/// writes, which are compared but not locked.
/// \throws FileError before anything is written: two outputs are one file, another run writes one
OutputClaim claim_outputs(const std::vector<Output> &outputs,
                          const std::vector<Output> &others = {});

}  // namespace LSM

#endif
