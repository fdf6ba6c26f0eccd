// SPDX-License-Identifier: GPL-2.0-or-later
#include "input_file.h"

#include <lzma.h>
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace LSM::postproc {

// zlib and liblzma themselves, as libarchive does not verify the checksum of gzip.
namespace {

using files::Bytes;

/// The decompressed bytes of a file.
class Unpacked : public Bytes {
 public:
  explicit Unpacked(std::unique_ptr<Bytes> packed)
      : Bytes(packed->path()), packed_(std::move(packed)), input_(1 << 16) {}

  std::int64_t size() const override {
    if (packed_->size() < 0) return -1;  // a pipe cannot be read twice
    const std::unique_ptr<Bytes> again = open_input(path());
    std::vector<char> block(1 << 16);
    std::int64_t sum = 0;
    while (const std::size_t got = again->read(block.data(), block.size()))
      sum += static_cast<std::int64_t>(got);
    return sum;
  }

 protected:
  [[noreturn]] void fail(const std::string &what) const { throw FileError(path() + ": " + what); }

  /// Reads the next compressed bytes; none at the end of the file.
  std::pair<std::uint8_t *, std::size_t> next_input() {
    const std::size_t got = packed_->read(input_.data(), input_.size());
    return {reinterpret_cast<std::uint8_t *>(input_.data()), got};
  }

 private:
  std::unique_ptr<Bytes> packed_;
  std::vector<char> input_;
};

class Gunzipped : public Unpacked {
 public:
  explicit Gunzipped(std::unique_ptr<Bytes> packed) : Unpacked(std::move(packed)) {
    // Adding 16 makes zlib expect the gzip format only, and verify its checksum.
    if (inflateInit2(&stream_, 15 + 16) != Z_OK) fail("cannot read: out of memory");
  }
  ~Gunzipped() override { inflateEnd(&stream_); }

 private:
  std::size_t more(char *to, std::size_t most) override {
    stream_.next_out = reinterpret_cast<Bytef *>(to);
    stream_.avail_out = static_cast<uInt>(most);
    while (stream_.avail_out > 0) {
      if (stream_.avail_in == 0) {
        const auto [at, count] = next_input();
        stream_.next_in = at;
        stream_.avail_in = static_cast<uInt>(count);
        if (count == 0) {
          if (!between_) fail("truncated gzip file");
          break;
        }
      }
      // A gzip file may be several compressed files, one after the other.
      if (between_) inflateReset(&stream_);
      const int status = inflate(&stream_, Z_NO_FLUSH);
      between_ = status == Z_STREAM_END;
      if (status != Z_OK && !between_)
        fail(std::string("damaged gzip file: ") + (stream_.msg ? stream_.msg : "no valid data"));
    }
    return most - stream_.avail_out;
  }

  z_stream stream_{};
  bool between_ = false;
};

class Unxzed : public Unpacked {
 public:
  explicit Unxzed(std::unique_ptr<Bytes> packed) : Unpacked(std::move(packed)) {
    constexpr std::uint64_t most_memory = std::uint64_t{1} << 30;
    if (lzma_stream_decoder(&stream_, most_memory, LZMA_CONCATENATED) != LZMA_OK)
      fail("cannot read: out of memory");
  }
  ~Unxzed() override { lzma_end(&stream_); }

 private:
  std::size_t more(char *to, std::size_t most) override {
    stream_.next_out = reinterpret_cast<std::uint8_t *>(to);
    stream_.avail_out = most;
    while (stream_.avail_out > 0 && !ended_) {
      if (stream_.avail_in == 0 && !last_) {
        std::tie(stream_.next_in, stream_.avail_in) = next_input();
        last_ = stream_.avail_in == 0;
      }
      const lzma_ret status = lzma_code(&stream_, last_ ? LZMA_FINISH : LZMA_RUN);
      ended_ = status == LZMA_STREAM_END;
      if (status == LZMA_BUF_ERROR) fail("truncated xz file");
      if (status == LZMA_MEMLIMIT_ERROR) fail("xz file that needs more than 1 GiB of memory");
      if (status != LZMA_OK && !ended_) fail("damaged xz file");
    }
    return most - stream_.avail_out;
  }

  lzma_stream stream_ = LZMA_STREAM_INIT;
  bool last_ = false, ended_ = false;
};

}  // namespace

std::unique_ptr<Bytes> open_input(const std::string &path) {
  std::error_code ignored;
  if (path == "-" && !std::filesystem::exists(path, ignored))
    throw FileError("-: no such file, expected /dev/stdin for standard input");
  auto bytes = std::make_unique<files::FileBytes>(path);
  const std::string_view program = files::compressed_by(*bytes);
  if (program == "gzip") return std::make_unique<Gunzipped>(std::move(bytes));
  if (program == "xz") return std::make_unique<Unxzed>(std::move(bytes));
  if (!program.empty())
    throw FileError(path + ": compressed by " + std::string(program) +
                    ", expected gzip, xz or a file that is not compressed");
  return bytes;
}

SlipHistoryReader open_history(const std::string &path, bool lenient) {
  SlipHistoryReader reader(open_input(path), lenient);
  if (reader.torn()) fmt::print(stderr, "postproc: {}: dropped a truncated last record: 1\n", path);
  if (!(reader.info().driving > 0.0))
    throw std::runtime_error(path + ": the driving velocity in the header is not positive");
  return reader;
}

}  // namespace LSM::postproc
