// Values of a scene file as text for error messages.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

namespace flexcast {

// As TOML writes it, on one line, shortened where it is long: -5.0, "soft", [1, 2, ...], {...}.
std::string to_text(const toml::node& value);

// "a string", "a table", ...
std::string_view type_text(const toml::node& value);

// The shortest text that reads back as the same double, with a decimal point, exponent, nan or inf.
std::string number_text(double value);

// Without decimals: how many.
std::string count_text(double count);

}  // namespace flexcast
