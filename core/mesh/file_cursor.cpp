#include "core/mesh/file_cursor.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/base/checks.h"

namespace flexcast {
namespace {

constexpr std::uintmax_t maximum_file_bytes = std::uintmax_t{4} << 30;

bool is_white_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

template <class T>
std::optional<T> parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  T value{};
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

Result<FileContent> read_whole_file(const std::filesystem::path& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return Error{path.string() + ": there is no such file"};
  if (!std::filesystem::is_regular_file(status)) return Error{path.string() + ": is not a regular file"};
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) return Error{path.string() + ": cannot be read (" + code.message() + ")"};
  if (size > maximum_file_bytes) {
    return Error{path.string() + ": has " + std::to_string(size) + " bytes; at most " +
                 std::to_string(maximum_file_bytes) + " are allowed"};
  }
  std::ifstream stream(path, std::ios::binary);
  std::string content(size, '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (!stream) return Error{path.string() + ": cannot be read"};
  return FileContent{path.string(), std::move(content)};
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (char c : word.substr(0, longest)) text += (c >= ' ' && c <= '~') ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  return parse<std::int64_t>(word);
}
std::optional<double> parse_number(std::string_view word) {
  return parse<double>(word);
}

Error FileCursor::error() const {
  FLEXCAST_CHECK(failed());
  return *error_;
}

void FileCursor::fail(const std::string& what) {
  if (failed()) return;
  const std::string place =
      binary_ ? ", byte " + std::to_string(read_position_) : ", line " + std::to_string(read_line_);
  error_ = Error{name_ + place + ": " + what};
}

void FileCursor::begin_read() {
  read_position_ = position_;
  read_line_ = line_;
}

std::string_view FileCursor::line() {
  if (failed()) return {};
  begin_read();
  const std::size_t end = std::min(content_.find('\n', position_), content_.size());
  std::string_view text = content_.substr(position_, end - position_);
  position_ = std::min(end + 1, content_.size());
  ++line_;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

void FileCursor::skip_white_space() {
  for (; position_ < content_.size() && is_white_space(content_[position_]); ++position_) {
    if (content_[position_] == '\n') ++line_;
  }
}

std::string_view FileCursor::word(const char* expected) {
  if (failed()) return {};
  skip_white_space();
  begin_read();
  const std::size_t first = position_;
  while (position_ < content_.size() && !is_white_space(content_[position_])) ++position_;
  if (position_ == first) fail(std::string("the file ends where ") + expected + " is expected");
  return content_.substr(first, position_ - first);
}

std::int64_t FileCursor::integer(const char* expected) {
  const std::string_view text = word(expected);
  if (failed()) return 0;
  const auto value = parse_integer(text);
  if (!value) fail("found " + quoted(text) + " where " + expected + ", a whole number, is expected");
  return value.value_or(0);
}

double FileCursor::number(const char* expected) {
  const std::string_view text = word(expected);
  if (failed()) return 0.0;
  const auto value = parse_number(text);
  if (!value) fail("found " + quoted(text) + " where " + expected + ", a number, is expected");
  return value.value_or(0.0);
}

bool FileCursor::has_bytes(std::uint64_t count, const char* expected) {
  begin_read();
  if (!failed() && count > remaining()) fail(std::string("the file ends where ") + expected + " is expected");
  return !failed();
}

std::string_view FileCursor::bytes(std::uint64_t count, const char* expected) {
  if (!has_bytes(count, expected)) return {};
  const std::string_view bytes = content_.substr(position_, count);
  position_ += count;
  return bytes;
}

void FileCursor::skip_past_line(std::string_view start) {
  if (failed()) return;
  std::string marker = "\n";
  marker += start;
  const std::size_t found = content_.find(marker, position_);
  if (found == std::string_view::npos) {
    fail("the file ends before " + quoted(start));
    return;
  }
  const auto skipped = content_.substr(position_, found + 1 - position_);
  line_ += std::count(skipped.begin(), skipped.end(), '\n');
  position_ = found + marker.size();
}

void FileCursor::expect_word(std::string_view expected) {
  const std::string text(expected);
  const std::string_view found = word(text.c_str());
  if (!failed() && found != expected) fail("found " + quoted(found) + " where " + text + " is expected");
}

void FileCursor::check_count(std::int64_t count, std::uint64_t bytes_each, const char* what) {
  if (count < 0) {
    fail("announces " + std::to_string(count) + " " + what + "; the number must not be negative");
  } else if (static_cast<std::uint64_t>(count) > remaining() / bytes_each) {
    fail("announces " + std::to_string(count) + " " + what + ", more than the remaining " +
         std::to_string(remaining()) + " bytes of the file can hold; is it cut short?");
  }
}

}  // namespace flexcast
