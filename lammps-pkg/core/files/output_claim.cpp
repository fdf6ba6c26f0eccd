// SPDX-License-Identifier: GPL-2.0-or-later
#include "files/output_claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>
#include <unordered_map>

#include "files/file_error.h"
#include "files/parameters.h"
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

LockHolder this_process() {
  LockHolder me;
  std::array<char, HOST_NAME_MAX + 1> name{};
  gethostname(name.data(), name.size() - 1);
  me.host = name.data();
  me.process = getpid();
  std::array<char, 32> now{};
  const std::time_t seconds = std::time(nullptr);
  std::tm parts{};
  std::strftime(now.data(), now.size(), "%Y-%m-%d %H:%M:%S", localtime_r(&seconds, &parts));
  me.started = now.data();
  return me;
}

constexpr std::string_view magic = "# lsm-lock 1\n";

std::string to_text(const LockHolder &holder) {
  return std::string(magic) + text_io::lines_of({{"host", holder.host},
                                                 {"process", std::to_string(holder.process)},
                                                 {"started", holder.started}});
}

/// Returns false if the text was not made by to_text().
bool from_text(const std::string &text, LockHolder &holder) {
  if (text.compare(0, magic.size(), magic) != 0) return false;
  text_io::ParameterList all;
  all.add_lines(std::string_view(text).substr(magic.size()));
  const auto read = [&all](const char *key, auto &value) { text_io::take(all.all(), key, value); };
  read("host", holder.host);
  read("started", holder.started);
  read("process", holder.process);
  return holder.process > 0;
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
    if (!text_io::parse(entry.path().filename().string(), descriptor)) continue;
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
    if (extension == ".lock" || extension == ".new")
      return one.what + " " + one.path + ": names that end in " + extension +
             " are reserved for temporary files; give another one";
    const std::string identity = file_identity(one.path);
    if (identity.empty()) continue;
    const auto [same, added] = before.emplace(identity, &one);
    if (!added)
      return same->second->what + " " + same->second->path + " and " + one.what + " " + one.path +
             " are the same file; give each a name of its own";
  }
  return {};
}

FileLock::~FileLock() {
  if (descriptor_ < 0) return;
  if (is_there()) unlink(lock_.c_str());
  close(descriptor_);
}

FileLock::FileLock(const std::string &path, Flock flock)
    : path_(path), lock_(target_of(path).string() + ".lock") {
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    bool ours = true;  // the file was not there
    descriptor_ = open_lock(O_CREAT | O_EXCL);
    if (descriptor_ < 0 && errno == EEXIST) {
      ours = false;
      descriptor_ = open_lock(0);
      if (descriptor_ < 0 && errno == ENOENT) continue;  // removed in between
    }
    if (descriptor_ < 0) fail("cannot open for writing", errno);
    const bool locked = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    const int reason = errno;
    if (!locked && reason == EWOULDBLOCK) refuse(holder());
    if (!locked) {
      if (ours) unlink(lock_.c_str());
      fail("its file system has no locks (flock); write to another one: cannot lock", reason);
    }
    // Its owner may have removed it in between. A file of that name that is not a lock belongs to
    // somebody else and must be left alone, which holder() does.
    if (is_there()) {
      if (!ours) holder();
      sign();
      return;
    }
    drop();
  }
  fail("cannot lock", EAGAIN);
}

int FileLock::open_lock(int flags) const {
  return open(lock_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0666);
}

void FileLock::stop(const std::string &message) {
  if (descriptor_ >= 0) drop();
  throw FileError(path_ + ": " + message);
}

void FileLock::fail(const std::string &what, int reason) {
  stop(what + ": its lock file " + lock_ + ": " + std::generic_category().message(reason));
}

void FileLock::drop() { close(std::exchange(descriptor_, -1)); }

bool FileLock::is_there() const { return leads_to(lock_, descriptor_); }

std::optional<LockHolder> FileLock::holder() {
  std::array<char, 1024> text{};
  ssize_t length = 0;
  for (int attempt = 0; attempt <= 20; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    length = pread(descriptor_, text.data(), text.size(), 0);
    if (length != 0) break;
  }
  if (length <= 0) return {};
  LockHolder found;
  if (from_text({text.data(), static_cast<std::size_t>(length)}, found)) return found;
  stop("its lock file " + lock_ + " holds something else; move it away");
}

void FileLock::sign() {
  const std::string text = to_text(this_process());
  if (ftruncate(descriptor_, 0) == 0 &&
      pwrite(descriptor_, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()))
    return;
  const int reason = errno;
  unlink(lock_.c_str());
  fail("cannot write", reason);
}

void FileLock::refuse(const std::optional<LockHolder> &by) {
  if (by && by->process == getpid() && by->host == this_process().host)
    stop("is being written by this run already; give each output a name of its own");
  const std::string who =
      by ? ": process " + std::to_string(by->process) + " on " + by->host + " since " + by->started
         : "";
  stop("is being written by another run" + who + "; wait for its end");
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
