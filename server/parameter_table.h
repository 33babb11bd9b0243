// ParameterTable: the simulation's parameters and the server's own, under one roof: one batch, one revision.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/sim/simulation.h"

namespace flexcast::server {

class ParameterTable {
 public:
  // `rate`: the initial value of server.rate, simulated seconds per wall second, 0: as fast as possible.
  ParameterTable(Simulation& simulation, double rate);

  double rate() const { return rate_; }
  std::uint64_t revision() const { return simulation_->parameter_revision() + own_changes_; }

  std::vector<ParameterDescriptor> descriptors() const;
  std::vector<ParameterAssignment> values() const;   // of all
  std::vector<ParameterAssignment> changed() const;  // those that differ from their initial values
  Result<std::vector<ParameterAssignment>> values_of(const std::vector<std::string>& names) const;

  // All or nothing, across both. On success the revision grows.
  Result<void> set(std::span<const ParameterAssignment> assignments);

  // Resets the simulation; parameters return to their initial values unless kept.
  void reset(bool keep_parameters);

  // From now on those of another simulation; the server's own return to their initial values. The revision grows.
  void follow(Simulation& simulation);

 private:
  const ParameterDescriptor* find(std::string_view name) const;
  ParameterValue value(const ParameterDescriptor& descriptor) const;
  bool is_own(const ParameterDescriptor& descriptor) const { return &descriptor == &own_; }

  Simulation* simulation_;
  ParameterDescriptor own_;  // server.rate
  double rate_;
  std::uint64_t own_changes_ = 0;
};

}  // namespace flexcast::server
