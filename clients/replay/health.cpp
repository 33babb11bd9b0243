#include "clients/replay/health.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "idl/wire/decode.h"

namespace flexcast::replay {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

flexcast_StepReport make_unknown_report(const Shown& shown) {
  flexcast_StepReport report{};
  report.step = shown.step;
  report.time = shown.time;
  report.converged = true;  // nothing says that it did not
  for (double* number :
       {&report.kinetic, &report.elastic, &report.gravity, &report.contact, &report.work, &report.dissipated,
        &report.numerical, &report.residual, &report.error_estimate, &report.stability_margin, &report.min_j}) {
    *number = unknown;
  }
  std::fill(std::begin(report.momentum), std::end(report.momentum), unknown);
  std::fill(std::begin(report.angular_momentum), std::end(report.angular_momentum), unknown);
  return report;
}

void blank(flexcast_Status& status, const Shown& shown) {
  status.report = make_unknown_report(shown);
  status.parameter_revision = shown.parameter_revision;
  status.topology_revision = shown.topology_revision;
  for (flexcast_ProbeState& probe : wire::elements(status.probes)) {
    std::fill(std::begin(probe.position), std::end(probe.position), unknown);
    std::fill(std::begin(probe.velocity), std::end(probe.velocity), unknown);
  }
  for (flexcast_HandleState& handle : wire::elements(status.handles)) {
    std::fill(std::begin(handle.force), std::end(handle.force), unknown);
    std::fill(std::begin(handle.torque), std::end(handle.torque), unknown);
  }
}

}  // namespace

wire::Owned<flexcast_Status> Health::make(const Shown& shown, const OwnState& own, const Stamp& stamp,
                                          bool as_it_came) const {
  wire::Owned<flexcast_Status> status;
  auto recorded = wire::decode<flexcast_Status>(recorded_);
  const bool known = recorded && restamp(*recorded.value(), stamp) && recorded.value()->run_id == shown.run_id;
  if (known) status = std::move(recorded).value();
  if (!known || !(as_it_came || status->report.step == shown.step)) blank(*status, shown);
  if (!known) wire::set_string(status->version, FLEXCAST_VERSION);
  wire::set_string(status->world, stamp.world);
  status->run_id = shown.run_id;
  status->state = own.state;
  status->heartbeat = own.heartbeat;
  status->server_id = own.server_id;
  status->rate = own.rate;
  status->frames_published = own.frames_published;
  status->readers = own.readers;
  if (own.state != flexcast_WORLD_RUNNING) status->real_time_factor = 0.0;
  return status;
}

}  // namespace flexcast::replay
