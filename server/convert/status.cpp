#include "server/convert/status.h"

#include <cmath>
#include <limits>

#include "idl/wire/fill.h"
#include "server/convert/enums.h"

namespace flexcast::server {
namespace {

constexpr const char* silence_warning =
    "the step loop has not come round for more than a second: a step, a command or a load takes long or never ends";

double finite_or_nan(double value) {
  return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}
double finite_or_nan(const std::optional<double>& value) {
  return value ? finite_or_nan(*value) : std::numeric_limits<double>::quiet_NaN();
}

void set_vector(double (&field)[3], const Vec3& vector) {
  for (int i = 0; i < 3; ++i) field[i] = finite_or_nan(vector[i]);
}

void fill_failure(const Failure& failure, flexcast_Failure& message) {
  wire::set_string(message.cause, failure.cause);
  wire::set_string(message.body, failure.body);
  message.element = static_cast<std::int32_t>(failure.element);
  message.particle = static_cast<std::int32_t>(failure.particle);
  set_vector(message.position, failure.position);
  message.step = static_cast<std::uint64_t>(failure.step);
  wire::set_string(message.suggestion, failure.suggestion);
}

}  // namespace

flexcast_StepReport to_wire(const MeasuredReport& measured) {
  const StepReport& report = measured.report;
  flexcast_StepReport message{};
  message.step = static_cast<std::uint64_t>(report.step);
  message.time = report.time;
  message.kinetic = finite_or_nan(report.kinetic);
  message.elastic = finite_or_nan(report.elastic);
  message.gravity = finite_or_nan(report.gravity);
  message.contact = finite_or_nan(report.contact);
  message.work = finite_or_nan(report.work);
  message.dissipated = finite_or_nan(report.dissipated);
  message.numerical = finite_or_nan(report.numerical);
  set_vector(message.momentum, report.momentum);
  set_vector(message.angular_momentum, report.angular_momentum);
  message.residual = finite_or_nan(report.statistics.residual);
  message.iterations = static_cast<std::uint32_t>(report.statistics.iterations);
  message.linear_iterations = static_cast<std::uint32_t>(report.statistics.linear_iterations);
  message.converged = report.statistics.converged;
  message.error_estimate = finite_or_nan(report.error_estimate);
  message.stability_margin = finite_or_nan(report.stability_margin);
  message.inverted = static_cast<std::uint32_t>(report.inverted);
  message.min_j = finite_or_nan(report.min_j);
  message.wall_seconds = measured.wall_seconds;
  message.substeps = static_cast<std::uint32_t>(report.statistics.substeps);
  return message;
}

wire::Owned<flexcast_Status> to_wire(const WorldStatus& status, const DeliveryStatus& delivery,
                                     const ServerIdentity& identity) {
  wire::Owned<flexcast_Status> message;
  wire::set_string(message->world, identity.world);
  message->run_id = status.run_id;
  message->state = to_wire(status.state);
  message->heartbeat = delivery.heartbeat;
  message->report = to_wire(status.report);
  message->real_time_factor = delivery.silent ? 0.0 : status.real_time_factor;
  message->step_seconds = status.step_seconds;
  message->rate = status.rate;
  message->frames_published = delivery.frames_published;
  message->frames_skipped = status.frames_skipped;
  message->frame_queue = delivery.frame_queue;
  message->command_queue = status.command_queue;
  message->readers = delivery.readers;
  message->parameter_revision = status.parameter_revision;
  message->topology_revision = status.topology_revision;
  message->server_id = identity.server_id;
  wire::set_string(message->version, FLEXCAST_VERSION);
  fill_failure(status.failure.value_or(Failure{}), message->trouble);
  const auto probes = wire::resize(message->probes, status.probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    wire::set_string(probes[i].name, status.probes[i].name);
    set_vector(probes[i].position, status.probes[i].position);
    set_vector(probes[i].velocity, status.probes[i].velocity);
  }
  const auto handles = wire::resize(message->handles, status.handles.size());
  for (std::size_t i = 0; i < handles.size(); ++i) {
    wire::set_string(handles[i].name, status.handles[i].name);
    set_vector(handles[i].force, status.handles[i].force);
    set_vector(handles[i].torque, status.handles[i].torque);
  }
  auto warnings = status.warnings;
  if (delivery.silent) warnings.emplace_back(silence_warning);
  wire::set_strings(message->warnings, warnings);
  const auto unpublished = wire::resize(message->unpublished, 2 * delivery.unpublished.size());
  for (std::size_t i = 0; i < delivery.unpublished.size(); ++i) {
    unpublished[2 * i] = delivery.unpublished[i].first;
    unpublished[2 * i + 1] = delivery.unpublished[i].last;
  }
  return message;
}

}  // namespace flexcast::server
