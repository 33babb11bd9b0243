#include "core/lab/limits/limit_variations.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

// 10^lo ... 10^hi.
std::vector<double> make_powers(double lo, double hi, int points) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i) values.push_back(std::pow(10.0, lo + (hi - lo) * i / std::max(points - 1, 1)));
  return values;
}

double same(double value) {
  return value;
}

Variation vary_stiffness(int points) {
  const auto change = [](Model model, double factor) {
    for (Body& body : model.bodies) {
      body.young *= factor;
      body.stiffness *= factor;
    }
    return model;
  };
  return {"stiffness", "stiffness over the scene's", "stiffness", true, make_powers(-2, 4, points), change, same};
}

// Of tetrahedra Kelvin-Voigt's time; of springs k_d over k_s, which is the same thing.
Variation vary_damping(int points, double fastest) {
  const auto change = [](Model model, double time) {
    for (Body& body : model.bodies) {
      body.stiffness_damping = time;
      body.damping = time * body.stiffness;
    }
    return model;
  };
  std::vector<double> values = {0.0};
  for (const double value : make_powers(-2, 2, std::max(points - 1, 1))) values.push_back(value / fastest);
  return {"damping", "damping time (s)", "damping", true, values, change, same};
}

// The free particle nearest to the middle of the list.
Result<Variation> vary_mass(const Model& model, int points) {
  const std::int64_t count = model.particle_count();
  std::int64_t chosen = -1;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto* fixed = &model.fixed[static_cast<std::size_t>(3 * i)];
    if (fixed[0] + fixed[1] + fixed[2] == 3) continue;
    if (chosen < 0 || std::abs(2 * i - count) < std::abs(2 * chosen - count)) chosen = i;
  }
  if (chosen < 0) return Error{"mass_ratio: the scene has no free particle"};
  const auto change = [chosen](Model changed, double ratio) {
    for (Body& body : changed.bodies) {
      if (chosen >= body.particles.first && chosen < body.particles.end())
        body.mass_overrides.push_back({static_cast<std::int32_t>(chosen), ratio * changed.masses[chosen]});
    }
    return changed;
  };
  return Variation{
      "mass_ratio", "mass of one particle over the scene's", "that mass", true, make_powers(-3, 3, points), change,
      same};
}

Result<Variation> vary_poisson(const Model& model, int points) {
  if (std::none_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) { return body.is_fem(); }))
    return Error{"poisson: the scene has no body of tetrahedra (model = \"fem\")"};
  const auto change = [](Model changed, double poisson) {
    for (Body& body : changed.bodies) body.poisson = poisson;
    return changed;
  };
  std::vector<double> values;
  for (const double part : make_powers(0.0, std::log10(0.002), points)) values.push_back(0.5 - 0.5 * part);
  return Variation{"poisson", "Poisson's ratio", "(1 - 2 poisson)", false, values, change, [](double poisson) {
                     return 1.0 - 2.0 * poisson;
                   }};
}

// The whole rest shape is squeezed along the last axis along which it has an extent.
Result<Variation> vary_quality(const Model& model, int points) {
  const Eigen::Map<const Eigen::Matrix3Xd> rest(model.rest_positions.data(), 3, model.particle_count());
  const Vec3 extents = rest.rowwise().maxCoeff() - rest.rowwise().minCoeff();
  int axis = -1, axes = 0;
  for (int i = 0; i < 3; ++i) {
    if (extents[i] <= 1e-9 * extents.maxCoeff()) continue;
    axis = i;
    ++axes;
  }
  if (axes < 2) return Error{"quality: the scene extends along one axis only, so its cells have no shape"};
  const auto change = [axis](Model changed, double factor) {
    for (std::int64_t i = 0; i < changed.particle_count(); ++i) changed.rest_positions[3 * i + axis] /= factor;
    return changed;
  };
  return Variation{"quality", "squeeze of the cells", "squeeze", true, make_powers(0, 2, points), change, same};
}

}  // namespace

std::vector<std::string> variation_names() {
  return {"stiffness", "damping", "mass_ratio", "poisson", "quality"};
}

Result<Variation> make_variation(std::string_view name, const Model& model, int points, double fastest) {
  if (model.tetrahedra.empty() && model.springs.empty())
    return Error{std::string(name) + ": the scene has no elements"};
  if (name == "stiffness") return vary_stiffness(points);
  if (name == "damping") {
    if (!(fastest > 0.0) || !std::isfinite(fastest)) return Error{"damping: nothing in the scene vibrates"};
    return vary_damping(points, fastest);
  }
  if (name == "mass_ratio") return vary_mass(model, points);
  if (name == "poisson") return vary_poisson(model, points);
  FLEXCAST_CHECK(name == "quality");
  return vary_quality(model, points);
}

}  // namespace flexcast
