// What the limits of a scene are measured against: one quantity of it at a time, over decades.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/forces/model.h"

namespace flexcast {

struct Variation {
  std::string name;         // "stiffness"
  std::string title;        // of an axis: "Young's modulus over the scene's"
  std::string measure;      // what powers of the limit refer to: "stiffness", "(1 - 2 poisson)"
  bool logarithmic = true;  // of an axis
  std::vector<double> values;
  // The model at a value, from the scene's.
  std::function<Model(const Model&, double)> change;
  std::function<double(double)> calc_measure;  // of a value, for powers
};

// stiffness, damping, mass_ratio, poisson, quality.
std::vector<std::string> variation_names();

// With about as many values. Errors: a quantity that the scene cannot have, in one sentence. `fastest`: 1/s, of the
// scene without damping.
Result<Variation> make_variation(std::string_view name, const Model& model, int points, double fastest);

}  // namespace flexcast
