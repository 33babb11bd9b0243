// Fields to colour a body with, one number a particle, computed when they are asked for.
//
// Stretch: of tetrahedra the largest principal stretch minus 1 (the largest singular value of the deformation
// gradient), averaged over the particle's elements by their rest volume; of springs l / r - 1, the mean over the
// particle's springs. 0 at rest, 0.1 where the longest direction is a tenth longer.
//
// Stress: von Mises' equivalent of the elastic Cauchy stress P F^T / |det F| in Pa, sqrt(3/2 s : s) with the deviator s
// (R. von Mises, Nachr. Ges. Wiss. Goettingen, 1913), averaged in the same way; of laws that measure small strains in
// the fixed frame, which know no difference, P itself. A spring has a tension but no area, hence no stress: its
// particles have 0, and so has what belongs to no element. Damping is left out.
#pragma once

#include <vector>

#include "core/forces/model.h"

namespace flexcast {

// Values are finite and at most largest_magnitude, also where an element is flat. The same bits for any number of
// threads.
class ParticleFields {
 public:
  // Keeps a reference to the model, and follows its parameters.
  explicit ParticleFields(const Model& model);

  void calc_stretch(const VecX& positions, VecX& stretch);  // 1, n
  void calc_stress(const VecX& positions, VecX& stress);    // Pa, n

 private:
  template <class Measure>
  void add_tetrahedra(const Body& body, const VecX& positions, Measure measure, VecX& field);
  template <class Shape, class Measure>
  void add_elements(const Body& body, const VecX& positions, Measure measure, VecX& field);
  void add_springs(const Body& body, const VecX& positions, VecX& field);
  void finish(VecX& field) const;

  const Model& model_;
  VecX weights_;                // of the elements around a particle: m^3, or the number of its springs
  std::vector<double> values_;  // of the elements of a body, times their weights
};

}  // namespace flexcast
