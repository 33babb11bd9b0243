#include "clients/replay/parameters.h"

#include <cmath>
#include <limits>

#include "clients/replay/clips.h"
#include "idl/wire/fill.h"

namespace flexcast::replay {
namespace {

using client::Parameter;
using wire::Error;
using wire::Result;

std::vector<Parameter> values(const Settings& settings, double time) {
  return {{"replay.rate", settings.rate}, {"replay.time", time}, {"replay.loop", settings.loop}};
}

Error not_there(const std::string& name) {
  return {"there is no parameter '" + name + "': a replay has replay.rate, replay.time and replay.loop"};
}

Error refusal(const Parameter& parameter, const std::string& allowed) {
  return {parameter.name + " = " + client::to_text(parameter.value) + " is refused: " + allowed};
}

std::optional<double> to_number(const client::Value& value) {
  if (const auto* number = std::get_if<double>(&value); number && std::isfinite(*number)) return *number;
  if (const auto* number = std::get_if<std::int64_t>(&value)) return static_cast<double>(*number);
  return std::nullopt;
}

Result<void> add(Change& change, const Parameter& parameter, const Dials& dials) {
  const auto number = to_number(parameter.value);
  if (parameter.name == "replay.rate") {
    if (!number || *number < 0.0) return refusal(parameter, "a number from 0 on is needed; 0: as fast as possible");
    change.rate = *number;
  } else if (parameter.name == "replay.time") {
    if (!number || *number < 0.0 || !has_reached(dials.last_time, *number)) {
      return refusal(parameter, "this run is there from " + client::to_text(dials.first_time) + " s to " +
                                    client::to_text(dials.last_time) + " s");
    }
    change.time = *number;
  } else if (parameter.name == "replay.loop") {
    const auto* loop = std::get_if<bool>(&parameter.value);
    if (loop == nullptr) return refusal(parameter, "true or false is needed");
    change.loop = *loop;
  } else {
    return not_there(parameter.name);
  }
  return {};
}

void fill(flexcast_ParameterDescriptor& descriptor, const Parameter& initial, const char* unit, double minimum,
          double maximum, const char* description) {
  wire::set_string(descriptor.name, initial.name);
  descriptor.kind = client::kind_of(initial.value);
  wire::set_string(descriptor.unit, unit);
  client::to_wire(descriptor.initial, initial);
  descriptor.minimum = minimum;
  descriptor.maximum = maximum;
  descriptor.live = true;
  wire::set_string(descriptor.description, description);
}

}  // namespace

Result<std::vector<Parameter>> values_of(const Dials& dials, const std::vector<std::string>& names) {
  const std::vector<Parameter> all = values(dials.settings, dials.time);
  if (names.empty()) return all;
  std::vector<Parameter> found;
  for (const std::string& name : names) {
    const auto parameter = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
    if (parameter == all.end()) return not_there(name);
    found.push_back(*parameter);
  }
  return found;
}

void fill_descriptors(dds_sequence_flexcast_ParameterDescriptor& descriptors, const Dials& dials) {
  const std::vector<Parameter> initial = values(dials.initial, dials.first_time);
  const auto slots = wire::resize(descriptors, initial.size());
  fill(slots[0], initial[0], "1", 0.0, std::numeric_limits<double>::infinity(),
       "simulated seconds per wall second; 1: real time, 0: as fast as possible");
  fill(slots[1], initial[1], "s", dials.first_time, dials.last_time,
       "simulated time that is shown; set: goes to the first frame at or after it in this run");
  fill(slots[2], initial[2], "", 0.0, 1.0, "begin again at the end, as a new run");
}

Result<Change> parse_change(std::span<const flexcast_ParameterValue> values, const Dials& dials) {
  if (values.empty()) return Error{"no parameter was named"};
  Change change;
  for (const flexcast_ParameterValue& value : values) {
    if (auto added = add(change, client::from_wire(value), dials); !added) return added.error();
  }
  return change;
}

}  // namespace flexcast::replay
