#include "clients/ctl/screen.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace flexcast::ctl {
namespace {

// The first so many characters; bytes 10xxxxxx go on with the one before.
std::string cut(const std::string& line, std::size_t columns) {
  std::size_t width = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if ((static_cast<unsigned char>(line[i]) & 0xC0) == 0x80) continue;
    if (++width > columns) return line.substr(0, i);
  }
  return line;
}

}  // namespace

ScreenSize find_screen_size() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row < 2 || size.ws_col < 2) return {};
  return {size.ws_row, size.ws_col};
}

// One write: up to the first line, each line and the rest of its row cleared, then what is below.
void Screen::draw(const std::vector<std::string>& lines, const ScreenSize& size) {
  std::string text;
  if (drawn_ > 0) text += "\x1b[" + std::to_string(drawn_) + "A";
  text += '\r';
  drawn_ = std::min(lines.size(), size.rows - 1);
  for (std::size_t i = 0; i < drawn_; ++i) text += cut(lines[i], size.columns) + "\x1b[K\r\n";
  out_ << text << "\x1b[J" << std::flush;
}

}  // namespace flexcast::ctl
