#include "clients/ctl/watch.h"

#include <unistd.h>

#include <iostream>

#include "clients/ctl/json.h"
#include "clients/ctl/screen.h"
#include "clients/ctl/text.h"
#include "clients/ctl/watch_view.h"

namespace flexcast::ctl {
namespace {

using namespace std::chrono_literals;
using Clock = HealthJudge::Clock;

constexpr auto redraw_period = 200ms;  // also how often the age of the newest status is shown anew

class LinePrinter {
 public:
  LinePrinter(const Options& options, std::ostream& out, std::ostream& err) : options_(options), out_(out), err_(err) {}

  void show(const std::vector<wire::StatusNews>& news, const WorldFollower& follower) {
    const auto now = Clock::now();
    const Health health = follower.judge().judge(now);
    for (const wire::StatusNews& one : news) {
      if (one.status) print(*one.status, health);
    }
    if (health == last_) return;
    tell(follower, health, now);
    last_ = health;
  }

 private:
  void print(const flexcast_Status& status, Health health) {
    if (!options_.json) {
      out_ << status_line(status) << std::flush;
      return;
    }
    Json json = to_json(status);
    json["health"] = name_of(health);
    out_ << json.dump() << std::endl;
  }

  void tell(const WorldFollower& follower, Health health, Clock::time_point now) {
    if (options_.json && health != Health::ok && health != Health::hung) {
      out_ << Json{{"world", follower.world()}, {"health", name_of(health)}}.dump() << std::endl;
    }
    const bool back = health == Health::ok && (last_ == Health::gone || last_ == Health::ended);
    err_ << "flexcast-ctl: world '" << follower.world() << "' is " << (back ? "back: " : "")
         << describe(health, follower.judge(), now) << "\n"
         << std::flush;
  }

  const Options& options_;
  std::ostream& out_;
  std::ostream& err_;
  Health last_ = Health::ok;
};

}  // namespace

int run_watch(const Options& options, WorldFollower& follower, const Interruption& interruption, std::ostream& out,
              std::ostream& err) {
  const bool terminal = &out == &std::cout && isatty(STDOUT_FILENO) != 0 && !options.json;
  Screen screen(out);
  LinePrinter lines(options, out, err);
  while (!interruption.happened()) {
    const auto news = follower.update();
    if (terminal) {
      screen.draw(make_watch_view(follower.world(), follower.judge(), Clock::now()), find_screen_size());
    } else {
      lines.show(news, follower);
    }
    follower.wait(redraw_period);
  }
  return 0;
}

}  // namespace flexcast::ctl
