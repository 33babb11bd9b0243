// Repeats: what a part of a recording must begin with to be complete by itself: the attachments, the newest scene,
// topology and parameters, and the events of the present run.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "clients/record/item.h"

namespace flexcast::record {

class Repeats {
 public:
  // Takes note of an item that was recorded.
  void note(const Item& item);

  // In the order in which a part should begin. Valid until the next note().
  std::vector<const Item*> items() const;

 private:
  void note_topology(const Item& item, const Message& message);
  void note_event(const Item& item, const Message& message);

  std::vector<Item> attachments_;
  std::optional<Item> scene_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Item> topology_;  // by body and chunk
  std::uint64_t topology_revision_ = 0;
  std::uint64_t topology_run_ = 0;
  std::optional<Item> parameters_;
  std::vector<Item> events_;
  std::uint64_t event_run_ = 0;
};

}  // namespace flexcast::record
