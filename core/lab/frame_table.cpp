#include "core/lab/frame_table.h"

#include <ostream>

#include "core/lab/output_file.h"

namespace flexcast {
namespace {

void add_vector(std::ostream& out, const Vec3& vector) {
  for (double component : vector) out << ',' << exact_text(component);
}

}  // namespace

FrameTable::FrameTable(std::ostream& out, const Simulation& simulation) : out_(out) {
  out_ << "step,time,kinetic,elastic,gravity,contact,work,dissipated,numerical,residual,iterations,inverted,min_j,"
          "substeps,"
          "error_estimate";
  for (const char* vector : {"momentum", "angular_momentum"})
    for (const char* axis : {"x", "y", "z"}) out_ << ',' << vector << '.' << axis;
  for (const Probe& probe : simulation.probes())
    for (const char* component : {"x", "y", "z", "vx", "vy", "vz"}) out_ << ',' << probe.name << '.' << component;
  out_ << '\n';
}

void FrameTable::add(const Simulation& simulation) {
  const StepReport report = simulation.calc_report();
  out_ << report.step << ',' << exact_text(report.time);
  for (double number : {report.kinetic, report.elastic, report.gravity, report.contact, report.work, report.dissipated,
                        report.numerical, report.statistics.residual})
    out_ << ',' << exact_text(number);
  out_ << ',' << report.statistics.iterations << ',' << report.inverted << ',';
  if (report.min_j) out_ << exact_text(*report.min_j);
  out_ << ',' << report.statistics.substeps << ',';
  if (report.error_estimate) out_ << exact_text(*report.error_estimate);
  add_vector(out_, report.momentum);
  add_vector(out_, report.angular_momentum);
  for (const Probe& probe : simulation.probes()) {
    add_vector(out_, block3(simulation.state().positions, probe.particle));
    add_vector(out_, block3(simulation.state().velocities, probe.particle));
  }
  out_ << '\n';
}

}  // namespace flexcast
