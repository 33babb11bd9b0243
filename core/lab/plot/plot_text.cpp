#include "core/lab/plot/plot_text.h"

#include <cstddef>

namespace flexcast {
namespace {

// em
double calc_width(char c) {
  if (std::string_view("iIjl.,:;|!'").find(c) != std::string_view::npos) return 0.3;
  if (std::string_view("frt()[]/- *\"`").find(c) != std::string_view::npos) return 0.4;
  if (std::string_view("mMW@%").find(c) != std::string_view::npos) return 0.95;
  if (std::string_view("w").find(c) != std::string_view::npos || (c >= 'A' && c <= 'Z')) return 0.74;
  return 0.6;
}

bool is_start(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

}  // namespace

double estimate_text_width(std::string_view text, double size) {
  double width = 0.0;
  for (const char c : text)
    if (is_start(c)) width += static_cast<unsigned char>(c) < 0x80 ? calc_width(c) : 0.7;
  constexpr double wide = 1.08;
  return wide * width * size;
}

std::string fit_text(std::string_view text, double size, double width) {
  if (estimate_text_width(text, size) <= width) return std::string(text);
  const double room = width - 0.9 * size;
  std::size_t end = 0;
  // Bytes after the first of a character have no width, so that this ends behind one.
  for (std::size_t i = 1; i <= text.size(); ++i) {
    if (estimate_text_width(text.substr(0, i), size) > room) break;
    end = i;
  }
  return std::string(text.substr(0, end)) + "\xE2\x80\xA6";
}

std::vector<std::string> wrap_text(std::string_view text, double size, double width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t blank = text.find(' ');
    const std::string word(text.substr(0, blank));
    text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
    if (lines.back().empty()) {
      lines.back() = word;
    } else if (estimate_text_width(lines.back() + ' ' + word, size) <= width) {
      lines.back() += ' ' + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace flexcast
