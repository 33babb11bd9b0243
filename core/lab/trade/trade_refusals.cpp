#include "core/lab/trade/trade_refusals.h"

namespace flexcast {

std::string find_damping(const Model& model) {
  for (const Body& body : model.bodies) {
    const std::string has = "body \"" + body.name + "\" has ";
    if (body.drag > 0.0) return has + "drag";
    if (body.mass_damping > 0.0 || body.stiffness_damping > 0.0 || body.damping > 0.0) return has + "damping";
  }
  return "";
}

std::string find_guidance(const Model& model) {
  if (!model.obstacles.empty()) return "the scene has the obstacle \"" + model.obstacles.front().name + "\"";
  if (!model.handles.empty()) return "the scene has the handle \"" + model.handles.front().name + "\"";
  return model.grabs.empty() ? "" : "a particle is grabbed";
}

}  // namespace flexcast
