#include "clients/ctl/status.h"

#include <algorithm>

#include "clients/ctl/interruption.h"
#include "clients/ctl/json.h"
#include "clients/ctl/text.h"
#include "clients/ctl/watch.h"

namespace flexcast::ctl {
namespace {

using namespace std::chrono_literals;
using Clock = HealthJudge::Clock;

constexpr auto slice = 100ms;      // in which an interruption is noticed
constexpr auto confirmation = 2s;  // at least, from the first status on, to see whether more come and it moves
constexpr auto discovery = 250ms;  // from the first status on, until other worlds are known

// Until it is clear how the world is (and, where none was named, that it is the only one), at most for as long as the
// user waits.
void observe(const Options& options, WorldFollower& follower, const Interruption& interruption) {
  const auto start = Clock::now();
  auto end = start + options.connect.wait;
  std::optional<Clock::time_point> clear_from;
  for (auto now = start; now < end && !interruption.happened(); now = Clock::now()) {
    follower.update();
    const HealthJudge& judge = follower.judge();
    if (judge.status() && !clear_from) {
      end = std::max(end, now + confirmation);
      clear_from = options.connect.world.empty() ? now + discovery : now;
    }
    const bool clear = judge.has_pulse() || (judge.status() && judge.judge(now) != Health::ok);
    if (clear && now >= *clear_from) return;
    follower.wait(std::min<std::chrono::nanoseconds>(slice, end - now));
  }
}

void print(const Options& options, const HealthJudge& judge, Health health, std::ostream& out) {
  if (options.json) {
    Json json = to_json(*judge.status());
    json["health"] = name_of(health);
    out << json.dump() << std::endl;
  } else {
    out << status_text(*judge.status(), name_of(health)) << std::flush;
  }
}

int report_absence(const Options& options, const std::string& reason, std::ostream& out, std::ostream& err) {
  if (options.json) {
    const Json json{{"world", options.connect.world},
                    {"health", name_of(Health::not_found)},
                    {"domain", options.connect.domain},
                    {"reason", reason}};
    out << json.dump() << std::endl;
  }
  err << "flexcast-ctl: " << reason << "\n";
  return 1;
}

}  // namespace

std::vector<wire::StatusNews> WorldFollower::update() {
  std::vector<wire::StatusNews> ours;
  for (wire::StatusNews& news : watch_.take()) {
    if (world_.empty()) {
      world_ = news.world;
      named_by_chance_ = true;
    }
    if (news.world == world_) {
      judge_.see(news);
      ours.push_back(std::move(news));
    } else if (std::find(others_.begin(), others_.end(), news.world) == others_.end()) {
      others_.push_back(news.world);
    }
  }
  return ours;
}

std::string WorldFollower::others() const {
  std::vector<std::string> names = others_;
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

wire::Result<wire::Participant> join(const Options& options) {
  return wire::Participant::create(
      {.domain = options.connect.domain, .profile = options.connect.profile, .security = options.connect.security});
}

std::string describe_absence(const Options& options, const wire::Participant& participant, const std::string& others) {
  const std::string& world = options.connect.world;
  return "no world" + (world.empty() ? "" : " '" + world + "'") + " on domain " + std::to_string(participant.domain()) +
         " (profile " + participant.profile() + "): waited " + client::seconds_text(options.connect.wait) +
         (others.empty() ? "" : "; there: " + others) + "; flexcast-ctl doctor looks for the cause";
}

int run_status(const Options& options, std::ostream& out, std::ostream& err) {
  const Interruption interruption;
  const auto participant = join(options);
  if (!participant) return report_absence(options, participant.error().message, out, err);
  auto watch = wire::StatusWatch::create(participant.value());
  if (!watch) return report_absence(options, watch.error().message, out, err);
  WorldFollower follower(std::move(watch).value(), options.connect.world);
  observe(options, follower, interruption);
  if (interruption.happened()) return 0;
  if (!follower.judge().status()) {
    return report_absence(options, describe_absence(options, participant.value(), follower.others()), out, err);
  }
  if (follower.is_ambiguous()) {
    return report_absence(options,
                          "more than one world on domain " + std::to_string(options.connect.domain) +
                              ", name one: " + follower.world() + ", " + follower.others(),
                          out, err);
  }
  if (options.watch) return run_watch(options, follower, interruption, out, err);
  const auto now = Clock::now();
  const Health health = follower.judge().judge(now);
  print(options, follower.judge(), health, out);
  if (health == Health::ok) return 0;
  err << "flexcast-ctl: world '" << follower.world() << "' is " << describe(health, follower.judge(), now) << "\n";
  return 1;
}

}  // namespace flexcast::ctl
