#include "clients/client/frame.h"

#include <algorithm>
#include <span>

#include "idl/wire/fill.h"

namespace flexcast::client {
namespace {

constexpr std::size_t most_partials = 64;

// Writes `values` behind the first `offset` numbers; false if they do not fit a field of `size` numbers.
template <class T>
bool place(std::vector<double>& field, std::span<const T> values, std::size_t offset, std::size_t size) {
  if (values.empty()) return true;
  if (offset > size || values.size() > size - offset) return false;
  field.resize(size);
  std::copy(values.begin(), values.end(), field.begin() + static_cast<std::ptrdiff_t>(offset));
  return true;
}

std::vector<double> dequantized(std::span<const std::uint16_t> fractions, const double (&bounds)[6]) {
  std::vector<double> positions(fractions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double low = bounds[i % 3], high = bounds[i % 3 + 3];
    positions[i] = low + (high - low) * (fractions[i] / 65535.0);
  }
  return positions;
}

Frame head_of(const flexcast_ParticleFrame& sample) {
  Frame frame{.run_id = sample.run_id,
              .frame = sample.frame,
              .step = sample.step,
              .time = sample.time,
              .parameter_revision = sample.parameter_revision,
              .topology_revision = sample.topology_revision,
              .state_hash = sample.state_hash,
              .particles = sample.total};
  std::copy(std::begin(sample.bounds), std::end(sample.bounds), frame.bounds.begin());
  return frame;
}

bool place_fields(Frame& frame, const flexcast_ParticleFrame& sample) {
  using wire::elements;
  const std::size_t all = sample.total, first = sample.first;
  const std::vector<double> dequantized_positions = dequantized(elements(sample.positions16), sample.bounds);
  return place(frame.positions, elements(sample.positions), 3 * first, 3 * all) &&
         place(frame.positions, elements(sample.positions64), 3 * first, 3 * all) &&
         place(frame.positions, std::span(dequantized_positions), 3 * first, 3 * all) &&
         place(frame.velocities, elements(sample.velocities), 3 * first, 3 * all) &&
         place(frame.velocities, elements(sample.velocities64), 3 * first, 3 * all) &&
         place(frame.stretch, elements(sample.stretch), first, all) &&
         place(frame.stress, elements(sample.stress), first, all);
}

}  // namespace

std::optional<Frame> FrameAssembler::add(const flexcast_ParticleFrame& sample) {
  const Key key{sample.run_id, sample.frame};
  if (last_ && last_->first == key.first && key.second <= last_->second) return {};
  if (sample.chunk >= sample.chunks) return {};
  const auto [entry, is_new] = partials_.try_emplace(key);
  Partial& partial = entry->second;
  if (is_new) {
    partial.frame = head_of(sample);
    partial.have.resize(sample.chunks);
    partial.missing = sample.chunks;
  }
  if (sample.chunk >= partial.have.size() || partial.have[sample.chunk] || sample.total != partial.frame.particles ||
      !place_fields(partial.frame, sample))
    return {};
  partial.have[sample.chunk] = true;
  if (--partial.missing == 0) return finish(entry);
  if (partials_.size() > most_partials) partials_.erase(partials_.begin());
  return {};
}

std::optional<Frame> FrameAssembler::finish(std::map<Key, Partial>::iterator partial) {
  const Key key = partial->first;
  Frame frame = std::move(partial->second.frame);
  const bool same_run = last_ && last_->first == key.first;
  missed_ = same_run ? missed_ + (key.second - last_->second - 1) : 0;
  last_ = key;
  std::erase_if(partials_, [&](const auto& p) { return p.first.first == key.first && p.first.second <= key.second; });
  return frame;
}

}  // namespace flexcast::client
