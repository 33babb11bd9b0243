#include "server/parameter_table.h"

namespace flexcast::server {
namespace {

const ParameterRow& rate_row() {
  static const ParameterRow row = [] {
    ParameterRow rate;
    rate.name = "server.rate";
    rate.kind = ParameterKind::number;
    rate.unit = "1";
    rate.range = ranges::non_negative;
    rate.live = true;
    rate.description = "simulated seconds per wall second; 1: real time, 0: as fast as possible";
    return rate;
  }();
  return row;
}

}  // namespace

ParameterTable::ParameterTable(Simulation& simulation, double rate)
    : simulation_(&simulation), own_{"server.rate", &rate_row(), 0, rate}, rate_(rate) {}

std::vector<ParameterDescriptor> ParameterTable::descriptors() const {
  auto all = simulation_->parameters();
  all.push_back(own_);
  return all;
}

const ParameterDescriptor* ParameterTable::find(std::string_view name) const {
  return name == own_.name ? &own_ : simulation_->find_parameter(name);
}

ParameterValue ParameterTable::value(const ParameterDescriptor& descriptor) const {
  return is_own(descriptor) ? ParameterValue(rate_) : simulation_->parameter(descriptor);
}

std::vector<ParameterAssignment> ParameterTable::values() const {
  std::vector<ParameterAssignment> values;
  for (const auto& descriptor : simulation_->parameters()) values.push_back({descriptor.name, value(descriptor)});
  values.push_back({own_.name, rate_});
  return values;
}

std::vector<ParameterAssignment> ParameterTable::changed() const {
  std::vector<ParameterAssignment> changed;
  for (const auto& descriptor : simulation_->parameters()) {
    const ParameterValue now = value(descriptor);
    if (now != descriptor.initial) changed.push_back({descriptor.name, now});
  }
  if (ParameterValue(rate_) != own_.initial) changed.push_back({own_.name, rate_});
  return changed;
}

Result<std::vector<ParameterAssignment>> ParameterTable::values_of(const std::vector<std::string>& names) const {
  std::vector<ParameterAssignment> values;
  for (const auto& name : names) {
    const auto* descriptor = find(name);
    if (descriptor == nullptr) return Error{"there is no parameter '" + name + "'"};
    values.push_back({name, value(*descriptor)});
  }
  return values;
}

Result<void> ParameterTable::set(std::span<const ParameterAssignment> assignments) {
  std::vector<ParameterAssignment> of_simulation;
  double rate = rate_;
  for (const auto& assignment : assignments) {
    if (assignment.name != own_.name) {
      of_simulation.push_back(assignment);
      continue;
    }
    auto converted = convert_parameter(own_.name, *own_.row, assignment.value);
    if (!converted) return converted.error();
    rate = std::get<double>(converted.value());
  }
  if (!of_simulation.empty()) {
    if (auto result = simulation_->set_parameters(of_simulation); !result) return result.error();
  }
  if (of_simulation.size() < assignments.size()) {
    rate_ = rate;
    ++own_changes_;
  }
  return {};
}

void ParameterTable::reset(bool keep_parameters) {
  simulation_->reset(keep_parameters);
  if (keep_parameters || ParameterValue(rate_) == own_.initial) return;
  rate_ = std::get<double>(own_.initial);
  ++own_changes_;
}

void ParameterTable::follow(Simulation& simulation) {
  own_changes_ += simulation_->parameter_revision();
  simulation_ = &simulation;
  rate_ = std::get<double>(own_.initial);
}

}  // namespace flexcast::server
