#include "core/lab/bench/bench_loops.h"

#include <Eigen/LU>
#include <cstring>

#include "core/base/parallel.h"
#include "core/forces/element_shape.h"
#include "core/forces/spring.h"

namespace flexcast {
namespace {

template <class Shape>
class PlainTetrahedra final : public PlainLoop {
 public:
  PlainTetrahedra(const Model& model, const Body& body) : body_(body) {
    for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) elements_.push_back(make_element(model, body, t));
  }

  void add_force(const VecX& x, VecX& f) const override {
    const Lame lame = calc_lame(body_.young, body_.poisson);
    for (const Element& e : elements_) {
      const Vec3 x0 = block3(x, e.nodes[0]);
      Edges edges;
      for (int a = 1; a < Shape::nodes; ++a) edges.col(a - 1) = block3(x, e.nodes[static_cast<std::size_t>(a)]) - x0;
      Edges forces = Edges::Zero();
      for (const Gradients& gradients : e.gradients) {
        const Mat3 F = edges * gradients;
        Mat3 P;
        body_.law->calc_stress(lame, {&F, 1}, {&P, 1});
        forces -= e.weight * P * gradients.transpose();
      }
      block3(f, e.nodes[0]) -= forces.rowwise().sum();
      for (int a = 1; a < Shape::nodes; ++a) block3(f, e.nodes[static_cast<std::size_t>(a)]) += forces.col(a - 1);
    }
  }

 private:
  using Gradients = typename Shape::Slopes;
  using Edges = Eigen::Matrix<double, 3, Shape::nodes - 1>;
  struct Element {
    std::array<std::int32_t, Shape::nodes> nodes;
    std::array<Gradients, Shape::points> gradients;  // 1/m, of the shape functions but the first
    double weight;                                   // m^3 a quadrature point
  };

  static Element make_element(const Model& model, const Body& body, std::int32_t t) {
    Element e;
    const Tetrahedron& corners = model.tetrahedra[static_cast<std::size_t>(body.tetrahedra.first + t)];
    std::copy(corners.begin(), corners.end(), e.nodes.begin());
    if constexpr (Shape::nodes == 10) {
      const Midsides& midsides = model.midsides[static_cast<std::size_t>(body.midsides.first + t)];
      std::copy(midsides.begin(), midsides.end(), e.nodes.begin() + 4);
    }
    Mat3 edges;
    for (int a = 0; a < 3; ++a) {
      edges.col(a) = block3(model.rest_positions, corners[static_cast<std::size_t>(a + 1)]) -
                     block3(model.rest_positions, corners[0]);
    }
    for (int q = 0; q < Shape::points; ++q) {
      e.gradients[static_cast<std::size_t>(q)] = Shape::calc_slopes(q) * edges.inverse();
    }
    e.weight = edges.determinant() / 6.0 / Shape::points;
    return e;
  }

  const Body& body_;
  std::vector<Element> elements_;
};

class PlainSprings final : public PlainLoop {
 public:
  PlainSprings(const Model& model, const Body& body) : body_(body) {
    for (std::int32_t s = body.springs.first; s < body.springs.end(); ++s) {
      const auto [p, q] = model.springs[static_cast<std::size_t>(s)];
      elements_.push_back({p, q, (block3(model.rest_positions, q) - block3(model.rest_positions, p)).norm()});
    }
  }

  void add_force(const VecX& x, VecX& f) const override {
    for (const Element& e : elements_) {
      const Vec3 force = calc_spring_force(block3(x, e.q) - block3(x, e.p), Vec3::Zero(), e.r, body_.stiffness, 0.0);
      block3(f, e.p) += force;
      block3(f, e.q) -= force;
    }
  }

 private:
  struct Element {
    std::int32_t p, q;
    double r;  // m
  };
  const Body& body_;
  std::vector<Element> elements_;
};

}  // namespace

std::vector<std::unique_ptr<PlainLoop>> make_plain_loops(const Model& model) {
  std::vector<std::unique_ptr<PlainLoop>> loops;
  for (const Body& body : model.bodies) {
    if (!body.is_fem()) {
      loops.push_back(std::make_unique<PlainSprings>(model, body));
    } else if (body.is_quadratic()) {
      loops.push_back(std::make_unique<PlainTetrahedra<QuadraticShape>>(model, body));
    } else {
      loops.push_back(std::make_unique<PlainTetrahedra<LinearShape>>(model, body));
    }
  }
  return loops;
}

std::int64_t calc_touched_bytes(const Model& model) {
  constexpr std::int64_t index = sizeof(std::int32_t), number = sizeof(double);
  std::int64_t bytes = model.particle_count() * 6 * number;
  for (const Body& body : model.bodies) {
    bytes += std::int64_t{body.tetrahedra.count} * ((body.is_quadratic() ? 10 : 4) * index + 10 * number);
    bytes += std::int64_t{body.springs.count} * (2 * index + number);
  }
  return bytes;
}

std::int64_t count_elements(const Model& model) {
  std::int64_t count = 0;
  for (const Body& body : model.bodies) count += body.tetrahedra.count + body.springs.count;
  return count;
}

Copy::Copy(std::int64_t bytes) : from_(static_cast<std::size_t>(bytes), 1), to_(from_.size()) {}

void Copy::run() {
  constexpr std::int64_t grain = 1 << 16;
  parallel_for(static_cast<std::int64_t>(to_.size()), grain, [&](std::int64_t first, std::int64_t end) {
    std::memcpy(to_.data() + first, from_.data() + first, static_cast<std::size_t>(end - first));
  });
  asm volatile("" : : "r"(to_.data()) : "memory");  // the copy is not to be left out
}

}  // namespace flexcast
