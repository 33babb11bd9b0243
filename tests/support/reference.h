// The reference values under tests/reference/data.
#pragma once

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "core/base/math.h"

namespace flexcast::test {

using Json = nlohmann::json;

inline Json load_reference(const std::string& file) {
  const std::string path = std::string(FLEXCAST_SOURCE_DIR) + "/tests/reference/data/" + file;
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error("cannot read " + path);
  return Json::parse(stream);
}

inline Vec3 to_vector(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

// A list of rows.
inline Eigen::MatrixXd to_matrix(const Json& json) {
  const auto rows = static_cast<Eigen::Index>(json.size());
  const auto columns = static_cast<Eigen::Index>(json[0].size());
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      matrix(i, j) = json[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>();
    }
  }
  return matrix;
}

// A list of points, one after the other.
inline VecX to_flat(const Json& json) {
  return to_matrix(json).transpose().reshaped();
}

template <class A, class B>
double calc_max_error(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace flexcast::test
