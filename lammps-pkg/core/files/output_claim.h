// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/output_claim.h
/// Checks and locks for the files that a run is about to write: no two outputs may lead to the same
/// file, under any names, and no other run may write them at the same time.
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

/// A file that a run will write. `what` is the option or keyword that names it, for messages.
struct Output {
  std::string what;
  std::string path;
};

/// The process that holds a lock, as its file says.
struct LockHolder {
  std::string host, started;
  std::int64_t process = 0;
};

/// Returns the same text for all paths that lead to one file, such as "./a", "a" and links to it,
/// even if the file does not exist yet. Returns "" for devices such as /dev/null, which any number
/// of outputs may share.
std::string file_identity(const std::string &path);

/// Whether this process already has a file open for writing, under any name, for example as its
/// log.
bool is_open_for_writing(const std::string &path);

/// Returns what is wrong with the names of a run's outputs, or "". Empty paths are skipped.
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
  /// Tests pass a substitute for the system's flock.
  explicit FileLock(const std::string &path, Flock flock = ::flock);

 private:
  static constexpr int most_attempts = 100;

  int open_lock(int flags) const;
  void drop();
  [[noreturn]] void stop(const std::string &message);
  [[noreturn]] void fail(const std::string &what, int reason);

  /// Whether the name still leads to the open file.
  bool is_there() const;

  /// Reads who holds the lock. A process that has just created the file is given time to sign it.
  std::optional<LockHolder> holder();

  void sign();
  [[noreturn]] void refuse(const std::optional<LockHolder> &by);

  int descriptor_ = -1;
  std::string path_, lock_;
};

/// Locks of the outputs of a run, from before the first is written until the last is closed.
using OutputClaim = std::list<FileLock>;

/// Locks the outputs of a run. Empty paths are skipped, and devices and pipes need no lock.
/// `others` are written by something else: they are compared with the outputs but not locked.
/// \throws FileError before anything is written: two outputs are one file, another run writes one
OutputClaim claim_outputs(const std::vector<Output> &outputs,
                          const std::vector<Output> &others = {});

}  // namespace LSM

#endif
