// LinearMotion: a body near a state, q'' = -K q - D q' in coordinates in which all masses are 1.
#pragma once

#include <vector>

#include "core/forces/system.h"

namespace flexcast {

// Its coordinates are the body's free degrees of freedom times the roots of their masses. There are no matrices: D by
// the forces at the state, K by their differences.
class LinearMotion {
 public:
  // Keeps references to all. Forces of the whole scene (contact, grabs) are left out.
  LinearMotion(const System& system, const Model& model, const Body& body, const VecX& x);

  Eigen::Index size() const { return static_cast<Eigen::Index>(free_.size()); }
  // y += scale K q, 1/s^2
  void add_stiffness(double scale, const VecX& q, VecX& y);
  // y += scale D q, 1/s
  void add_damping(double scale, const VecX& q, VecX& y);

 private:
  void move(const VecX& q);
  void calc_force(double step, VecX& f);

  const VecX& x_;
  std::vector<const Force*> forces_;
  std::vector<Eigen::Index> free_;  // of the degrees of freedom of the scene
  VecX roots_;                      // kg^-1/2, of the free ones
  double length_ = 0.0;             // m, of the body
  VecX moved_, at_, forward_, backward_;
};

// The largest eigenvalue of of_damping D + of_stiffness K: in that direction no mode lies further out in the plane of
// (q.D q, q.K q), q.q = 1. Lanczos iteration; it approaches the eigenvalue from below, so the residual of the Ritz pair
// is added. Source: B. N. Parlett, The Symmetric Eigenvalue Problem, SIAM 1998, chapter 13.
double calc_farthest_mode(LinearMotion& motion, double of_damping, double of_stiffness);

// All lambda, 1/s, of q'' = -K q - D q', but those that are 0: the rigid motions. Dense and dear, so that bodies of
// more than 120 free degrees of freedom get none.
using VecXc = Eigen::VectorXcd;
VecXc calc_eigenvalues(LinearMotion& motion);

}  // namespace flexcast
