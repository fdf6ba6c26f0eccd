// SPDX-License-Identifier: GPL-2.0-or-later
/// \file files/text_io.h
/// Shared by catalogue and PE series files: numbers that do not depend on the locale, "# key =
/// value" headers, input that may be compressed, and output files that never lose what was written
/// before.
#ifndef LSM_TEXT_IO_H
#define LSM_TEXT_IO_H

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace LSM {

/// Unreadable or unwritable file. The message is one line and names the file.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace text_io {

using Parameters = std::vector<std::pair<std::string, std::string>>;

/// 17 significant digits, so that reading gives the same double back.
template <class T>
void append(std::string &out, T value) {
  char buffer[64], *const end = buffer + sizeof(buffer);
  if constexpr (std::is_floating_point_v<T>)
    out.append(buffer, std::to_chars(buffer, end, value, std::chars_format::general, 17).ptr);
  else
    out.append(buffer, std::to_chars(buffer, end, value).ptr);
}

template <class T>
std::string number(T value) {
  std::string out;
  append(out, value);
  return out;
}

/// All of text has to be one number; no blanks, no locale. Infinities and NaN are refused.
template <class T>
bool parse(std::string_view text, T &value) {
  T result{};
  const char *const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, result);
  if (parsed.ec != std::errc() || parsed.ptr != end) return false;
  if constexpr (std::is_floating_point_v<T>)
    if (!std::isfinite(result)) return false;
  value = result;
  return true;
}

inline std::string_view trim(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Splits at commas; n commas make n + 1 fields. Views into line.
inline void split(std::string_view line, std::vector<std::string_view> &fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

/// Field of a bad line for an error message: quoted, not too long, printable.
inline std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (char c : text.substr(0, longest)) {
    const bool printable = static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
    out += printable ? c : '?';
  }
  if (text.size() > longest) out += "...";
  return out + "'";
}

inline std::string where(const std::string &path, std::int64_t line) {
  return path + ":" + std::to_string(line) + ": ";
}

inline const std::string *find(const Parameters &parameters, std::string_view key) {
  for (const auto &parameter : parameters)
    if (parameter.first == key) return &parameter.second;
  return nullptr;
}

inline Parameters without(Parameters all, std::initializer_list<std::string_view> keys) {
  const auto unwanted = [&keys](const auto &parameter) {
    return std::find(keys.begin(), keys.end(), parameter.first) != keys.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), unwanted), all.end());
  return all;
}

/// What the headers of all our files hold.
struct FileHeader {
  std::string model;      ///< "lsm" or "block-slider"
  Parameters parameters;  ///< the other ones, in the order of the file

  /// Value of one of the other parameters, or nullptr.
  const std::string *find(std::string_view key) const { return text_io::find(parameters, key); }
};

/// Takes the value of a parameter that has to be there; returns what is wrong, or "".
template <class Value>
std::string take(const Parameters &parameters, const std::string &key, Value &value) {
  const std::string *text = find(parameters, key);
  if (!text)
    return "parameter '" + key + "' is missing in the header, expected '# " + key + " = value'";
  if constexpr (std::is_same_v<Value, std::string>)
    value = *text;
  else if (!parse(*text, value))
    return "parameter '" + key + "' is " + in_quotes(*text) + ", expected " +
           (std::is_integral_v<Value> ? "an integer" : "a finite number");
  return {};
}

/// Bytes of the longest header that is written or read. Those of runs have a few thousand; a small
/// compressed file may unpack to any.
constexpr std::int64_t longest_header = 1 << 23;

/// A key or value that cannot be read back as written is an error of the program.
/// \throws std::invalid_argument
inline void check_parameters(const Parameters &parameters) {
  std::unordered_set<std::string_view> keys;
  std::size_t bytes = 0;
  for (const auto &[key, value] : parameters) {
    bytes += key.size() + value.size() + std::string_view("#  = \n").size();
    if (bytes > longest_header)
      throw std::invalid_argument("file header: longer than " + std::to_string(longest_header) +
                                  " bytes");
    if (key.empty() || trim(key) != key || key.find_first_of("=\n\r") != std::string::npos)
      throw std::invalid_argument("file header: parameter name " + in_quotes(key) +
                                  " is empty or has blanks around it, '=' or a line break");
    if (value.find_first_of("\n\r") != std::string::npos)
      throw std::invalid_argument("file header: value of parameter " + in_quotes(key) +
                                  " has a line break");
    if (!keys.insert(key).second)
      throw std::invalid_argument("file header: parameter " + in_quotes(key) + " given twice");
  }
}

/// One "# key = value" line per parameter.
inline std::string lines_of(const Parameters &parameters) {
  std::string out;
  for (const auto &[key, value] : parameters) {
    out += "# " + key + " = ";
    out += trim(value);
    out += '\n';
  }
  return out;
}

/// Splits "# key = value" at the first '='.
inline bool parse_parameter(std::string_view line, std::pair<std::string, std::string> &parameter) {
  if (line.empty() || line.front() != '#') return false;
  line.remove_prefix(1);
  const std::size_t equals = line.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string_view key = trim(line.substr(0, equals));
  if (key.empty()) return false;
  parameter.first = std::string(key);
  parameter.second = std::string(trim(line.substr(equals + 1)));
  return true;
}

/// Parameters of a file that is being read. A header may be long, so keys are hashed.
class ParameterList {
 public:
  /// What is wrong with a key and its value, or "".
  using Check = std::string (*)(const std::string &key, const std::string &value);

  /// Adds a "# key = value" line; returns what is wrong, or "".
  std::string add_line(std::string_view line, Check check = nullptr) {
    std::pair<std::string, std::string> parameter;
    if (!parse_parameter(line, parameter))
      return "header line " + in_quotes(line) + ", expected '# key = value'";
    const auto &[key, value] = parameter;
    const std::string problem = check ? check(key, value) : "";
    if (!problem.empty()) return problem;
    if (!keys_.insert(key).second)
      return "parameter " + in_quotes(key) + " given twice, expected once";
    all_.push_back(std::move(parameter));
    return {};
  }
  /// The lines of a text, up to the first that is wrong.
  std::string add_lines(std::string_view text, Check check = nullptr) {
    for (std::int64_t number = 1; !text.empty(); ++number) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string problem = add_line(text.substr(0, end), check);
      if (!problem.empty()) return "header line " + std::to_string(number) + ": " + problem;
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return {};
  }
  const Parameters &all() const { return all_; }

 private:
  Parameters all_;
  std::unordered_set<std::string> keys_;
};

/// First difference between the header of a file and the one a resumed run would write, or "".
inline std::string difference(const Parameters &in_file, const Parameters &expected,
                              const std::vector<std::string> &ignore) {
  const auto ignored = [&ignore](const std::string &key) {
    return std::find(ignore.begin(), ignore.end(), key) != ignore.end();
  };
  using Values = std::unordered_map<std::string_view, std::string_view>;
  const Values found(in_file.begin(), in_file.end()), known(expected.begin(), expected.end());
  for (const auto &[key, value] : expected) {
    if (ignored(key)) continue;
    const std::string wanted(trim(value));
    const auto there = found.find(key);
    if (there == found.end())
      return "parameter '" + key + "' is missing in the file, expected '" + wanted + "'";
    if (there->second != wanted)
      return "parameter '" + key + "' is '" + std::string(there->second) +
             "' in the file, expected '" + wanted + "'";
  }
  for (const auto &[key, value] : in_file)
    if (!ignored(key) && known.count(key) == 0)
      return "parameter '" + key + "' is '" + value + "' in the file, expected no such parameter";
  return {};
}

/// The bytes of a file, in order.
class Bytes {
 public:
  explicit Bytes(std::string path) : path_(std::move(path)) {}
  virtual ~Bytes() = default;
  Bytes(const Bytes &) = delete;
  Bytes &operator=(const Bytes &) = delete;

  /// Returns fewer than most only at the end. \throws FileError
  std::size_t read(char *to, std::size_t most) {
    const std::size_t known = std::min(most, ahead_.size());
    std::memcpy(to, ahead_.data(), known);
    ahead_.erase(0, known);
    return known == most ? known : known + more(to + known, most - known);
  }
  /// The next bytes, without consuming them. \throws FileError
  std::string_view peek(std::size_t count) {
    const std::size_t known = ahead_.size();
    if (known < count) {
      ahead_.resize(count);
      ahead_.resize(known + more(ahead_.data() + known, count - known));
    }
    return std::string_view(ahead_).substr(0, count);
  }
  /// Of the whole file; negative: not known, of a pipe. \throws FileError
  virtual std::int64_t size() const = 0;
  const std::string &path() const { return path_; }

 private:
  virtual std::size_t more(char *to, std::size_t most) = 0;

  std::string path_, ahead_;
};

/// The bytes of a file, unchanged.
class FileBytes : public Bytes {
 public:
  /// \throws FileError
  explicit FileBytes(const std::string &path) : Bytes(path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
      throw FileError(path + ": is a directory, expected a file");
    errno = 0;
    file_.reset(std::fopen(path.c_str(), "rb"));
    if (!file_) throw FileError(path + ": cannot open: " + std::generic_category().message(errno));
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  }
  std::int64_t size() const override {
    std::error_code code;
    if (!std::filesystem::is_regular_file(path(), code)) return -1;
    const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path(), code));
    if (code) throw FileError(path() + ": cannot read: " + code.message());
    return size;
  }

 private:
  struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };

  std::size_t more(char *to, std::size_t most) override {
    errno = 0;
    const std::size_t got = std::fread(to, 1, most, file_.get());
    if (got < most && std::ferror(file_.get()))
      throw FileError(path() + ": cannot read: " + std::generic_category().message(errno));
    return got;
  }

  std::unique_ptr<std::FILE, Close> file_;
};

/// The program that compressed a file that begins with these bytes, or "".
inline std::string_view compressed_by(std::string_view head) {
  using namespace std::string_view_literals;
  constexpr std::pair<std::string_view, std::string_view> known[] = {
      {"\x1f\x8b"sv, "gzip"},
      {"\xfd"
       "7zXZ\0"sv,
       "xz"},
      {"BZh"sv, "bzip2"},
      {"\x28\xb5\x2f\xfd"sv, "zstd"}};
  for (const auto &[mark, program] : known)
    if (head.substr(0, mark.size()) == mark) return program;
  return {};
}
/// The same of a file that was not read yet. \throws FileError
inline std::string_view compressed_by(Bytes &file) { return compressed_by(file.peek(6)); }

/// A file that is not compressed: LAMMPS and the block-slider link no library for others.
/// \throws FileError
inline std::unique_ptr<Bytes> open_plain(const std::string &path) {
  auto bytes = std::make_unique<FileBytes>(path);
  const std::string_view program = compressed_by(*bytes);
  if (!program.empty())
    throw FileError(path + ": compressed by " + std::string(program) +
                    ", expected a file that is not");
  return bytes;
}

/// Whether a text begins as one in UTF-16, and what is to be said of it.
inline bool is_utf16(std::string_view head) {
  return head.substr(0, 2) == "\xff\xfe" || head.substr(0, 2) == "\xfe\xff";
}
constexpr const char *utf16_text = ": text in UTF-16, expected UTF-8 or ASCII";

/// Lines of a file with their numbers and byte offsets, read in large blocks, without a byte order
/// mark and the '\r' of Windows line ends.
class LineReader {
 public:
  /// \throws FileError
  explicit LineReader(const std::string &path) : LineReader(open_plain(path)) {}
  explicit LineReader(std::unique_ptr<Bytes> bytes) : bytes_(std::move(bytes)) {
    buffer_.resize(first_size);
    constexpr std::string_view mark = "\xef\xbb\xbf";
    const std::string_view begin = bytes_->peek(mark.size());
    if (is_utf16(begin)) throw FileError(path() + utf16_text);
    foreign_ = begin == mark;
    if (foreign_) end_ = static_cast<std::int64_t>(bytes_->read(buffer_.data(), mark.size()));
  }

  /// Next line without its '\n', valid until the next call; false at the end of the file.
  /// \throws FileError if the file cannot be read or a line is longer than any of ours can be.
  bool next(std::string_view &line) {
    begin_ = end_;
    std::size_t searched = 0;
    const char *newline = nullptr;
    for (;;) {
      const char *const start = buffer_.data() + used_;
      const std::size_t there = filled_ - used_;
      newline = static_cast<const char *>(std::memchr(start + searched, '\n', there - searched));
      searched = there;
      if (newline || !fill()) break;
    }
    const char *const start = buffer_.data() + used_;
    const std::size_t length = newline ? static_cast<std::size_t>(newline - start) : searched;
    if (!newline && length == 0) return false;
    line = std::string_view(start, length);
    complete_ = newline != nullptr;
    const std::size_t taken = length + (complete_ ? 1 : 0);
    used_ += taken;
    end_ += static_cast<std::int64_t>(taken);
    ++line_;
    if (!line.empty() && line.back() == '\r') {
      line.remove_suffix(1);
      foreign_ = true;
    }
    return true;
  }

  const std::string &path() const { return bytes_->path(); }
  std::int64_t line() const { return line_; }    ///< number of the last line, from 1
  std::int64_t begin() const { return begin_; }  ///< offset of the last line
  std::int64_t end() const { return end_; }      ///< offset behind the last line
  bool complete() const { return complete_; }    ///< the last line ended with '\n'
  /// There was a byte order mark or a Windows line end: none of our programs wrote this.
  bool foreign() const { return foreign_; }

  [[noreturn]] void fail(const std::string &what) const {
    throw FileError(where(path(), line_) + what);
  }

 private:
  static constexpr std::size_t first_size = 1 << 18, longest_line = 1 << 20;

  /// Reads more bytes after the unfinished line, which moves to the front; false at the end of the
  /// file.
  bool fill() {
    const std::size_t rest = filled_ - used_;
    std::memmove(buffer_.data(), buffer_.data() + used_, rest);
    used_ = 0;
    filled_ = rest;
    if (rest == buffer_.size()) {
      if (rest >= longest_line)
        throw FileError(where(path(), line_ + 1) + "longer than " + std::to_string(longest_line) +
                        " bytes, expected a line of text");
      buffer_.resize(2 * rest);
    }
    const std::size_t got = bytes_->read(buffer_.data() + filled_, buffer_.size() - filled_);
    filled_ += got;
    return got > 0;
  }

  std::unique_ptr<Bytes> bytes_;
  std::vector<char> buffer_;
  std::size_t used_ = 0, filled_ = 0;  // the remaining lines are between them
  std::int64_t line_ = 0, begin_ = 0, end_ = 0;
  bool complete_ = true, foreign_ = false;
};

/// Whether path is a file that would be replaced: regular, and not empty.
inline bool holds_data(const std::string &path) {
  std::error_code code;
  return !path.empty() && std::filesystem::is_regular_file(path, code) &&
         std::filesystem::file_size(path, code) > 0 && !code;
}

/// Opens a file for writing, at its end unless it is to begin anew; nullptr: errno says why. The
/// name of a temporary file is no secret: a link that somebody has put there is not followed.
inline std::FILE *open_for_writing(const std::string &path, bool anew, bool follow = true) {
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | (anew ? O_TRUNC : O_APPEND);
  const int file = ::open(path.c_str(), flags | (follow ? 0 : O_NOFOLLOW), 0666);
  return file < 0 ? nullptr : fdopen(file, anew ? "wb" : "ab");
}

/// Why open_for_writing() failed.
inline std::string why_not_opened(const std::string &path, const std::string &opened, int reason) {
  if (reason == ELOOP && opened != path)
    return path + ": cannot write: its temporary file " + opened +
           " is a symbolic link; move it away";
  return path + ": cannot open for writing: " + std::generic_category().message(reason);
}

/// Why OutputFile could not write the file path, or "". Nothing is changed or left behind.
inline std::string why_not_writable(const std::string &path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    return path + ": is a directory, expected a file name";
  const bool there = std::filesystem::exists(path, code);
  // A reader of a pipe would notice.
  if (there && !std::filesystem::is_regular_file(path, code)) return {};
  // A file that exists is written in place, or replaced by a new one beside it.
  for (const std::string &tried : {path, path + ".new"}) {
    if (tried == path && !there) continue;
    std::FILE *const file = open_for_writing(tried, false, tried == path);
    if (!file) return why_not_opened(path, tried, errno);
    std::fclose(file);
    if (tried != path) std::filesystem::remove(tried, code);
  }
  return {};
}

/// Writes all data of a file, or all names of a folder, to the disk. \throws FileError
inline void sync(const std::string &path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool failed = file < 0 || fsync(file) != 0;
  const int reason = errno;
  if (file >= 0) ::close(file);
  // Some file systems cannot synchronise folders.
  if (failed && (file < 0 || reason != EINVAL))
    throw FileError(path + ": cannot write: " + std::generic_category().message(reason));
}

/// Unbuffered output file: each write() hands all its bytes to the operating system at once, so
/// that a process killed between two calls leaves nothing half-written. \throws FileError
class OutputFile {
 public:
  OutputFile() = default;
  OutputFile(const OutputFile &) = delete;
  OutputFile &operator=(const OutputFile &) = delete;
  ~OutputFile() { discard(); }

  /// Replaces path by a file that begins with text, written beside it; an older file stays
  /// untouched if that fails. \param whole the file gets its name by close() only, and nothing is
  /// left of it without
  void create(const std::string &path, std::string_view text, bool whole = false) {
    namespace fs = std::filesystem;
    close();
    std::error_code code;
    // A link has to keep pointing to the file; devices and pipes cannot be replaced.
    name_ = fs::is_symlink(path, code) ? fs::weakly_canonical(path, code).string() : path;
    if (code) name_ = path;
    written_ = name_;
    const fs::file_status status = fs::status(name_, code);
    if (fs::is_directory(status)) throw FileError(path + ": is a directory, expected a file name");
    const bool special = fs::exists(status) && !fs::is_regular_file(status);
    open(path, special ? name_ : name_ + ".new", true);
    write(text);
    if (!whole) take_name();
  }

  /// An existing file of which append() will keep so many bytes.
  void keep(const std::string &path, std::int64_t bytes) {
    close();
    name_ = written_ = path;
    kept_ = static_cast<std::uintmax_t>(bytes);
  }

  /// Truncates that file and continues behind the bytes that are kept.
  void append() {
    // Opened first: without the right to write nothing is cut.
    open(name_, name_, false);
    std::error_code code;
    if (std::filesystem::file_size(name_, code) != kept_ && !code)
      std::filesystem::resize_file(name_, kept_, code);
    if (code) give_up("cannot truncate", code);
  }

  /// On failure the file is closed, as lines after a half-written one would not be readable.
  void write(std::string_view text) {
    if (!file_) throw FileError("output file is not open");
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
      give_up("cannot write");
  }

  /// What was written is on the disk.
  void sync() {
    if (fsync(fileno(file_)) != 0) give_up("cannot write");
  }

  void close() {
    if (!file_) return;
    errno = 0;
    if (std::fclose(std::exchange(file_, nullptr)) != 0) give_up("cannot write");
    take_name();
  }

  bool is_open() const { return file_ != nullptr; }
  const std::string &path() const { return path_; }

 private:
  static std::error_code reason() { return {errno, std::generic_category()}; }

  void take_name() {
    if (written_ == name_) return;
    if (std::rename(written_.c_str(), name_.c_str()) != 0) give_up("cannot create");
    written_ = name_;
  }

  [[noreturn]] void give_up(const char *what, std::error_code why = reason()) {
    discard();
    throw FileError(path_ + ": " + what + ": " + why.message());
  }

  void discard() {
    if (file_) std::fclose(std::exchange(file_, nullptr));
    if (written_ != name_) std::remove(written_.c_str());
    written_ = name_;
  }

  void open(const std::string &shown, const std::string &opened, bool anew) {
    path_ = shown;
    file_ = open_for_writing(opened, anew, opened == name_);
    if (!file_) throw FileError(why_not_opened(path_, opened, errno));
    written_ = opened;
    std::setvbuf(file_, nullptr, _IONBF, 0);
  }

  std::FILE *file_ = nullptr;
  std::string path_, name_, written_;  // as given, with links resolved, and while being written
  std::uintmax_t kept_ = 0;
};

/// A file that a restarted run goes on with. find_cut() of the derived class looks at it without a
/// change: where more than one file goes on, nothing is cut before all of them are found to fit.
class ResumableFile {
 public:
  /// Drops what find_cut() found, and goes on there. \throws FileError
  void cut() { file_.append(); }
  /// \throws FileError if the system reports a late failure. Also done on destruction, silently.
  void close() { file_.close(); }
  bool is_open() const { return file_.is_open(); }

 protected:
  [[noreturn]] static void refuse(const std::string &path, const std::string &why) {
    throw FileError(path + ": cannot resume: " + why);
  }

  OutputFile file_;
};

/// Replaces path by a file with the text, or leaves it unchanged. \param safe also writes it to the
/// disk, so that a power failure cannot lose it \throws FileError
inline void write_file(const std::string &path, std::string_view text, bool safe = false) {
  OutputFile file;
  file.create(path, text, true);
  if (safe) file.sync();
  file.close();
}

}  // namespace text_io
}  // namespace LSM

#endif
