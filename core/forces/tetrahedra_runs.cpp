#include "core/forces/tetrahedra_runs.h"

#include <algorithm>
#include <cmath>

#include "core/base/aligned.h"
#include "core/forces/element.h"
#include "core/forces/element_law.h"
#include "core/forces/incidences.h"
#include "core/forces/tetrahedra_block_kernels.h"

namespace flexcast {
namespace {

template <class Shape>
class TetrahedraRuns final : public BlockRuns {
 public:
  TetrahedraRuns(const Model& model, const Body& body, const Visits& visits);

  void add(std::int32_t run, const double* x, std::span<Vec3> f, std::span<Mat3> K) const override;
  void make_positive(std::int32_t run, std::int32_t i, const double* x, Mat3& K) const override;
  void add_damping(std::int32_t run, const double* x, const double* v, double scale, std::span<Vec3> f,
                   std::span<Mat3> K) const override;

 private:
  static constexpr std::size_t points = Shape::points, nodes = Shape::nodes;
  static constexpr std::size_t lanes = BlockGroup::lanes;
  using Nodes = std::array<std::int32_t, nodes>;
  using Element = flexcast::Element<Shape>;

  // The nodes in an order where corner number `own` is the second, or midside node `own` the first of the midsides.
  static Nodes permute(const Nodes& mine, std::int32_t own);
  static std::size_t own_node(const BlockGroup& group) { return group.kind == 0 ? 1 : 4; }
  static Mat3 calc_inverse_edges(const Model& model, const Nodes& mine);
  void put(const Model& model, const Nodes& mine, double weight, const BlockGroup& group, std::int32_t k,
           std::size_t lane);
  Element element(const BlockGroup& group, std::int32_t k, std::size_t lane) const;
  void add_plain(const BlockGroup& group, std::size_t lane, const double* x, Tangent kind, double scale, Vec3& f,
                 Mat3& K) const;
  ElementRows rows() const { return {Shape::nodes == 10, nodes_.data(), rest_.data()}; }

  const Body& body_;
  BlockGroups groups_;
  AlignedVector<std::int32_t> nodes_;  // as in ElementRows
  AlignedVector<double> rest_;
};

template <class Shape>
TetrahedraRuns<Shape>::TetrahedraRuns(const Model& model, const Body& body, const Visits& visits) : body_(body) {
  struct Members {
    Nodes nodes;
  };
  std::vector<Members> elements;
  elements.reserve(static_cast<std::size_t>(body.tetrahedra.count));
  for (std::int32_t t = 0; t < body.tetrahedra.count; ++t) elements.push_back({make_nodes<Shape>(model, body, t)});
  const Incidences incidences(body.particles, elements);
  groups_ = BlockGroups(
      visits,
      [&](std::int32_t particle) {
        const auto meeting = incidences.at(particle);
        return meeting.empty() ? -1 : meeting[0].node < 4 ? 0 : 1;  // corner or midside, in all elements alike
      },
      [&](std::int32_t particle) { return incidences.at(particle).size(); });
  nodes_.resize(static_cast<std::size_t>(groups_.row_count()) * (nodes - 1) * lanes);
  rest_.resize(static_cast<std::size_t>(groups_.row_count()) * 10 * lanes);
  for (const BlockGroup& group : groups_.all()) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto meeting = incidences.at(group.particles[lane]);
      for (std::int32_t k = 0; k < group.rows; ++k) {
        const bool is_there = group.places[lane] >= 0 && static_cast<std::size_t>(k) < meeting.size();
        const auto [t, own] = meeting[is_there ? static_cast<std::size_t>(k) : 0];
        const double weight = is_there ? calc_rest_shape(model, body, t).volume / Shape::points : 0.0;
        put(model, permute(elements[static_cast<std::size_t>(t)].nodes, own), weight, group, k, lane);
      }
    }
  }
}

template <class Shape>
auto TetrahedraRuns<Shape>::permute(const Nodes& mine, std::int32_t own) -> Nodes {
  std::array<int, 4> corners;
  if (own < 4) {
    corners = {own ^ 1, own, own ^ 3, own ^ 2};
  } else {
    const auto [a, b] = local_edges[static_cast<std::size_t>(own) - 4];
    const auto [c, d] = local_edges[static_cast<std::size_t>(9 - own)];  // the opposite side
    corners = {a, b, c, d};
  }
  Nodes permuted;
  for (std::size_t a = 0; a < 4; ++a) permuted[a] = mine[static_cast<std::size_t>(corners[a])];
  for (std::size_t e = 4; e < nodes; ++e) {
    auto [a, b] = local_edges[e - 4];
    a = corners[static_cast<std::size_t>(a)], b = corners[static_cast<std::size_t>(b)];
    const auto side = std::find(local_edges.begin(), local_edges.end(), std::array{std::min(a, b), std::max(a, b)});
    permuted[e] = mine[4 + static_cast<std::size_t>(side - local_edges.begin())];
  }
  return permuted;
}

template <class Shape>
Mat3 TetrahedraRuns<Shape>::calc_inverse_edges(const Model& model, const Nodes& mine) {
  const VecX& X = model.rest_positions;
  Mat3 edges;
  for (int a = 0; a < 3; ++a) edges.col(a) = block3(X, mine[static_cast<std::size_t>(a) + 1]) - block3(X, mine[0]);
  return edges.inverse();
}

template <class Shape>
void TetrahedraRuns<Shape>::put(const Model& model, const Nodes& mine, double weight, const BlockGroup& group,
                                std::int32_t k, std::size_t lane) {
  const auto row = static_cast<std::size_t>(group.first_row + k), own = own_node(group);
  const Mat3 inverse_edges = calc_inverse_edges(model, mine);
  double* rest = rest_.data() + row * 10 * lanes + lane;
  for (std::size_t entry = 0; entry < 9; ++entry) {
    rest[entry * lanes] = inverse_edges.reshaped()[static_cast<int>(entry)];
  }
  rest[9 * lanes] = weight;
  std::int32_t* others = nodes_.data() + row * (nodes - 1) * lanes + lane;
  for (std::size_t a = 0; a < nodes; ++a) {
    if (a != own) others[(a - (a > own ? 1 : 0)) * lanes] = mine[a];
  }
}

// The element of one lane of a row, as it was put there.
template <class Shape>
auto TetrahedraRuns<Shape>::element(const BlockGroup& group, std::int32_t k, std::size_t lane) const -> Element {
  const auto row = static_cast<std::size_t>(group.first_row + k), own = own_node(group);
  const double* rest = rest_.data() + row * 10 * lanes + lane;
  const std::int32_t* others = nodes_.data() + row * (nodes - 1) * lanes + lane;
  Mat3 inverse_edges;
  for (std::size_t entry = 0; entry < 9; ++entry) {
    inverse_edges.reshaped()[static_cast<int>(entry)] = rest[entry * lanes];
  }
  Element e;
  for (std::size_t a = 0; a < nodes; ++a) {
    e.nodes[a] = a == own ? group.particles[lane] : others[(a - (a > own ? 1 : 0)) * lanes];
  }
  for (std::size_t q = 0; q < points; ++q) e.gradients[q] = Shape::calc_slopes(static_cast<int>(q)) * inverse_edges;
  e.weight = rest[9 * lanes];
  return e;
}

template <class Shape>
void TetrahedraRuns<Shape>::add_plain(const BlockGroup& group, std::size_t lane, const double* x, Tangent kind,
                                      double scale, Vec3& f, Mat3& K) const {
  const Lame lame = make_element_law(body_).lame;
  const auto at = [x](std::int32_t particle) {
    return Eigen::Map<const Vec3>(x + 4 * static_cast<std::int64_t>(particle));
  };
  std::array<Mat3, points> F, P;
  std::array<Mat9, points> C;
  for (std::int32_t k = 0; k < group.rows; ++k) {
    const Element e = element(group, k, lane);
    typename Element::Edges edges;
    for (std::size_t a = 1; a < nodes; ++a) edges.col(static_cast<int>(a) - 1) = at(e.nodes[a]) - at(e.nodes[0]);
    for (std::size_t q = 0; q < points; ++q) F[q] = edges * e.gradients[q];
    body_.law->calc_stress(lame, F, P);
    body_.law->calc_tangent(lame, kind, F, C);
    for (std::size_t q = 0; q < points; ++q) {
      const Vec3 g = e.calc_gradient(q, static_cast<std::int32_t>(own_node(group)));
      f -= e.weight * P[q] * g;
      K += scale * e.weight * contract_left(g, contract_right(C[q], g));
    }
  }
}

template <class Shape>
void TetrahedraRuns<Shape>::add(std::int32_t run, const double* x, std::span<Vec3> f, std::span<Mat3> K) const {
  const std::span<const BlockGroup> groups = groups_.run(run);
  if (body_.law->kernel != LawKernel::none) {
    add_element_blocks(rows(), groups.data(), std::ssize(groups), make_element_law(body_), x, f.data()->data(),
                       K.data()->data());
    return;
  }
  for (const BlockGroup& group : groups) {
    for (std::size_t lane = 0; lane < lanes && group.places[lane] >= 0; ++lane) {
      const auto i = static_cast<std::size_t>(group.places[lane]);
      add_plain(group, lane, x, Tangent::positive_semidefinite, 1.0, f[i], K[i]);
    }
  }
}

template <class Shape>
void TetrahedraRuns<Shape>::make_positive(std::int32_t run, std::int32_t i, const double* x, Mat3& K) const {
  const LawKernel kernel = body_.law->kernel;
  if (kernel != LawKernel::st_venant_kirchhoff && kernel != LawKernel::neo_hookean) return;
  for (const BlockGroup& group : groups_.run(run)) {
    const std::int32_t* lane = std::find(group.places, group.places + lanes, i);
    if (lane == group.places + lanes) continue;
    Vec3 unused = Vec3::Zero();
    add_plain(group, static_cast<std::size_t>(lane - group.places), x, Tangent::exact, -1.0, unused, K);
    add_plain(group, static_cast<std::size_t>(lane - group.places), x, Tangent::positive_semidefinite, 1.0, unused, K);
  }
}

template <class Shape>
void TetrahedraRuns<Shape>::add_damping(std::int32_t run, const double* x, const double* v, double scale,
                                        std::span<Vec3> f, std::span<Mat3> K) const {
  const std::span<const BlockGroup> groups = groups_.run(run);
  add_element_damping_blocks(rows(), groups.data(), std::ssize(groups), make_element_law(body_), scale, x, v,
                             f.data()->data(), K.data()->data());
}

}  // namespace

std::unique_ptr<BlockRuns> make_tetrahedra_runs(const Model& model, const Body& body, const Visits& visits) {
  if (body.is_quadratic()) return std::make_unique<TetrahedraRuns<QuadraticShape>>(model, body, visits);
  return std::make_unique<TetrahedraRuns<LinearShape>>(model, body, visits);
}

}  // namespace flexcast
