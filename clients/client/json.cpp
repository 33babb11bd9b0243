#include "clients/client/json.h"

namespace flexcast::client {

Json to_json(const Value& value) {
  return std::visit([](const auto& content) { return Json(content); }, value);
}

Json to_json(const flexcast_StepReport& r) {
  return {{"step", r.step},
          {"time", r.time},
          {"kinetic", r.kinetic},
          {"elastic", r.elastic},
          {"gravity", r.gravity},
          {"contact", r.contact},
          {"work", r.work},
          {"dissipated", r.dissipated},
          {"numerical", r.numerical},
          {"momentum", r.momentum},
          {"angular_momentum", r.angular_momentum},
          {"residual", r.residual},
          {"iterations", r.iterations},
          {"linear_iterations", r.linear_iterations},
          {"converged", r.converged},
          {"error_estimate", r.error_estimate},
          {"stability_margin", r.stability_margin},
          {"inverted", r.inverted},
          {"min_j", r.min_j},
          {"wall_seconds", r.wall_seconds},
          {"substeps", r.substeps}};
}

}  // namespace flexcast::client
