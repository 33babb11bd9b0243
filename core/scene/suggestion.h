// "did you mean": help for those who mistype a name.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexcast {

// The candidate that needs the fewest edits (inserted, removed, changed, swapped letters; case does not count), when
// that is at most a third of the length; empty otherwise. The first of equals.
std::string_view find_closest(std::string_view name, std::span<const std::string_view> candidates);

// `; did you mean "young"?`, or nothing.
std::string calc_suggestion(std::string_view name, std::span<const std::string_view> candidates);

// a, b, c
std::string join(std::span<const std::string_view> names);

// "a", "b", "c"
std::string join_quoted(std::span<const std::string_view> names);

}  // namespace flexcast
