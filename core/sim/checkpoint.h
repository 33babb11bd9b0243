// A checkpoint: everything that the next steps of a simulation depend on, to the last bit.
//
// On disk, little endian: the 8 bytes "flexckpt", the version (uint32), the fingerprint of the scene (uint64), the
// content, and the XXH3 (64 bit) of all bytes before it. A file of another version, of another scene, cut short or
// damaged is refused.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/forces/model.h"
#include "core/sim/energy_books.h"
#include "core/sim/parameters.h"
#include "core/state/state.h"

namespace flexcast {

inline constexpr std::uint32_t checkpoint_version = 2;

struct Checkpoint {
  std::uint64_t fingerprint = 0;  // of the scene it belongs to
  State state;
  std::int64_t base_step = 0;  // time = base_time + (step - base_step) time.step
  double base_time = 0.0;      // s
  VecX history;                // of the integrator
  EnergyBooks books;
  std::vector<Grab> grabs;
  VecX contract;                            // what a contract has chosen and knows; empty without one
  std::vector<ParameterAssignment> values;  // every live parameter
};

// Of what a checkpoint cannot change: rest shape, connections, what is held, names, and the start.
std::uint64_t calc_fingerprint(const Model& model, const State& initial);

std::string encode_checkpoint(const Checkpoint& checkpoint);
// Errors say what is wrong with the bytes.
Result<Checkpoint> decode_checkpoint(std::string_view bytes);

// Through a temporary file in the same folder, so that a file of that name is always whole.
Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
Result<Checkpoint> read_checkpoint(const std::filesystem::path& path);

}  // namespace flexcast
