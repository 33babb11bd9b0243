// Status: success or the reason why not. Result<T>: a value or the reason why there is none. The library throws
// nothing; what a disk, a file or a caller got wrong comes back as one of these two.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace flexcast::mcap {

class [[nodiscard]] Status {
 public:
  Status() = default;  // success

  // `message`: one sentence for the user that names the file, what was found and what was expected.
  static Status failure(std::string message) {
    Status status;
    status.failed_ = true;
    status.message_ = std::move(message);
    return status;
  }

  bool ok() const { return !failed_; }
  explicit operator bool() const { return ok(); }

  // Empty on success.
  const std::string& message() const { return message_; }

 private:
  bool failed_ = false;
  std::string message_;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}           // NOLINT: implicit by design
  Result(Status failure) : content_(std::in_place_index<1>, std::move(failure)) {}  // NOLINT

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Only where ok().
  T& value() & { return *std::get_if<0>(&content_); }
  const T& value() const& { return *std::get_if<0>(&content_); }
  T&& value() && { return std::move(*std::get_if<0>(&content_)); }

  // Success where ok().
  Status status() const { return ok() ? Status() : *std::get_if<1>(&content_); }

 private:
  std::variant<T, Status> content_;
};

}  // namespace flexcast::mcap
