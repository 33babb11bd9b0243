#include "clients/record/account_note.h"

#include <fmt/format.h>

#include <limits>
#include <sstream>
#include <string>
#include <string_view>

namespace flexcast::record {
namespace {

constexpr std::string_view dropped_prefix = "dropped.";

void add_ranges(mcap::TextPairs& pairs, std::string_view name, const std::vector<Pause>& ranges) {
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    pairs[fmt::format("{}.{}", name, i)] = fmt::format("{} {} {}", ranges[i].run_id, ranges[i].first, ranges[i].last);
  }
}

void take_range(const std::string& value, std::vector<Pause>& ranges) {
  Pause range;
  if (std::istringstream(value) >> range.run_id >> range.first >> range.last && range.first <= range.last &&
      range.last < std::numeric_limits<std::uint64_t>::max()) {
    ranges.push_back(range);
  }
}

void take_messages(std::string_view topic, const std::string& value, AccountNote& note) {
  std::uint64_t count = 0;
  if (!(std::istringstream(value) >> count)) return;
  for (const wire::TopicRow& row : wire::topic_table()) {
    if (row.name == topic) note.messages[row.id] = count;
  }
}

}  // namespace

mcap::TextPairs to_metadata(const AccountNote& note) {
  mcap::TextPairs pairs;
  for (std::size_t i = 0; i < note.watched.size(); ++i) {
    pairs[fmt::format("watched.{}", i)] = std::to_string(note.watched[i]);
  }
  add_ranges(pairs, "pause", note.paused);
  add_ranges(pairs, "queue", note.dropped);
  for (const auto& [topic, count] : note.messages) {
    pairs[fmt::format("{}{}", dropped_prefix, wire::topic(topic).name)] = std::to_string(count);
  }
  return pairs;
}

AccountNote account_of(const mcap::TextPairs& metadata) {
  AccountNote note;
  for (const auto& [key, value] : metadata) {
    const std::string_view name(key);
    if (name.starts_with("pause.")) take_range(value, note.paused);
    if (name.starts_with("queue.")) take_range(value, note.dropped);
    if (name.starts_with(dropped_prefix)) take_messages(name.substr(dropped_prefix.size()), value, note);
    std::uint64_t run_id = 0;
    if (name.starts_with("watched.") && std::istringstream(value) >> run_id) note.watched.push_back(run_id);
  }
  return note;
}

}  // namespace flexcast::record
