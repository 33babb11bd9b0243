#include "core/forces/model.h"

namespace flexcast {

void update_masses(Model& model) {
  model.masses = VecX::Zero(model.particle_count());
  for (const Body& body : model.bodies) {
    if (!body.is_fem())
      model.masses.segment(body.particles.first, body.particles.count).setConstant(body.particle_mass);
    for (std::int32_t t = body.tetrahedra.first; t < body.tetrahedra.end(); ++t) {
      const Tetrahedron& nodes = model.tetrahedra[t];
      const Vec3 X0 = block3(model.rest_positions, nodes[0]);
      const Vec3 a = block3(model.rest_positions, nodes[1]) - X0;
      const Vec3 b = block3(model.rest_positions, nodes[2]) - X0;
      const Vec3 c = block3(model.rest_positions, nodes[3]) - X0;
      const double mass = body.density * a.dot(b.cross(c)) / 6.0;
      for (const std::int32_t node : nodes) model.masses[node] += mass / (body.is_quadratic() ? 36.0 : 4.0);
      if (!body.is_quadratic()) continue;
      const std::int32_t element = t - body.tetrahedra.first;
      for (const std::int32_t node : model.midsides[body.midsides.first + element]) {
        model.masses[node] += mass * 4.0 / 27.0;
      }
    }
    for (const ParticleMass& single : body.mass_overrides) model.masses[single.particle] = single.value;
  }
}

const Body* find_body_of_particle(const Model& model, std::int64_t particle) {
  for (const Body& body : model.bodies) {
    if (particle >= body.particles.first && particle < body.particles.end()) return &body;
  }
  return nullptr;
}

const Body* find_body(const Model& model, std::string_view name) {
  for (const Body& body : model.bodies) {
    if (body.name == name) return &body;
  }
  return nullptr;
}

}  // namespace flexcast
