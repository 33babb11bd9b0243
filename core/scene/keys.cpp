#include "core/scene/keys.h"

namespace flexcast {

std::vector<std::string_view> scene_keys() {
  return {"name", "description", "gravity", "time", "solver", "body", "contact", "probe", "stream", "exact"};
}

std::vector<std::string_view> body_keys() {
  return {"name",     "model",        "mesh",          "element",       "material", "springs",  "mass",
          "drag",     "total_mass",   "particle_mass", "damping",       "origin",   "rotation", "pin",
          "velocity", "displacement", "force",         "surface_force", "handle"};
}

std::vector<std::string_view> contact_keys() {
  return {"name", "shape", "friction", "stiffness", "point", "normal", "center", "radius", "lo", "hi"};
}

std::vector<std::string_view> exact_names() {
  return {"free_flight", "linear_modes"};
}

}  // namespace flexcast
