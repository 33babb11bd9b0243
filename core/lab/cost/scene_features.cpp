#include "core/lab/cost/scene_features.h"

#include <algorithm>

namespace flexcast {
namespace {

// A thing that bodies have: left out of all of them at once.
struct BodyFeature {
  const char* name;
  bool (*is_there)(const BodyDescription&);
  void (*leave_out)(BodyDescription&);
};

constexpr BodyFeature body_features[] = {
    {"damping.mass", [](const BodyDescription& b) { return b.damping_mass > 0.0; },
     [](BodyDescription& b) { b.damping_mass = 0.0; }},
    {"damping.stiffness", [](const BodyDescription& b) { return b.damping_stiffness > 0.0; },
     [](BodyDescription& b) { b.damping_stiffness = 0.0; }},
    {"springs.damping", [](const BodyDescription& b) { return b.spring_damping > 0.0; },
     [](BodyDescription& b) { b.spring_damping = 0.0; }},
    {"drag", [](const BodyDescription& b) { return b.drag > 0.0; }, [](BodyDescription& b) { b.drag = 0.0; }},
    {"force", [](const BodyDescription& b) { return !b.forces.empty(); }, [](BodyDescription& b) { b.forces.clear(); }},
    {"surface_force", [](const BodyDescription& b) { return !b.surface_forces.empty(); },
     [](BodyDescription& b) { b.surface_forces.clear(); }},
};

void add_body_features(const SceneDescription& description, std::vector<SceneFeature>& features) {
  for (const BodyFeature& feature : body_features) {
    if (!std::any_of(description.bodies.begin(), description.bodies.end(), feature.is_there)) continue;
    features.push_back({feature.name, [leave_out = feature.leave_out](SceneDescription& scene) {
                          for (BodyDescription& body : scene.bodies) leave_out(body);
                        }});
  }
}

void add_obstacles(const SceneDescription& description, std::vector<SceneFeature>& features) {
  for (std::size_t i = 0; i < description.obstacles.size(); ++i) {
    const Obstacle& obstacle = description.obstacles[i];
    features.push_back({"contact " + obstacle.name, [i](SceneDescription& scene) {
                          scene.obstacles.erase(scene.obstacles.begin() + static_cast<std::ptrdiff_t>(i));
                        }});
    if (obstacle.friction > 0.0)
      features.push_back(
          {"friction of " + obstacle.name, [i](SceneDescription& scene) { scene.obstacles[i].friction = 0.0; }});
  }
}

void add_handles(const SceneDescription& description, std::vector<SceneFeature>& features) {
  for (std::size_t b = 0; b < description.bodies.size(); ++b) {
    const auto& handles = description.bodies[b].handles;
    for (std::size_t i = 0; i < handles.size(); ++i) {
      features.push_back({"handle " + handles[i].name, [b, i](SceneDescription& scene) {
                            auto& mine = scene.bodies[b].handles;
                            mine.erase(mine.begin() + static_cast<std::ptrdiff_t>(i));
                          }});
    }
  }
}

// With its probes.
void leave_out_body(SceneDescription& scene, const std::string& name) {
  std::erase_if(scene.bodies, [&](const BodyDescription& body) { return body.name == name; });
  std::erase_if(scene.probes, [&](const ProbeDescription& probe) { return probe.body == name; });
}

}  // namespace

std::vector<SceneFeature> list_features(const SceneDescription& description) {
  std::vector<SceneFeature> features;
  if (!description.gravity.isZero(0.0))
    features.push_back({"gravity", [](SceneDescription& scene) { scene.gravity.setZero(); }});
  add_body_features(description, features);
  add_obstacles(description, features);
  add_handles(description, features);
  if (description.bodies.size() > 1) {
    for (const BodyDescription& body : description.bodies) {
      features.push_back(
          {"body " + body.name, [name = body.name](SceneDescription& scene) { leave_out_body(scene, name); }});
    }
  }
  return features;
}

}  // namespace flexcast
