#include "clients/ctl/watch_view.h"

#include <fmt/format.h>

#include "clients/ctl/text.h"
#include "idl/wire/fill.h"
#include "idl/wire/names.h"

namespace flexcast::ctl {
namespace {

constexpr std::size_t width = 80;

std::string joule(double energy) {
  return fmt::format("{:>14}", number_text(energy, " J"));
}

// Broken at blanks; the first line begins with the label, the others below its text.
void add_wrapped(std::vector<std::string>& lines, const std::string& label, std::string rest) {
  const std::size_t room = width - 10;
  for (bool first = true; first || !rest.empty(); first = false) {
    std::size_t end = rest.size();
    if (end > room) {
      end = rest.rfind(' ', room);
      if (end == std::string::npos || end == 0) end = room;
    }
    lines.push_back(fmt::format("{:<10}{}", first ? label : "", rest.substr(0, end)));
    rest.erase(0, end < rest.size() && rest[end] == ' ' ? end + 1 : end);
  }
}

void add_numbers(std::vector<std::string>& lines, const flexcast_Status& s) {
  const flexcast_StepReport& r = s.report;
  lines.push_back(
      fmt::format("state     {:<10} step {:>14}   time {:>14.4f} s", wire::name_of(s.state), r.step, r.time));
  lines.push_back(fmt::format("speed     real-time factor {:>8.3f} of {:<9} a step takes {:>9.4g} ms",
                              s.real_time_factor, rate_text(s.rate), 1e3 * s.step_seconds));
  lines.push_back(fmt::format("frames    {:>12} published   {:>9} skipped   {:>4} readers", s.frames_published,
                              s.frames_skipped, s.readers));
  lines.push_back(fmt::format("energy    kinetic {}  elastic   {}", joule(r.kinetic), joule(r.elastic)));
  lines.push_back(fmt::format("          gravity {}  contact   {}", joule(r.gravity), joule(r.contact)));
  lines.push_back(fmt::format("          work    {}  dissipated{}", joule(r.work), joule(r.dissipated)));
  lines.push_back(fmt::format("          numerical {:>12}", number_text(r.numerical, " J")));
  lines.push_back(fmt::format("step      substeps {:>6}   error {:>12}   stability margin {:>10}", r.substeps,
                              number_text(r.error_estimate), number_text(r.stability_margin)));
}

}  // namespace

std::vector<std::string> make_watch_view(const std::string& world, const HealthJudge& judge,
                                         HealthJudge::Clock::time_point now) {
  const Health health = judge.judge(now);
  std::vector<std::string> lines;
  lines.push_back(fmt::format("world     {:<45.45} status {:>6.1f} s old", world, judge.age(now)));
  add_wrapped(lines, "health",
              std::string(name_of(health)) + (health == Health::ok ? "" : ": ") +
                  (health == Health::ok ? "" : describe(health, judge, now)));
  const auto status = judge.status();
  if (!status) return lines;
  add_numbers(lines, *status);
  if (status->state == flexcast_WORLD_FAILED) {
    add_wrapped(lines, "trouble", std::string(wire::text(status->trouble.cause)));
    add_wrapped(lines, "", std::string(wire::text(status->trouble.suggestion)));
  }
  for (const std::string& warning : wire::strings(status->warnings)) add_wrapped(lines, "warning", warning);
  return lines;
}

}  // namespace flexcast::ctl
