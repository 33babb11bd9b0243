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
      const double quarter = body.density * a.dot(b.cross(c)) / 24.0;
      for (const std::int32_t node : nodes) model.masses[node] += quarter;
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
