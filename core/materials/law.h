// An elastic law: energy density, first Piola stress and tangent of a deformation gradient F. Each law is one pair of
// files and one row of the table. The functions take batches: one call per batch, plain loops inside.
#pragma once

#include <span>
#include <string_view>

#include "core/base/math.h"

namespace flexcast {

// Lame's parameters, Pa.
struct Lame {
  double mu = 0.0;
  double lambda = 0.0;
};

// mu = E / (2 (1 + nu)), lambda = E nu / ((1 + nu) (1 - 2 nu)); E > 0 in Pa, -1 < nu < 0.5.
Lame calc_lame(double young, double poisson);

// Which tangent a caller can use: exact ones may be indefinite away from rest.
enum class Tangent { exact, positive_semidefinite };

// The code in lanes that a law has, if any: see the files *-inl.h.
enum class LawKernel { none, linear, corotational, st_venant_kirchhoff, neo_hookean };

struct Law {
  std::string_view name;     // as in scene files
  std::string_view summary;  // one line for people
  bool small_strain;         // measures strain and its rate in the fixed frame: damping does the same
  // Psi in J/m^3.
  void (*calc_energy)(Lame lame, std::span<const Mat3> F, std::span<double> Psi);
  // P = dPsi/dF in Pa.
  void (*calc_stress)(Lame lame, std::span<const Mat3> F, std::span<Mat3> P);
  // dP/dF in Pa: entry (i + 3 j, k + 3 l) is dP_ij / dF_kl (columns of F one below the other). Symmetric.
  void (*calc_tangent)(Lame lame, Tangent kind, std::span<const Mat3> F, std::span<Mat9> dPdF);
  // The same functions in lanes, for speed; none: those above are called for every lane.
  LawKernel kernel = LawKernel::none;
};

// The table: every law, in the order of the documentation.
std::span<const Law> laws();

// nullptr when there is none of that name.
const Law* find_law(std::string_view name);

}  // namespace flexcast
