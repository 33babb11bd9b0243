// The loops over the elements of a patch (patches.h), in lanes: forces, energies, damping and stiffness of linear and
// quadratic tetrahedra. Equations: tetrahedra.h, element_shape.h, kelvin_voigt.h and the laws' own files.
#pragma once

#include <cstdint>

#include "core/materials/law.h"

namespace flexcast {

// Batches of eight lanes of one patch.
struct ElementBatches {
  std::int32_t count = 0;
  bool quadratic = false;
  const std::uint16_t* places = nullptr;  // [batch][node][lane], of nodes in the patch's vectors
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
// f += forces at x.
void add_patch_forces(const ElementBatches& elements, const ElementLaw& law, const double* x, double* f);
// The energy at x, J.
double calc_patch_energy(const ElementBatches& elements, const ElementLaw& law, const double* x);
// f += damping forces at x, v; the power they take, W.
double add_patch_damping(const ElementBatches& elements, const ElementLaw& law, const double* x, const double* v,
                         double* f);

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

// Whether add_patch_stiffness knows that kind of tangent.
bool has_stiffness_in_lanes(const Law& law, Tangent kind);
// Adds scale times the stiffness of the elements to 3 x 3 blocks of a matrix, column by column at values + 9
// entries[k]: entries are [batch][node a][node b][lane].
void add_patch_stiffness(const ElementBatches& elements, const ElementLaw& law, Tangent kind, double scale,
                         const double* x, const std::int32_t* entries, double* values);
// The same of damping.
void add_patch_damping_matrix(const ElementBatches& elements, const ElementLaw& law, double scale, const double* x,
                              const std::int32_t* entries, double* values);

}  // namespace flexcast
