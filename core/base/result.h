// Result<T>: a value or the reason why there is none. What a user got wrong (a scene, an argument, a file) travels as
// an Error; our own bugs are assertions (checks.h); numerical trouble is a field of the step report.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/checks.h"

namespace flexcast {

// One complete sentence for the user: where (file, line, key), what was found, what is allowed.
struct Error {
  std::string message;
};

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return FLEXCAST_CHECK(ok()), std::get<0>(content_); }
  const T& value() const& { return FLEXCAST_CHECK(ok()), std::get<0>(content_); }
  T&& value() && { return FLEXCAST_CHECK(ok()), std::get<0>(std::move(content_)); }
  const Error& error() const { return FLEXCAST_CHECK(!ok()), std::get<1>(content_); }

 private:
  std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit by design

  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return FLEXCAST_CHECK(!ok()), *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace flexcast
