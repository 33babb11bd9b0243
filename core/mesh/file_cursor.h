// A place in a file that is being read. The first failure sticks: later reads return zeros, and error() tells where it
// happened, so that readers check once per record and loops end by themselves.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"

namespace flexcast {

struct FileContent {
  std::string name;  // as errors show it
  std::string bytes;
};

// The whole file, or why it cannot be had.
Result<FileContent> read_whole_file(const std::filesystem::path& path);

// A word from a file as an error text shows it: quoted, shortened, control characters replaced.
std::string quoted(std::string_view word);

// The word as a number; nothing if any part of it is not. Real numbers may be infinite or NaN.
std::optional<std::int64_t> parse_integer(std::string_view word);
std::optional<double> parse_number(std::string_view word);

class FileCursor {
 public:
  // The content must outlive the cursor.
  explicit FileCursor(const FileContent& file) : name_(file.name), content_(file.bytes) {}

  bool failed() const { return error_.has_value(); }
  Error error() const;
  void fail(const std::string& what);  // "<name>, line <n>: <what>", the line of the last read
  const std::string& name() const { return name_; }

  std::int64_t read_line() const { return read_line_; }  // of the last read

  // From here on the file counts in bytes, not lines.
  void count_bytes() { binary_ = true; }

  bool at_end() const { return position_ == content_.size(); }
  std::uint64_t remaining() const { return content_.size() - position_; }

  // The rest of the line, without its end.
  std::string_view line();
  // Text up to white space, across lines. `expected` says in errors what should stand there.
  std::string_view word(const char* expected);
  std::int64_t integer(const char* expected);
  double number(const char* expected);

  // A value as it lies in memory.
  template <class T>
  T raw(const char* expected) {
    T value{};
    if (!has_bytes(sizeof(T), expected)) return value;
    std::memcpy(&value, content_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  // So many bytes as they are; none after a failure.
  std::string_view bytes(std::uint64_t count, const char* expected);

  // What comes next, so many bytes at most.
  std::string_view peek(std::size_t count) const { return content_.substr(position_, count); }
  void skip_white_space();
  // Goes behind the next line that starts with this word.
  void skip_past_line(std::string_view start);
  // The next word must be this one.
  void expect_word(std::string_view expected);

  // Fails when a count is negative or more than the rest of the file can hold: nothing may be allocated for it.
  void check_count(std::int64_t count, std::uint64_t bytes_each, const char* what);

 private:
  void begin_read();
  bool has_bytes(std::uint64_t count, const char* expected);

  std::string name_;
  std::string_view content_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1;
  std::size_t read_position_ = 0;  // where the last read began
  std::int64_t read_line_ = 1;
  bool binary_ = false;
  std::optional<Error> error_;
};

}  // namespace flexcast
