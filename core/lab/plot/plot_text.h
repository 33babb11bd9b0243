// How wide text is, without a font to ask: widths of a common sans-serif, a little on the wide side.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexcast {

// Pixels, of UTF-8 text in letters of this size.
double estimate_text_width(std::string_view text, double size);

// The text, or as much of it as fits with an ellipsis behind.
std::string fit_text(std::string_view text, double size, double width);

// Lines no wider than that, broken at blanks where there are any; at least one.
std::vector<std::string> wrap_text(std::string_view text, double size, double width);

}  // namespace flexcast
