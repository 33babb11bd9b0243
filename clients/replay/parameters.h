// The parameters of a replay: replay.rate, replay.time and replay.loop.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/client/value.h"

namespace flexcast::replay {

struct Settings {
  double rate = 1.0;  // simulated seconds per wall second; 0: as fast as possible
  bool loop = false;
};

// What the parameters say now.
struct Dials {
  Settings settings;
  Settings initial;         // what reset restores
  double time = 0.0;        // s, of the shown frame
  double first_time = 0.0;  // s, of the run that is shown, or the part of it
  double last_time = 0.0;
};

// What a command asks to change.
struct Change {
  std::optional<double> rate, time;
  std::optional<bool> loop;
};

// The values of these names, or of all for none; an error names the parameter that is not there.
wire::Result<std::vector<client::Parameter>> values_of(const Dials& dials, const std::vector<std::string>& names);

// Fills an empty sequence.
void fill_descriptors(dds_sequence_flexcast_ParameterDescriptor& descriptors, const Dials& dials);

// All or nothing: the error names parameter, value and what is allowed.
wire::Result<Change> parse_change(std::span<const flexcast_ParameterValue> values, const Dials& dials);

}  // namespace flexcast::replay
