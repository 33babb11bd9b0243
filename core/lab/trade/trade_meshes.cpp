#include "core/lab/trade/trade_meshes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/lab/bench/bench_loops.h"

namespace flexcast {
namespace {

// A mesh at rest.
struct Rest {
  VecX positions;                // m, 3 n
  std::vector<std::int32_t> of;  // number of the body, one a particle
};

Rest make_rest(const Model& model) {
  Rest rest{model.rest_positions, std::vector<std::int32_t>(static_cast<std::size_t>(model.particle_count()))};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const IndexRange range = model.bodies[b].particles;
    std::fill_n(rest.of.begin() + range.first, range.count, static_cast<std::int32_t>(b));
  }
  return rest;
}

// Its particles by where they are.
class RestPlaces {
 public:
  RestPlaces(const Rest& rest, double size) : rest_(rest), cell_(1e-6 * size) {
    for (std::int64_t i = 0; i < rest.positions.size() / 3; ++i)
      places_.emplace(calc_key(block3(rest.positions, i), {0, 0, 0}), i);
  }

  // That of the same body in the same place as a particle of another mesh; -1: there is none.
  std::int64_t find(const Rest& other, std::int64_t particle) const {
    const Vec3 at = block3(other.positions, particle);
    const std::int32_t body = other.of[static_cast<std::size_t>(particle)];
    for (int i = 0; i < 27; ++i) {
      const auto [first, last] = places_.equal_range(calc_key(at, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}));
      for (auto place = first; place != last; ++place) {
        const bool near = (block3(rest_.positions, place->second) - at).norm() <= 0.1 * cell_;
        if (near && rest_.of[static_cast<std::size_t>(place->second)] == body) return place->second;
      }
    }
    return -1;
  }

 private:
  std::uint64_t calc_key(const Vec3& at, const std::array<int, 3>& shift) const {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cell = static_cast<std::int64_t>(std::floor(at[static_cast<Eigen::Index>(axis)] / cell_));
      key = key * 0x9E3779B97F4A7C15ull + static_cast<std::uint64_t>(cell + shift[axis]);
    }
    return key;
  }

  const Rest& rest_;
  double cell_;
  std::unordered_multimap<std::uint64_t, std::int64_t> places_;
};

double calc_size(const VecX& rest) {
  const Eigen::Map<const Eigen::Matrix3Xd> x(rest.data(), 3, rest.size() / 3);
  return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
}

Error make_refusal(int refinement, const SceneMesh& mesh, const std::string& reason) {
  return {"--refine " + std::to_string(refinement) + ": body \"" + mesh.body + "\" " + reason};
}

// PATH=VALUE that multiplies the body's cells, nothing for none.
Result<std::string> make_finer_cells(const SceneMesh& mesh, int refinement) {
  if (!mesh.file.empty())
    return make_refusal(refinement, mesh,
                        "is read from the file \"" + mesh.file + "\", which has no cells to multiply (allowed: 0)");
  if (mesh.names_nodes)
    return make_refusal(refinement, mesh,
                        "selects nodes by number, which would be others in a finer mesh; select by box or sphere");
  std::string text = mesh.body + ".mesh.cells=[";
  for (std::size_t i = 0; i < mesh.cells.size(); ++i)
    text += (i > 0 ? "," : "") + std::to_string(mesh.cells[i] << refinement);
  return text + "]";
}

Result<TradeMesh> make_mesh(const Scene& base, const std::string& element, int refinement) {
  TradeMesh mesh{element, refinement, element, {}, 0, 0, {}};
  bool any_fem = false;
  for (const SceneMesh& of : base.meshes) {
    if (!element.empty() && of.fem) mesh.overrides.push_back(of.body + ".element=" + element);
    any_fem = any_fem || of.fem;
    if (refinement == 0) continue;
    auto finer = make_finer_cells(of, refinement);
    if (!finer) return finer.error();
    mesh.overrides.push_back(std::move(finer).value());
  }
  if (!element.empty() && !any_fem)
    return Error{"--elements " + element + ": the scene has no body of tetrahedra (model = \"fem\")"};
  if (refinement > 0) mesh.name += (mesh.name.empty() ? "" : ", ") + ("refined " + std::to_string(refinement));
  return mesh;
}

Result<Rest> load_rest(const TradeOptions& options, TradeMesh& mesh) {
  std::vector<std::string> overrides = options.overrides;
  overrides.insert(overrides.end(), mesh.overrides.begin(), mesh.overrides.end());
  const auto scene = load_scene(options.scene, overrides);
  if (!scene) return scene.error();
  const Model& model = scene.value().simulation->model();
  mesh.particles = model.particle_count();
  mesh.elements = count_elements(model);
  return make_rest(model);
}

// Those of the coarsest mesh that are in all; the coarsest one's own numbers in order.
void match_particles(const std::vector<Rest>& rests, std::size_t coarsest, std::vector<TradeMesh>& meshes) {
  const Rest& base = rests[coarsest];
  std::vector<RestPlaces> places;
  for (const Rest& rest : rests) places.emplace_back(rest, calc_size(base.positions));
  std::vector<std::int64_t> found(meshes.size());
  for (std::int64_t i = 0; i < base.positions.size() / 3; ++i) {
    for (std::size_t m = 0; m < meshes.size(); ++m) found[m] = m == coarsest ? i : places[m].find(base, i);
    if (std::ranges::find(found, -1) != found.end()) continue;
    for (std::size_t m = 0; m < meshes.size(); ++m) meshes[m].compared.push_back(found[m]);
  }
}

void match_probes(const Scene& scene, const Rest& rest, const std::vector<std::int64_t>& compared,
                  TradeMeshes& meshes) {
  const Rest own = make_rest(scene.simulation->model());
  const RestPlaces places(rest, calc_size(rest.positions));
  for (const Probe& probe : scene.simulation->probes()) {
    const bool same = own.positions.size() == rest.positions.size();
    const std::int64_t particle = same ? probe.particle : places.find(own, probe.particle);
    const auto found = std::ranges::find(compared, particle);
    if (found == compared.end()) continue;
    meshes.probes.push_back(found - compared.begin());
    meshes.probe_names.push_back(probe.name);
  }
}

template <class T>
std::vector<T> or_one(std::vector<T> values, T value) {
  if (values.empty()) values.push_back(value);
  std::vector<T> unique;
  for (const T& one : values)
    if (std::ranges::find(unique, one) == unique.end()) unique.push_back(one);
  return unique;
}

}  // namespace

Result<TradeMeshes> make_trade_meshes(const TradeOptions& options, const Scene& base) {
  TradeMeshes meshes;
  std::vector<Rest> rests;
  for (const std::string& element : or_one(options.elements, std::string())) {
    for (int refinement : or_one(options.refinements, 0)) {
      auto mesh = make_mesh(base, element, refinement);
      if (!mesh) return mesh.error();
      auto rest = load_rest(options, mesh.value());
      if (!rest) return rest.error();
      meshes.all.push_back(std::move(mesh).value());
      rests.push_back(std::move(rest).value());
    }
  }
  const auto coarsest = std::ranges::min_element(meshes.all, {}, &TradeMesh::particles) - meshes.all.begin();
  meshes.finest =
      static_cast<std::size_t>(std::ranges::max_element(meshes.all, {}, &TradeMesh::particles) - meshes.all.begin());
  meshes.base_particles = meshes.all[static_cast<std::size_t>(coarsest)].particles;
  if (meshes.all.size() == 1) meshes.all.front().name.clear();
  match_particles(rests, static_cast<std::size_t>(coarsest), meshes.all);
  if (meshes.all.front().compared.empty()) return Error{"the meshes have no particle in common: nothing to compare"};
  match_probes(base, rests[static_cast<std::size_t>(coarsest)], meshes.all[static_cast<std::size_t>(coarsest)].compared,
               meshes);
  return meshes;
}

}  // namespace flexcast
