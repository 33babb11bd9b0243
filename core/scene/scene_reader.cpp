#include "core/scene/scene_reader.h"

#include <algorithm>

#include "core/scene/body_reader.h"
#include "core/scene/contact_reader.h"
#include "core/scene/keys.h"
#include "core/scene/parameter_keys.h"
#include "core/scene/suggestion.h"
#include "core/scene/value_text.h"

namespace flexcast {
namespace {

using enum ParameterRow::Scope;

TimeSettings read_time(const TableReader& reader) {
  TimeSettings time;
  time.step = read_parameter(reader, scene, "step", time.step);
  time.integrator = read_parameter(reader, scene, "integrator", time.integrator);
  time.substeps = read_parameter(reader, scene, "substeps", time.substeps);
  time.tolerance = read_parameter(reader, scene, "tolerance", time.tolerance);
  time.budget = read_parameter(reader, scene, "budget", time.budget);
  time.error_estimate = read_parameter(reader, scene, "error_estimate", time.error_estimate);
  if (time.tolerance > 0.0 && time.budget > 0.0)
    reader.refuse_value("budget",
                        "excludes time.tolerance = " + number_text(time.tolerance) + "; one of them must be 0");
  time.duration = reader.number("duration", {ranges::positive, "s"});
  constexpr double most_steps = 1e15;  // so that step numbers are exact in a double
  if (time.duration && *time.duration / time.step > most_steps)
    reader.refuse_value("duration",
                        "is more than " + number_text(most_steps) + " steps of time.step = " + number_text(time.step));
  return time;
}

SolverSettings read_solver(const TableReader& reader) {
  SolverSettings solver;
  solver.linear = read_parameter(reader, scene, "linear", solver.linear);
  solver.linear_tolerance = read_parameter(reader, scene, "linear_tolerance", solver.linear_tolerance);
  solver.newton_iterations = read_parameter(reader, scene, "newton_iterations", solver.newton_iterations);
  solver.newton_tolerance = read_parameter(reader, scene, "newton_tolerance", solver.newton_tolerance);
  solver.iterations = read_parameter(reader, scene, "iterations", solver.iterations);
  return solver;
}

StreamSettings read_stream(const TableReader& reader) {
  StreamSettings stream;
  stream.fields = reader.choices("fields", {"positions", "velocities", "stretch", "stress"}).value_or(stream.fields);
  stream.precision = read_parameter(reader, scene, "precision", stream.precision);
  stream.every = read_parameter(reader, scene, "every", stream.every);
  return stream;
}

// A spring has a tension but no area.
void check_stress(const TableReader& reader, const StreamSettings& stream, const std::vector<BodyDescription>& bodies) {
  const bool wanted = std::find(stream.fields.begin(), stream.fields.end(), "stress") != stream.fields.end();
  const bool has_tetrahedra = std::any_of(bodies.begin(), bodies.end(), [](const auto& body) { return body.law; });
  if (wanted && !has_tetrahedra)
    reader.refuse_value("fields", "has \"stress\", which only tetrahedra have; expected a [[body]] of model \"fem\"");
}

void check_new_name(const std::string& name, const Place& place, const std::vector<std::string_view>& others) {
  if (std::find(others.begin(), others.end(), name) != others.end())
    refuse_owner(place, "name = \"" + name + "\" is there twice; names must differ");
}

std::vector<BodyDescription> read_bodies(const TableReader& top) {
  std::vector<BodyDescription> bodies;
  std::vector<std::string_view> names;
  const std::vector<TableEntry> entries = top.tables("body");
  if (entries.empty()) refuse_owner(top.place(), "a scene needs a [[body]]; there is none");
  bodies.reserve(entries.size());  // the names point into it
  for (const TableEntry& entry : entries) {
    BodyDescription body = read_body(entry, bodies.size() + 1);
    check_new_name(body.name, body.place, names);
    names.push_back(bodies.emplace_back(std::move(body)).name);
  }
  return bodies;
}

// Handles are named apart from their body: handle.NAME.translate.
void check_handle_names(const std::vector<BodyDescription>& bodies) {
  std::vector<std::string_view> names;
  for (const BodyDescription& body : bodies) {
    for (const HandleDescription& handle : body.handles) {
      if (std::find(names.begin(), names.end(), handle.name) != names.end())
        refuse(handle.place, "= \"" + handle.name + "\" is there twice; the handles of a scene must differ in name");
      names.push_back(handle.name);
    }
  }
}

std::vector<Obstacle> read_contacts(const TableReader& top) {
  std::vector<Obstacle> obstacles;
  for (const TableEntry& entry : top.tables("contact")) {
    const Place place{entry.place.source, "[[contact]] " + owner_name(entry, obstacles.size() + 1), ""};
    Obstacle obstacle = read_contact({entry.table, place});
    std::vector<std::string_view> names;
    for (const Obstacle& other : obstacles) names.push_back(other.name);
    check_new_name(obstacle.name, place, names);
    obstacles.push_back(std::move(obstacle));
  }
  return obstacles;
}

ProbeDescription read_probe(const TableEntry& entry, std::size_t number, const std::vector<std::string_view>& bodies) {
  Place place{entry.place.source, "[[probe]] " + owner_name(entry, number), ""};
  const TableReader reader({entry.table, place}, {"name", "body", "at", "node"});
  ProbeDescription probe;
  probe.place = place;
  probe.name = reader.require_name("name");
  probe.body = reader.require_choice("body", bodies);
  probe.at = reader.vector("at", {ranges::any, "m"});
  probe.node = reader.integer("node", {ranges::non_negative, ""});
  if (!probe.at && !probe.node) refuse_owner(place, "missing key at or node; expected one of them");
  if (probe.at && probe.node) refuse_owner(place, "has both at and node; expected one of them");
  return probe;
}

std::vector<ProbeDescription> read_probes(const TableReader& top, const std::vector<BodyDescription>& bodies) {
  std::vector<std::string_view> body_names, names;
  for (const BodyDescription& body : bodies) body_names.push_back(body.name);
  std::vector<ProbeDescription> probes;
  const std::vector<TableEntry> entries = top.tables("probe");
  probes.reserve(entries.size());
  for (const TableEntry& entry : entries) {
    ProbeDescription probe = read_probe(entry, probes.size() + 1, body_names);
    check_new_name(probe.name, probe.place, names);
    names.push_back(probes.emplace_back(std::move(probe)).name);
  }
  return probes;
}

}  // namespace

SceneDescription read_scene(const toml::table& document) {
  const TableReader top({&document, {source_text(document, "scene"), "", ""}}, scene_keys());
  SceneDescription description;
  description.name = top.require_name("name");
  description.description = top.text("description").value_or("");
  description.exact = top.choice("exact", exact_names()).value_or("");
  description.gravity = read_parameter(top, scene, "gravity", description.gravity);
  if (const auto time = top.table("time"))
    description.settings.time =
        read_time({*time, {"step", "integrator", "substeps", "tolerance", "budget", "error_estimate", "duration"}});
  if (const auto solver = top.table("solver"))
    description.settings.solver =
        read_solver({*solver, {"linear", "linear_tolerance", "newton_iterations", "newton_tolerance", "iterations"}});
  description.bodies = read_bodies(top);
  if (const auto stream = top.table("stream")) {
    const TableReader reader(*stream, {"fields", "precision", "every"});
    description.settings.stream = read_stream(reader);
    check_stress(reader, description.settings.stream, description.bodies);
  }
  check_handle_names(description.bodies);
  description.obstacles = read_contacts(top);
  description.probes = read_probes(top, description.bodies);
  return description;
}

}  // namespace flexcast
