// The loops over the elements of a patch (patches.h), in lanes: forces, energies, damping and stiffness of linear and
// quadratic tetrahedra. Equations: tetrahedra.h, element_shape.h, kelvin_voigt.h and the laws' own files.
#pragma once

#include <cstdint>

#include "core/forces/matrix_gather.h"
#include "core/materials/law.h"

namespace flexcast {

// Batches of eight lanes of one patch.
struct ElementBatches {
  std::int32_t count = 0;
  bool quadratic = false;
  const std::uint16_t* places = nullptr;  // [batch][node][lane], where nodes' vectors begin in the patch's
  const double* inverse_edges = nullptr;  // 1/m, [batch][9][lane], column by column [X1-X0, X2-X0, X3-X0]^-1
  const double* weights = nullptr;        // m^3, [batch][lane], the rest volume of a quadrature point; 0: no element
};

// A body's law with the values in force.
struct ElementLaw {
  const Law* law = nullptr;
  Lame lame;          // Pa
  Lame viscosity;     // Pa.s
  bool small_strain;  // of the damping
};

// Patch vectors: four doubles a particle, x, y, z and 0.
// Minus the forces at x, as rows [batch][node][lane][4].
void calc_patch_forces(const ElementBatches& elements, const ElementLaw& law, const double* x, double* rows);
// The energy at x, J.
double calc_patch_energy(const ElementBatches& elements, const ElementLaw& law, const double* x);
// Minus the damping forces at x, v, as rows; the power they take, W.
double calc_patch_damping(const ElementBatches& elements, const ElementLaw& law, const double* x, const double* v,
                          double* rows);

// One sweep of position-based dynamics over the elements: see sweep_constraints in tetrahedra.cpp. All of positions
// start, displacements u from there and inverse masses are patch vectors; lambda is [batch][lane].
struct PatchSweep {
  double h = 0.0;        // s
  double damping = 0.0;  // s, Kelvin-Voigt
  const double* start = nullptr;
  const double* inverse_masses = nullptr;
  double* lambda = nullptr;
  double* u = nullptr;
};
void sweep_patch_constraints(const ElementBatches& elements, const ElementLaw& law, const PatchSweep& sweep);

// Whether calc_patch_stiffness knows that kind of tangent.
bool has_stiffness_in_lanes(const Law& law, Tangent kind);
// scale times the stiffness of the elements, a row of matrix_gather.h for every pair of nodes a <= b.
void calc_patch_stiffness(const ElementBatches& elements, const ElementLaw& law, Tangent kind, double scale,
                          const double* x, const BlockRows9& rows);
// The same of damping.
void calc_patch_damping_matrix(const ElementBatches& elements, const ElementLaw& law, double scale, const double* x,
                               const BlockRows9& rows);

}  // namespace flexcast
