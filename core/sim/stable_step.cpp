#include "core/sim/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/integrators/linear_motion.h"
#include "core/sim/largest_mode.h"
#include "core/sim/mode_region.h"

namespace flexcast {
namespace {

using Point = Eigen::Vector2d;  // damping rate (1/s), omega^2 (1/s^2)

constexpr int most_cuts = 3;

// 1/s, of drag and mass-proportional damping over the free particles of a body.
struct DragRange {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
};

DragRange calc_drag_range(const System& system, const Body& body) {
  DragRange range;
  for (Eigen::Index i = 3 * body.particles.first; i < 3 * Eigen::Index{body.particles.end()}; ++i) {
    if (system.inverse_masses()[i] == 0.0) continue;
    const double rate = body.mass_damping + body.drag * system.inverse_masses()[i];
    range.least = std::min(range.least, rate);
    range.most = std::max(range.most, rate);
  }
  return range.least <= range.most ? range : DragRange{0.0, 0.0};
}

// s: damping over stiffness inside a body.
double calc_damping_time(const Body& body) {
  if (body.is_fem()) return body.stiffness_damping;
  return body.stiffness > 0.0 ? body.damping / body.stiffness : 0.0;
}

class BodyLimit {
 public:
  BodyLimit(const System& system, const Model& model, const Body& body, const VecX& x, const IntegratorRow& row)
      : system_(system), model_(model), body_(body), x_(x), row_(row), motion_(system, model, body, x) {}

  double calc(const LargestMode& mode) {
    outside_ = mode.omega_squared - mode.elastic;
    ModeRegion region = make_region(mode.elastic);
    Worst worst = find_worst(region);
    if (is_enough_ || worst.limit == 0.0 || !std::isfinite(worst.limit)) return worst.limit;
    for (int i = 0; i < most_cuts && worst.limit > 0.0; ++i) {
      const Point normal = calc_descent(worst);
      region.cut(normal, calc_farthest_mode(motion_, normal[0], normal[1]));
      const Worst next = find_worst(region);
      const bool helped = next.limit > 1.005 * worst.limit;
      worst = next;
      if (!helped) break;
    }
    const bool is_known = outside_ > 0.0 || row_.calc_coupled_stable_step == nullptr;
    return is_known ? worst.limit : row_.calc_coupled_stable_step(motion_, worst.limit);
  }

 private:
  struct Worst {
    double limit = std::numeric_limits<double>::infinity();  // s
    Point corner = Point::Zero();
  };

  ModeRegion make_region(double stiffness) {
    const bool at_rest = x_ == model_.rest_positions;
    const DragRange drag = calc_drag_range(system_, body_);
    const double time = calc_damping_time(body_), most = drag.most + time * stiffness;
    if (at_rest && (time > 0.0 || body_.damping == 0.0)) {
      is_enough_ = drag.most - drag.least <= 1e-9 * most;  // the set is a straight line
      if (is_enough_) return ModeRegion({{drag.least, 0.0}, {most, stiffness}});
      ModeRegion region(most, stiffness);
      region.cut({1.0, -time}, drag.most);
      region.cut({-1.0, time}, (1e-12 - 1.0) * drag.least);
      return region;
    }
    // Away from rest, which is looked at again and again, the box has to do; inside it a bent body is like one at rest.
    is_enough_ = true;
    const double damping = std::max(drag.least, calc_farthest_mode(motion_, 1.0, 0.0));
    ModeRegion region(damping, stiffness);
    const double least_time = stiffness > 0.0 ? std::min(time, (damping - drag.least) / stiffness) : 0.0;
    region.cut({-1.0, least_time}, -drag.least);
    return region;
  }

  double calc_limit(double damping, double omega_squared) const {
    constexpr double fastest = 1e150;  // 1/s: squares of more are no numbers
    const double omega = std::sqrt(omega_squared);
    if (omega == 0.0 && damping == 0.0) return std::numeric_limits<double>::infinity();
    if (!(omega < fastest && damping < fastest)) return 0.0;
    return row_.calc_stable_step(omega, damping);
  }

  // The stable (h d, h^2 k) of a scheme form a convex set, or nearly so: a polygon is in it when its corners are.
  Worst find_worst(const ModeRegion& region) const {
    Worst worst;
    for (const Point& corner : region.corners()) {
      const double d = std::max(corner[0], 0.0), k = std::max(corner[1], 0.0);
      for (const double more : {0.0, outside_}) {
        const double limit = calc_limit(d, k + more);
        if (limit < worst.limit) worst = {limit, {d, k}};
        if (outside_ == 0.0) break;
      }
    }
    return worst;
  }

  // Where the limit falls fastest, in units in which both sides of the region are alike.
  Point calc_descent(const Worst& worst) const {
    const double h = worst.limit, d = worst.corner[0], k = worst.corner[1] + outside_;
    constexpr double part = 1e-6;
    const double by_damping = (h - calc_limit(d + part / h, k)) / (part / h);
    const double by_stiffness = (h - calc_limit(d, k + part / (h * h))) / (part / (h * h));
    return {by_damping, by_stiffness};
  }

  const System& system_;
  const Model& model_;
  const Body& body_;
  const VecX& x_;
  const IntegratorRow& row_;
  LinearMotion motion_;
  double outside_ = 0.0;    // 1/s^2, omega^2 of what touches and pulls
  bool is_enough_ = false;  // the region, without cuts
};

}  // namespace

double calc_stable_step(const System& system, const Model& model, const VecX& x, const IntegratorRow& row) {
  double limit = std::numeric_limits<double>::infinity();
  const std::vector<LargestMode> modes = calc_largest_modes(system, model, x);
  for (std::size_t b = 0; b < modes.size(); ++b) {
    limit = std::min(limit, BodyLimit(system, model, model.bodies[b], x, row).calc(modes[b]));
  }
  return limit;
}

}  // namespace flexcast
