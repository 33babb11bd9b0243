#include "core/lab/report_text.h"

#include <cstdarg>
#include <cstdio>

namespace flexcast {
namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string line(const char* label, const std::string& text) {
  return format("  %-11s ", label) + text + "\n";
}

std::string vector_text(const Vec3& v) {
  return format("(%.6g, %.6g, %.6g)", v.x(), v.y(), v.z());
}

// "gravity -1.2 J, ..." for those that are not zero.
std::string energy_text(const StepReport& report) {
  const std::pair<const char*, double> energies[] = {{"kinetic", report.kinetic},    {"elastic", report.elastic},
                                                     {"gravity", report.gravity},    {"contact", report.contact},
                                                     {"work", report.work},          {"dissipated", report.dissipated},
                                                     {"numerical", report.numerical}};
  std::string text;
  for (const auto& [name, value] : energies)
    if (value != 0.0) text += format("%s%s %.6g J", text.empty() ? "" : ", ", name, value);
  return text.empty() ? "none" : text;
}

std::string body_text(const BodyReport& body, bool fem) {
  std::string text = format("%lld particles, %lld %s", static_cast<long long>(body.particles),
                            static_cast<long long>(body.elements), fem ? "tetrahedra" : "springs");
  if (body.min_j) text += format(", smallest J %.4g", *body.min_j);
  if (body.inverted > 0) text += format(", %lld inverted", static_cast<long long>(body.inverted));
  return text + ", centre of mass " + vector_text(body.center_of_mass) + " m";
}

std::string solver_text(const StepStatistics& statistics) {
  return format("%d iterations (%d linear) in the last step, residual %.3g%s", statistics.iterations,
                statistics.linear_iterations, statistics.residual, statistics.converged ? "" : ", not converged");
}

std::string speed_text(const Run& run, double time) {
  if (run.steps == 0 || run.wall_seconds <= 0.0) return "the initial state";
  return format("%.6g s simulated in %.4g s: %.3g x real time, %.4g ms a step", time, run.wall_seconds,
                time / run.wall_seconds, 1e3 * run.wall_seconds / static_cast<double>(run.steps));
}

std::string probe_text(const Probe& probe, const Simulation& simulation) {
  const std::int64_t node = probe.particle - find_body(simulation.model(), probe.body)->particles.first;
  return format("%s, node %lld: at ", probe.body.c_str(), static_cast<long long>(node)) +
         vector_text(block3(simulation.state().positions, probe.particle)) + " m, velocity " +
         vector_text(block3(simulation.state().velocities, probe.particle)) + " m/s";
}

}  // namespace

std::string make_report_text(const Run& run) {
  const Simulation& simulation = *run.scene.simulation;
  const TimeSettings& time = simulation.settings().time;
  const StepReport report = simulation.calc_report();
  std::string text = format("%s: %s, %lld steps of %.6g s with %s", run.scene.name.c_str(), run.state.c_str(),
                            static_cast<long long>(run.steps), time.step, time.integrator.c_str());
  if (simulation.has_contract() && run.steps > 0) {
    text += format(", %.4g substeps each on average, %d at last",
                   static_cast<double>(run.substeps) / static_cast<double>(run.steps), report.statistics.substeps);
  } else if (time.substeps > 1) {
    text += format(", %d substeps each", time.substeps);
  }
  text += "\n";
  text += line("time", speed_text(run, report.time));
  for (const BodyReport& body : simulation.calc_body_reports())
    text += line(body.name.c_str(), body_text(body, find_body(simulation.model(), body.name)->is_fem()));
  text += line("energy", energy_text(report));
  text += line("momentum",
               vector_text(report.momentum) + " kg.m/s, angular " + vector_text(report.angular_momentum) + " kg.m^2/s");
  if (report.statistics.iterations > 0) text += line("solver", solver_text(report.statistics));
  if (report.error_estimate) text += line("error", format("about %.4g m RMS in the last step", *report.error_estimate));
  if (report.stability_margin)
    text += line("stability", format("margin %.4g (stable step / step)", *report.stability_margin));
  for (const HandleReport& handle : simulation.calc_handle_reports())
    text += line(handle.name.c_str(),
                 "force " + vector_text(handle.force) + " N, torque " + vector_text(handle.torque) + " N.m");
  for (const Probe& probe : simulation.probes()) text += line(probe.name.c_str(), probe_text(probe, simulation));
  text += line("state hash", format("%016llx", static_cast<unsigned long long>(simulation.calc_state_hash())));
  return text;
}

}  // namespace flexcast
