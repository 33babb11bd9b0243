#include "clients/ctl/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "idl/wire/fill.h"
#include "idl/wire/names.h"

namespace flexcast::ctl {
namespace {

using wire::elements;
using wire::name_of;
using wire::text;
using Row = std::vector<std::string>;

// Columns aligned to the left, two spaces between them, none at the end of a line.
std::string format_rows(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string result;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:<{}}  ", row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + "\n";
  }
  return result;
}

std::string vector_text(const double (&v)[3]) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v[0], v[1], v[2]);
}

std::string unquoted(const client::Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return client::to_text(value);
}

void add_failure(std::vector<Row>& rows, const flexcast_Failure& f) {
  rows.push_back({"failure", fmt::format("{}, at step {}", text(f.cause), f.step)});
  std::string place{text(f.body)};
  if (f.element >= 0) place += fmt::format(", element {}", f.element);
  if (f.particle >= 0) place += fmt::format(", particle {}", f.particle);
  rows.push_back({"", fmt::format("{}, at {}", place, vector_text(f.position))});
  if (!text(f.suggestion).empty()) rows.push_back({"", std::string(text(f.suggestion))});
}

}  // namespace

std::string rate_text(double rate) {
  if (rate == 0.0) return "max";
  if (rate == 1.0) return "realtime";
  return fmt::format("{:g}x", rate);
}

std::string number_text(double number, const char* unit) {
  return std::isnan(number) ? "-" : fmt::format("{:.6g}{}", number, unit);
}

std::string worlds_table(std::span<const flexcast_Status* const> statuses) {
  std::vector<Row> rows{{"WORLD", "STATE", "STEP", "TIME", "RATE", "VERSION"}};
  for (const flexcast_Status* s : statuses)
    rows.push_back({std::string(text(s->world)), std::string(name_of(s->state)), std::to_string(s->report.step),
                    fmt::format("{:.6g} s", s->report.time), rate_text(s->rate), std::string(text(s->version))});
  return format_rows(rows);
}

std::string descriptors_table(const client::Reply& reply) {
  std::vector<Row> rows{{"NAME", "VALUE", "UNIT", "RANGE", "LIVE", "DESCRIPTION"}};
  for (const client::Descriptor& d : reply.descriptors) {
    const client::Value* value = reply.find(d.name);
    rows.push_back(
        {d.name, unquoted(value ? *value : d.initial), d.unit, range_text(d), d.live ? "yes" : "no", d.description});
  }
  return format_rows(rows);
}

std::string values_table(std::span<const client::Parameter> values) {
  std::vector<Row> rows;
  for (const auto& [name, value] : values) rows.push_back({name, unquoted(value)});
  return format_rows(rows);
}

std::string outcome_line(const client::Reply& reply) {
  if (!reply.applied()) return fmt::format("{}: {}", name_of(reply.outcome), reply.reason);
  return fmt::format("applied at step {} ({:.6g} s): {}", reply.applied_step, reply.time, name_of(reply.state));
}

std::string status_text(const flexcast_Status& s, std::string_view health) {
  const flexcast_StepReport& r = s.report;
  std::vector<Row> rows{
      {"world", std::string(text(s.world))},
      {"health", std::string(health)},
      {"state", std::string(name_of(s.state))},
      {"step", std::to_string(r.step)},
      {"time", fmt::format("{:.6g} s", r.time)},
      {"rate", fmt::format("{}, real-time factor {:.3g}", rate_text(s.rate), s.real_time_factor)},
      {"a step takes", fmt::format("{:.3g} ms", 1e3 * s.step_seconds)},
      {"frames", fmt::format("{} published, {} skipped, {} readers", s.frames_published, s.frames_skipped, s.readers)},
      {"energy", fmt::format("kinetic {}, elastic {}, gravity {}, contact {}", number_text(r.kinetic, " J"),
                             number_text(r.elastic, " J"), number_text(r.gravity, " J"), number_text(r.contact, " J"))},
      {"", fmt::format("work {}, dissipated {}, numerical {}", number_text(r.work, " J"),
                       number_text(r.dissipated, " J"), number_text(r.numerical, " J"))},
      {"solver", fmt::format("{} iterations, residual {}{}", r.iterations, number_text(r.residual),
                             r.converged ? "" : ", NOT converged")},
      {"stability margin", number_text(r.stability_margin)},
      {"elements", fmt::format("{} inverted, smallest J {}", r.inverted, number_text(r.min_j))}};
  if (s.state == flexcast_WORLD_FAILED) add_failure(rows, s.trouble);
  for (const auto& p : elements(s.probes))
    rows.push_back({fmt::format("probe {}", text(p.name)),
                    fmt::format("{} m, {} m/s", vector_text(p.position), vector_text(p.velocity))});
  for (const auto& h : elements(s.handles))
    rows.push_back({fmt::format("handle {}", text(h.name)),
                    fmt::format("{} N, {} N.m", vector_text(h.force), vector_text(h.torque))});
  for (const std::string& warning : wire::strings(s.warnings)) rows.push_back({"warning", warning});
  return format_rows(rows);
}

std::string status_line(const flexcast_Status& s) {
  return fmt::format("{:<8}  step {:>9}  {:>10.4f} s  real-time factor {:>7.3f}  frames {:>9}  skipped {}\n",
                     name_of(s.state), s.report.step, s.report.time, s.real_time_factor, s.frames_published,
                     s.frames_skipped);
}

}  // namespace flexcast::ctl
