// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/output_claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "files/file_error.h"
#include "files/output_file.h"
#include "files/text.h"

namespace LSM {

namespace {

namespace fs = std::filesystem;

/// Follows links to the file that a path leads to, even if it does not exist yet.
fs::path target_of(const std::string &path) {
  constexpr int most_links = 40;  // as the system
  std::error_code code;
  fs::path at = path;
  for (int n = 0; n < most_links && fs::is_symlink(fs::symlink_status(at, code)); ++n) {
    const fs::path to = fs::read_symlink(at, code);
    if (code) break;
    at = to.is_absolute() ? to : at.parent_path() / to;
  }
  const fs::path folder = fs::weakly_canonical(fs::absolute(at, code).parent_path(), code);
  return folder / at.filename();
}

/// Whether a path leads to the file of an open descriptor.
bool leads_to(const std::string &path, int descriptor) {
  struct stat named {
  }, opened{};
  return stat(path.c_str(), &named) == 0 && fstat(descriptor, &opened) == 0 &&
         named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

}  // namespace

std::string file_identity(const std::string &path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return target_of(path).string();
  if (S_ISCHR(found.st_mode)) return {};
  return std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino);
}

bool is_open_for_writing(const std::string &path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return false;
  for (const auto &entry : std::filesystem::directory_iterator("/proc/self/fd", code)) {
    int descriptor = -1;
    if (!text::parse(entry.path().filename().string(), descriptor)) continue;
    const int mode = fcntl(descriptor, F_GETFL);
    if (mode >= 0 && (mode & O_ACCMODE) != O_RDONLY && leads_to(path, descriptor)) return true;
  }
  return false;
}

std::string bad_outputs(const std::vector<Output> &outputs) {
  std::unordered_map<std::string, const Output *> before;
  for (const Output &one : outputs) {
    if (one.path.empty()) continue;
    const std::string extension = std::filesystem::path(one.path).extension().string();
    if (extension == ".new")
      return one.what + " " + one.path +
             ": names that end in .new are reserved for temporary files; give another one";
    const std::string identity = file_identity(one.path);
    if (identity.empty()) continue;
    const auto [same, added] = before.emplace(identity, &one);
    if (!added)
      return same->second->what + " " + same->second->path + " and " + one.what + " " + one.path +
             " are the same file; give each a name of its own";
  }
  return {};
}

FileLock::FileLock(const std::string &path, Flock flock) : name_(target_of(path).string()) {
  const std::string draft = name_ + ".new";
  const auto fail = [&path](const char *what) {
    throw FileError(path + ": " + what + ": " + std::generic_category().message(errno));
  };
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
    std::string locked = name_;
    descriptor_ = open(locked.c_str(), flags);
    if (descriptor_ < 0 && errno == ENOENT) {
      locked = draft;
      descriptor_ = open(locked.c_str(), flags | O_CREAT, 0666);
    }
    if (descriptor_ < 0) throw FileError(files::why_not_opened(path, locked, errno));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      if (reason != EWOULDBLOCK) remove_draft();
      close(descriptor_);
      if (reason == EWOULDBLOCK)
        throw FileError(path + ": is being written by another run; wait for its end");
      errno = reason;
      fail("its file system has no locks (flock); write to another one: cannot lock");
    }
    // Whoever held the lock may have renamed or removed the file in between.
    if (leads_to(locked, descriptor_) && (locked == name_ || access(name_.c_str(), F_OK) != 0)) {
      const std::lock_guard<std::mutex> guard(held().mutex);
      held().locks.push_back(this);
      return;
    }
    close(descriptor_);
  }
  errno = EAGAIN;
  fail("cannot lock");
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  {
    const std::lock_guard<std::mutex> guard(held().mutex);
    held().locks.remove(this);
  }
  remove_draft();
  close(descriptor_);
}

void FileLock::remove_draft() const {
  const std::string draft = name_ + ".new";
  struct stat now {};
  if (fstat(descriptor_, &now) == 0 && now.st_size == 0 && leads_to(draft, descriptor_))
    unlink(draft.c_str());
}

FileLock::Held &FileLock::held() {
  static Held all;
  return all;
}

bool FileLock::rename(const std::string &from, const std::string &to) {
  const std::lock_guard<std::mutex> guard(held().mutex);
  const std::string name = target_of(to).string();
  const auto lock = std::find_if(held().locks.begin(), held().locks.end(),
                                 [&name](const FileLock *one) { return one->name_ == name; });
  const bool moves = lock != held().locks.end() && !leads_to(from, (*lock)->descriptor_);
  const int next = moves ? open(from.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW) : -1;
  const bool done = (!moves || (next >= 0 && ::flock(next, LOCK_EX) == 0)) &&
                    std::rename(from.c_str(), to.c_str()) == 0;
  const int reason = errno;
  const int old = done && moves ? std::exchange((*lock)->descriptor_, next) : next;
  if (old >= 0) close(old);
  errno = reason;
  return done;
}

OutputClaim claim_outputs(const std::vector<Output> &outputs, const std::vector<Output> &others) {
  std::vector<Output> all = outputs;
  all.insert(all.end(), others.begin(), others.end());
  const std::string problem = bad_outputs(all);
  if (!problem.empty()) throw FileError(problem);
  for (const Output &output : outputs)
    if (is_open_for_writing(output.path))
      throw FileError(output.what + " " + output.path +
                      ": this run writes that file already, as its log or by another command; "
                      "give each output a name of its own");
  OutputClaim locks;
  for (const Output &output : outputs) {
    std::error_code code;
    const auto status = std::filesystem::status(output.path, code);
    if (!output.path.empty() &&
        (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)))
      locks.emplace_back(output.path);
  }
  return locks;
}

}  // namespace LSM
