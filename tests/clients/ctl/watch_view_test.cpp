// The view of --watch: what is on it, that it fits, and that it is drawn in place.
#include "clients/ctl/watch_view.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <sstream>

#include "clients/ctl/screen.h"
#include "idl/wire/fill.h"

namespace flexcast::ctl {
namespace {

// What a terminal shows after it was given `text`: of the sequences those that Screen uses.
class Terminal {
 public:
  explicit Terminal(std::size_t rows) : rows_(rows), lines_(1) {}

  void take(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\r') {
        column_ = 0;
      } else if (text[i] == '\n') {
        if (++row_ == lines_.size()) lines_.emplace_back();
        scrolled = scrolled || lines_.size() > rows_;
      } else if (text[i] == '\x1b') {
        i = follow(text, i + 2);
      } else {
        lines_[row_].resize(std::max(lines_[row_].size(), column_ + 1), ' ');
        lines_[row_][column_++] = text[i];
      }
    }
  }

  std::vector<std::string> lines() const { return lines_; }
  bool scrolled = false;

 private:
  std::size_t follow(const std::string& text, std::size_t i) {
    std::size_t number = 0;
    while (std::isdigit(text[i])) number = 10 * number + static_cast<std::size_t>(text[i++] - '0');
    if (text[i] == 'A') row_ -= number;
    if (text[i] == 'K' || text[i] == 'J') lines_[row_].resize(std::min(lines_[row_].size(), column_));
    if (text[i] == 'J') lines_.resize(row_ + 1);
    return i;
  }

  std::size_t rows_, row_ = 0, column_ = 0;
  std::vector<std::string> lines_;
};

TEST(Screen, IsDrawnAgainInPlaceWhateverItsLengthAndNeverScrolls) {
  std::ostringstream out;
  Screen screen(out);
  Terminal terminal(6);
  const std::vector<std::vector<std::string>> views = {
      {"one", "two long line", "three"}, {"uno", "dos"}, {"1", "2", "3", "4", "5", "6", "7"}, {"a", "b", "c"}};
  for (const auto& view : views) {
    out.str("");
    screen.draw(view, {6, 8});
    terminal.take(out.str());
    auto expected = view;
    if (expected.size() > 5) expected.resize(5);
    for (std::string& line : expected) line = line.substr(0, 8);
    expected.emplace_back();
    EXPECT_EQ(terminal.lines(), expected);
  }
  EXPECT_FALSE(terminal.scrolled);
}

class WatchView : public testing::Test {
 protected:
  void see() { judge.see({wire::StatusNews::Kind::status, "beam", {status, &**status}, {}, 0, now}); }
  std::string text(std::chrono::milliseconds later = {}) const {
    std::string all;
    for (const std::string& line : make_watch_view("beam", judge, now + later)) all += line + "\n";
    return all;
  }

  const HealthJudge::Clock::time_point now = HealthJudge::Clock::now();
  std::shared_ptr<wire::Owned<flexcast_Status>> status = std::make_shared<wire::Owned<flexcast_Status>>();
  HealthJudge judge;
};

TEST_F(WatchView, ShowsWhatMatters) {
  flexcast_Status& s = **status;
  s.report.step = 1234;
  s.report.time = 1.5;
  s.real_time_factor = 0.75;
  s.step_seconds = 0.002;
  s.frames_published = 77;
  s.frames_skipped = 3;
  s.readers = 2;
  s.report.kinetic = 4.25;
  s.report.error_estimate = std::nan("");
  s.report.stability_margin = 1.5;
  s.report.substeps = 5;
  wire::set_strings(s.warnings, std::vector<std::string>{"a margin below one"});
  see();
  for (const char* part : {"beam", "running", "1234", "1.5000 s", "0.750", "2 ms", "77 published", "3 skipped",
                           "2 readers", "4.25 J", "error            -", "margin        1.5", "substeps      5",
                           "warning   a margin below one", "0.4 s old", "health    ok"}) {
    EXPECT_NE(text(std::chrono::milliseconds(400)).find(part), std::string::npos) << part << "\n" << text();
  }
  EXPECT_NE(text(std::chrono::seconds(9)).find("gone or unreachable"), std::string::npos);
}

TEST_F(WatchView, FitsEightyColumnsWhateverTheValues) {
  flexcast_Status& s = **status;
  s.state = flexcast_WORLD_FAILED;
  s.report.step = 999'999'999'999;
  s.report.time = 123456789.1234;
  s.real_time_factor = 1234.567;
  s.rate = 0.123456;
  s.step_seconds = 12.3456;
  s.frames_published = 999'999'999'999;
  s.frames_skipped = 999'999'999;
  s.readers = 9999;
  for (double* number :
       {&s.report.kinetic, &s.report.elastic, &s.report.gravity, &s.report.contact, &s.report.work,
        &s.report.dissipated, &s.report.numerical, &s.report.error_estimate, &s.report.stability_margin}) {
    *number = -1.23456789e-300;
  }
  wire::set_string(s.trouble.cause, std::string(300, 'x'));
  wire::set_string(s.trouble.suggestion, "lower time.step or the stiffness, raise the damping, or reset; and so on");
  see();
  for (const std::string& line : make_watch_view(std::string(64, 'w'), judge, now)) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_LT(make_watch_view("beam", judge, now).size(), 24u) << "a common terminal";
}

}  // namespace
}  // namespace flexcast::ctl
