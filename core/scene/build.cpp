#include "core/scene/build.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "core/mesh/quadratic.h"
#include "core/mesh/surface_load.h"
#include "core/scene/body_reader.h"
#include "core/scene/mesh_section.h"
#include "core/scene/placement.h"
#include "core/scene/selectors.h"
#include "core/scene/value_text.h"

namespace flexcast {
namespace {

template <class Element>
IndexRange append(const std::vector<Element>& elements, std::int32_t first_particle, std::vector<Element>& all) {
  const IndexRange range{static_cast<std::int32_t>(all.size()), static_cast<std::int32_t>(elements.size())};
  for (Element element : elements) {
    for (std::int32_t& node : element) node += first_particle;
    all.push_back(element);
  }
  return range;
}

// The opposite for a body's part of all.
template <class Element>
std::vector<Element> make_local(const std::vector<Element>& all, IndexRange range, std::int32_t first_particle) {
  std::vector<Element> elements(all.begin() + range.first, all.begin() + range.end());
  for (Element& element : elements)
    for (std::int32_t& node : element) node -= first_particle;
  return elements;
}

VecX flatten(const std::vector<Vec3>& vectors) {
  VecX flat(3 * static_cast<Eigen::Index>(vectors.size()));
  for (std::size_t i = 0; i < vectors.size(); ++i) block3(flat, static_cast<std::int64_t>(i)) = vectors[i];
  return flat;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(bytes).str();
}

class Builder {
 public:
  Builder(const SceneDescription& description, const FilePlaces& files) : description_(description), files_(files) {}

  BuiltScene build() {
    built_.model.gravity = description_.gravity;
    built_.model.obstacles = description_.obstacles;
    for (const BodyDescription& body : description_.bodies) add_body(body);
    start_at_rest();
    for (std::size_t i = 0; i < description_.bodies.size(); ++i) {
      apply_entries(description_.bodies[i], built_.model.bodies[i]);
      add_handles(description_.bodies[i], i);
    }
    hold_still();
    check();
    for (const ProbeDescription& probe : description_.probes) add_probe(probe);
    return std::move(built_);
  }

 private:
  void add_body(const BodyDescription& description) {
    MeshFile file = make_mesh(description.mesh, description.law != nullptr, files_);
    Mesh& mesh = file.mesh;
    place_mesh(description, mesh);
    const auto midsides = description.quadratic ? make_quadratic(mesh) : std::vector<Midsides>{};
    if (static_cast<double>(rest_.size() + mesh.nodes.size()) > most_particles)
      refuse_owner(description.place, "the scene has more than " + count_text(most_particles) + " particles");

    Model& model = built_.model;
    const auto first = static_cast<std::int32_t>(rest_.size());
    Body body = make_body(description, mesh.nodes.size());
    body.particles = {first, static_cast<std::int32_t>(mesh.nodes.size())};
    body.tetrahedra = append(mesh.tetrahedra, first, model.tetrahedra);
    body.midsides = append(midsides, first, model.midsides);
    body.springs = append(mesh.springs, first, model.springs);
    body.triangles = append(mesh.triangles, first, model.triangles);
    rest_.insert(rest_.end(), mesh.nodes.begin(), mesh.nodes.end());
    model.bodies.push_back(std::move(body));
    for (const std::string& repair : file.repairs)
      built_.notes.push_back("body \"" + description.name + "\": " + repair);
    for (const std::filesystem::path& path : file.files) attach(description.mesh, path);
  }

  static Body make_body(const BodyDescription& description, std::size_t particles) {
    Body body;
    body.name = description.name;
    body.law = description.law;
    body.young = description.young;
    body.poisson = description.poisson;
    body.density = description.density;
    body.stiffness_damping = description.damping_stiffness;
    body.stiffness = description.spring_stiffness;
    body.damping = description.spring_damping;
    const double share = description.total_mass.value_or(0.0) / static_cast<double>(particles);
    body.particle_mass = description.mass.value_or(share);
    body.mass_damping = description.damping_mass;
    body.drag = description.drag;
    return body;
  }

  // Under the name the scene uses; the other half of a pair stands beside it.
  void attach(const MeshDescription& mesh, const std::filesystem::path& path) {
    const std::string name = (std::filesystem::path(mesh.file).parent_path() / path.filename()).string();
    const bool there = std::ranges::find(built_.files, name, &SceneAttachment::name) != built_.files.end();
    if (!there) built_.files.push_back({name, read_bytes(path)});
  }

  void start_at_rest() {
    built_.model.rest_positions = flatten(rest_);
    built_.state.positions = built_.model.rest_positions;
    built_.state.velocities = VecX::Zero(built_.state.positions.size());
    built_.model.fixed.assign(3 * rest_.size(), 0);
  }

  void apply_entries(const BodyDescription& description, Body& body) {
    const auto selected = [&](const Selector& selector) { return select_of(body, selector); };
    for (const MassDescription& mass : description.particle_masses)
      for (std::int32_t i : selected(mass.select)) body.mass_overrides.push_back({i, mass.value});
    for (const PinDescription& pin : description.pins)
      for (std::int32_t i : selected(pin.select))
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (pin.axes[axis]) built_.model.fixed[3 * static_cast<std::size_t>(i) + axis] = 1;
    for (const VectorDescription& displacement : description.displacements)
      for (std::int32_t i : selected(displacement.select)) block3(built_.state.positions, i) += displacement.value;
    for (const VelocityDescription& velocity : description.velocities)
      for (std::int32_t i : selected(velocity.select)) {
        const Vec3 arm = block3(built_.state.positions, i) - velocity.about;
        block3(built_.state.velocities, i) += velocity.value + velocity.spin.cross(arm);
      }
    for (const VectorDescription& force : description.forces)
      for (std::int32_t i : selected(force.select)) block3(external_forces(), i) += force.value;
    for (const VectorDescription& force : description.surface_forces) add_surface_force(force, body);
  }

  std::vector<std::int32_t> select_of(const Body& body, const Selector& selector) const {
    const Model& model = built_.model;
    const auto part = [](const auto& all, IndexRange range) {
      return std::span(all).subspan(static_cast<std::size_t>(range.first), static_cast<std::size_t>(range.count));
    };
    return select(selector, rest_, body.particles, part(model.tetrahedra, body.tetrahedra),
                  part(model.midsides, body.midsides));
  }

  VecX& external_forces() {
    VecX& forces = built_.model.external_forces;
    if (forces.size() == 0) forces = VecX::Zero(built_.state.positions.size());
    return forces;
  }

  void add_surface_force(const VectorDescription& load, const Body& body) {
    const IndexRange range = body.particles;
    std::vector<std::uint8_t> selected(static_cast<std::size_t>(range.count), 0);
    for (std::int32_t i : select_of(body, load.select)) selected[static_cast<std::size_t>(i - range.first)] = 1;
    const std::vector<Vec3> nodes(rest_.begin() + range.first, rest_.begin() + range.end());
    std::vector<Vec3> forces(nodes.size(), Vec3::Zero());
    const double area =
        spread_surface_force(selected, nodes, make_local(built_.model.tetrahedra, body.tetrahedra, range.first),
                             make_local(built_.model.midsides, body.midsides, range.first), load.value, forces);
    if (area == 0.0) refuse(load.select.place, "selects no whole face of the body's surface, which the force needs");
    for (std::int32_t i = 0; i < range.count; ++i)
      block3(external_forces(), range.first + i) += forces[static_cast<std::size_t>(i)];
  }

  void add_handles(const BodyDescription& description, std::size_t body) {
    for (const HandleDescription& entry : description.handles) {
      Handle handle;
      handle.name = entry.name;
      handle.body = static_cast<std::int32_t>(body);
      handle.particles = select_of(built_.model.bodies[body], entry.select);
      for (std::int32_t i : handle.particles) {
        claim(i, built_.model.bodies[body], entry);
        handle.base.push_back(block3(built_.state.positions, i));
      }
      handle.about = entry.about.value_or(calc_centroid(handle.particles));
      if (!handle.about.allFinite())
        refuse(entry.select.place, "selects particles whose centroid is not finite; give about");
      handle.translate = entry.translate;
      handle.rotate = entry.rotate;
      handle.start = entry.start;
      handle.duration = entry.duration;
      built_.model.handles.push_back(std::move(handle));
    }
  }

  // Two prescriptions for one particle would contradict each other.
  void claim(std::int32_t particle, const Body& body, const HandleDescription& handle) {
    const auto first_axis = built_.model.fixed.begin() + 3 * static_cast<std::ptrdiff_t>(particle);
    const std::string which = "selects particle " + std::to_string(particle - body.particles.first) + ", which ";
    if (std::any_of(first_axis, first_axis + 3, [](std::uint8_t fixed) { return fixed != 0; }))
      refuse(handle.select.place, which + "is pinned; a particle has pins or a handle, not both");
    const auto [owner, is_new] = handle_of_.emplace(particle, handle.name);
    if (!is_new)
      refuse(handle.select.place, which + "handle \"" + owner->second + "\" moves; a particle has at most one handle");
  }

  Vec3 calc_centroid(const std::vector<std::int32_t>& particles) const {
    Vec3 sum = Vec3::Zero();
    for (std::int32_t i : particles) sum += rest_[static_cast<std::size_t>(i)];
    return sum / static_cast<double>(particles.size());
  }

  // Where the motion is prescribed, initial velocities do not count.
  void hold_still() {
    for (std::size_t i = 0; i < built_.model.fixed.size(); ++i)
      if (built_.model.fixed[i]) built_.state.velocities[static_cast<Eigen::Index>(i)] = 0.0;
    for (const Handle& handle : built_.model.handles)
      for (std::int32_t i : handle.particles) block3(built_.state.velocities, i).setZero();
  }

  // What single values in range can still add or multiply up to.
  void check() {
    Model& model = built_.model;
    update_masses(model);
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const Place& place = description_.bodies[i].place;
      const IndexRange range = model.bodies[i].particles;
      const auto finite = [&](const VecX& v) { return v.segment(3 * range.first, 3 * range.count).allFinite(); };
      constexpr double largest = 1e38;  // m: single precision ends there
      if (!(built_.model.rest_positions.segment(3 * range.first, 3 * range.count).cwiseAbs().maxCoeff() <= largest) ||
          !(built_.state.positions.segment(3 * range.first, 3 * range.count).cwiseAbs().maxCoeff() <= largest))
        refuse_owner(place, "has positions beyond 1e38 m, where single precision ends");
      if (!finite(built_.state.positions)) refuse_owner(place, "displacement gives positions that are not finite");
      if (!finite(built_.state.velocities)) refuse_owner(place, "velocity gives velocities that are not finite");
      if (model.external_forces.size() > 0 && !finite(model.external_forces))
        refuse_owner(place, "force or surface_force gives forces that are not finite");
      for (std::int32_t p = range.first; p < range.end(); ++p)
        if (!ranges::positive.contains(model.masses[p]))
          refuse_owner(place, "particle " + std::to_string(p - range.first) + " has the mass " +
                                  number_text(model.masses[p]) + " kg in double precision; expected > 0");
    }
  }

  void add_probe(const ProbeDescription& probe) {
    const Body& body = *find_body(built_.model, probe.body);
    const IndexRange range = body.particles;
    if (!probe.node) {
      built_.probes.push_back({probe.name, probe.body, find_nearest(*probe.at, range)});
      return;
    }
    if (*probe.node >= range.count)
      refuse_owner(probe.place, "node = " + std::to_string(*probe.node) + " is out of range (allowed: 0 to " +
                                    std::to_string(range.count - 1) + ")");
    built_.probes.push_back({probe.name, probe.body, range.first + static_cast<std::int32_t>(*probe.node)});
  }

  std::int32_t find_nearest(const Vec3& at, IndexRange range) const {
    std::int32_t nearest = range.first;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::int32_t i = range.first; i < range.end(); ++i) {
      const double distance = (rest_[static_cast<std::size_t>(i)] - at).stableNorm();
      if (distance >= smallest) continue;
      smallest = distance;
      nearest = i;
    }
    return nearest;
  }

  const SceneDescription& description_;
  const FilePlaces& files_;
  std::vector<Vec3> rest_;
  std::unordered_map<std::int32_t, std::string> handle_of_;  // by particle
  BuiltScene built_;
};

}  // namespace

BuiltScene build_scene(const SceneDescription& description, const FilePlaces& files) {
  return Builder(description, files).build();
}

}  // namespace flexcast
