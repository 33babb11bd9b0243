#include "core/lab/report_json.h"

#include <cstdio>

namespace flexcast {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json to_json(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json to_json(const StepReport& report) {
  return {{"kinetic", report.kinetic},
          {"elastic", report.elastic},
          {"gravity", report.gravity},
          {"contact", report.contact},
          {"work", report.work},
          {"dissipated", report.dissipated},
          {"momentum", to_json(report.momentum)},
          {"angular_momentum", to_json(report.angular_momentum)},
          {"residual", report.statistics.residual},
          {"iterations", report.statistics.iterations},
          {"linear_iterations", report.statistics.linear_iterations},
          {"converged", report.statistics.converged},
          {"numerical", report.numerical},
          {"error_estimate", to_json(report.error_estimate)},
          {"substeps", report.statistics.substeps},
          {"stability_margin", to_json(report.stability_margin)},
          {"inverted", report.inverted},
          {"min_j", to_json(report.min_j)}};
}

Json to_json(const Probe& probe, const Simulation& simulation) {
  const Body& body = *find_body(simulation.model(), probe.body);
  return {{"body", probe.body},
          {"node", probe.particle - body.particles.first},
          {"rest", to_json(Vec3(block3(simulation.model().rest_positions, probe.particle)))},
          {"position", to_json(Vec3(block3(simulation.state().positions, probe.particle)))},
          {"velocity", to_json(Vec3(block3(simulation.state().velocities, probe.particle)))}};
}

Json to_json(const BodyReport& body) {
  return {{"particles", body.particles},
          {"elements", body.elements},
          {"min_j", to_json(body.min_j)},
          {"inverted", body.inverted},
          {"center_of_mass", to_json(body.center_of_mass)}};
}

Json index_json(std::int64_t index) {
  return index < 0 ? Json(nullptr) : Json(index);
}

Json to_json(const Failure& failure) {
  return {{"cause", failure.cause},
          {"body", failure.body.empty() ? Json(nullptr) : Json(failure.body)},
          {"element", index_json(failure.element)},
          {"particle", index_json(failure.particle)},
          {"position", to_json(failure.position)},
          {"step", failure.step},
          {"suggestion", failure.suggestion}};
}

}  // namespace

nlohmann::ordered_json make_report_json(const Run& run) {
  const Simulation& simulation = *run.scene.simulation;
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(simulation.calc_state_hash()));
  Json probes = Json::object(), bodies = Json::object(), handles = Json::object();
  for (const Probe& probe : simulation.probes()) probes[probe.name] = to_json(probe, simulation);
  for (const BodyReport& body : simulation.calc_body_reports()) bodies[body.name] = to_json(body);
  for (const HandleReport& handle : simulation.calc_handle_reports()) {
    handles[handle.name] = {{"force", to_json(handle.force)}, {"torque", to_json(handle.torque)}};
  }
  Json json = {{"scene", run.scene.name},
               {"integrator", simulation.settings().time.integrator},
               {"state", run.state},
               {"steps", run.steps},
               {"substeps", run.substeps},
               {"time", simulation.state().time},
               {"wall_seconds", run.wall_seconds},
               {"report", to_json(simulation.calc_report())},
               {"probes", std::move(probes)},
               {"handles", std::move(handles)},
               {"bodies", std::move(bodies)},
               {"state_hash", hash},
               {"warnings", run.warnings}};
  if (simulation.failure()) json["failure"] = to_json(*simulation.failure());
  return json;
}

}  // namespace flexcast
