#include "core/materials/linear.h"

#include "core/materials/small_strain.h"

namespace flexcast {
namespace {

Mat3 calc_strain(const Mat3& F) {
  return 0.5 * (F + F.transpose()) - Mat3::Identity();
}

void calc_energy(Lame lame, std::span<const Mat3> F, std::span<double> Psi) {
  for (std::size_t i = 0; i < F.size(); ++i) Psi[i] = calc_hooke_energy(lame, calc_strain(F[i]));
}

void calc_stress(Lame lame, std::span<const Mat3> F, std::span<Mat3> P) {
  for (std::size_t i = 0; i < F.size(); ++i) P[i] = calc_hooke_stress(lame, calc_strain(F[i]));
}

void calc_tangent(Lame lame, Tangent, std::span<const Mat3> F, std::span<Mat9> dPdF) {
  Mat9 constant;
  for (int l = 0; l < 3; ++l) {
    for (int k = 0; k < 3; ++k) {
      const Mat3 unit = Vec3::Unit(k) * Vec3::Unit(l).transpose();
      const Mat3 column = calc_hooke_stress(lame, 0.5 * (unit + unit.transpose()));
      constant.col(k + 3 * l) = column.reshaped();
    }
  }
  for (std::size_t i = 0; i < F.size(); ++i) dPdF[i] = constant;
}

}  // namespace

const Law linear_law{"linear",         "small strain, no rotations", true, calc_energy, calc_stress, calc_tangent,
                     LawKernel::linear};

}  // namespace flexcast
