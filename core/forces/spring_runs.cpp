#include "core/forces/spring_runs.h"

#include "core/base/aligned.h"
#include "core/forces/incidences.h"
#include "core/forces/spring_block_kernels.h"

namespace flexcast {
namespace {

class SpringRuns final : public BlockRuns {
 public:
  SpringRuns(const Model& model, const Body& body, const Visits& visits);

  void add(std::int32_t run, const double* x, std::span<Vec3> f, std::span<Mat3> K) const override {
    const std::span<const BlockGroup> groups = groups_.run(run);
    add_spring_blocks(rows(), groups.data(), std::ssize(groups), body_.stiffness, x, f.data()->data(),
                      K.data()->data());
  }
  void add_damping(std::int32_t run, const double* x, const double* v, double scale, std::span<Vec3> f,
                   std::span<Mat3> K) const override {
    const std::span<const BlockGroup> groups = groups_.run(run);
    add_spring_damping_blocks(rows(), groups.data(), std::ssize(groups), body_.damping, scale, x, v, f.data()->data(),
                              K.data()->data());
  }

 private:
  SpringRows rows() const { return {others_.data(), rest_.data()}; }

  const Body& body_;
  BlockGroups groups_;
  AlignedVector<std::int32_t> others_;  // as in SpringRows
  AlignedVector<double> rest_;
};

SpringRuns::SpringRuns(const Model& model, const Body& body, const Visits& visits) : body_(body) {
  constexpr std::size_t lanes = BlockGroup::lanes;
  struct Ends {
    Spring nodes;
  };
  std::vector<Ends> springs;
  springs.reserve(static_cast<std::size_t>(body.springs.count));
  for (std::int32_t s = body.springs.first; s < body.springs.end(); ++s) {
    springs.push_back({model.springs[static_cast<std::size_t>(s)]});
  }
  const Incidences incidences(body.particles, springs);
  groups_ = BlockGroups(
      visits, [&](std::int32_t particle) { return incidences.at(particle).empty() ? -1 : 0; },
      [&](std::int32_t particle) { return incidences.at(particle).size(); });
  others_.resize(static_cast<std::size_t>(groups_.row_count()) * lanes);
  rest_.resize(static_cast<std::size_t>(groups_.row_count()) * 2 * lanes);
  for (const BlockGroup& group : groups_.all()) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto meeting = incidences.at(group.particles[lane]);
      for (std::int32_t k = 0; k < group.rows; ++k) {
        const bool is_there = group.places[lane] >= 0 && static_cast<std::size_t>(k) < meeting.size();
        const auto [s, own] = meeting[is_there ? static_cast<std::size_t>(k) : 0];
        const auto [p, q] = springs[static_cast<std::size_t>(s)].nodes;
        const double r = (block3(model.rest_positions, q) - block3(model.rest_positions, p)).stableNorm();
        const auto row = static_cast<std::size_t>(group.first_row + k);
        others_[row * lanes + lane] = own == 0 ? q : p;
        rest_[row * 2 * lanes + lane] = r;
        rest_[(row * 2 + 1) * lanes + lane] = is_there ? 1.0 / r : 0.0;
      }
    }
  }
}

}  // namespace

std::unique_ptr<BlockRuns> make_spring_runs(const Model& model, const Body& body, const Visits& visits) {
  return std::make_unique<SpringRuns>(model, body, visits);
}

}  // namespace flexcast
