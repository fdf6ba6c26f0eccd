// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/output_claim.h
/// Checks and locks for the files that a run is about to write: no two outputs may lead to the same
/// file, under any names, and no other run may write them at the same time.
///
/// A run holds a lock (flock) on each of its files for as long as it writes them, which ends with
/// the process even if that is killed. File systems without flock are refused.
#ifndef LSM_OUTPUT_CLAIM_H
#define LSM_OUTPUT_CLAIM_H

#include <sys/file.h>
#include <unistd.h>

#include <list>
#include <mutex>
#include <string>
#include <vector>

namespace LSM {

/// A file that a run will write. `what` is the option or keyword that names it, for messages.
struct Output {
  std::string what;
  std::string path;
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

/// Holds the lock of one file, or of none. As long as the file does not exist, this is the lock of
/// FILE.new, as which it begins (see OutputFile).
class FileLock {
 public:
  using Flock = int (*)(int, int);

  FileLock() = default;
  FileLock(const FileLock &) = delete;
  FileLock &operator=(const FileLock &) = delete;
  ~FileLock();

  /// \throws FileError if another run holds it, or if the file cannot be written or locked. Tests
  /// pass a substitute for the system's flock.
  explicit FileLock(const std::string &path, Flock flock = ::flock);

  /// Renames a file. If this process holds the lock of the file that is replaced, it holds that of
  /// the new one from then on, without a gap. Returns false and sets errno on failure.
  static bool rename(const std::string &from, const std::string &to);

 private:
  static constexpr int most_attempts = 100;
  struct Held {
    std::mutex mutex;
    std::list<FileLock *> locks;
  };
  static Held &held();  // by this process

  void remove_draft() const;

  int descriptor_ = -1;
  std::string name_;  // with links resolved
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
