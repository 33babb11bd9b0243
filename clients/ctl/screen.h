// Screen: a block of lines on a terminal that is drawn again in place, without scrolling and without flicker.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace flexcast::ctl {

struct ScreenSize {
  std::size_t rows = 24;
  std::size_t columns = 80;
};

// Of the terminal on standard output; what most have where it does not say.
ScreenSize find_screen_size();

class Screen {
 public:
  explicit Screen(std::ostream& out) : out_(out) {}

  // Takes the place of the block before. Lines are cut at the width, and at one row less than the height: the cursor
  // stands below. Characters of several bytes count as one.
  void draw(const std::vector<std::string>& lines, const ScreenSize& size);

 private:
  std::ostream& out_;
  std::size_t drawn_ = 0;  // lines above the cursor
};

}  // namespace flexcast::ctl
