#include "idl/wire/fill.h"

#include <dds/dds.h>

#include <cstdlib>

namespace flexcast::wire {

void* allocate_zeroed(std::size_t bytes) {
  void* memory = dds_alloc(bytes > 0 ? bytes : 1);
  if (!memory) std::abort();
  std::memset(memory, 0, bytes);
  return memory;
}

void free_allocated(void* memory) {
  dds_free(memory);
}

void set_string(char*& field, std::string_view value) {
  auto* copied = static_cast<char*>(allocate_zeroed(value.size() + 1));
  if (!value.empty()) std::memcpy(copied, value.data(), value.size());
  dds_free(field);
  field = copied;
}

void set_strings(dds_sequence_string& sequence, std::span<const std::string> values) {
  auto slots = resize(sequence, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) set_string(slots[i], values[i]);
}

std::vector<std::string> strings(const dds_sequence_string& sequence) {
  std::vector<std::string> values;
  for (const char* value : elements(sequence)) values.emplace_back(text(value));
  return values;
}

void copy(flexcast_ParameterValue& to, const flexcast_ParameterValue& from) {
  set_string(to.name, text(from.name));
  to.kind = from.kind;
  copy(to.numbers, elements(from.numbers));
  set_string(to.text, text(from.text));
}

void copy(flexcast_ParameterDescriptor& to, const flexcast_ParameterDescriptor& from) {
  set_string(to.name, text(from.name));
  to.kind = from.kind;
  set_string(to.unit, text(from.unit));
  copy(to.initial, from.initial);
  to.minimum = from.minimum;
  to.maximum = from.maximum;
  to.minimum_open = from.minimum_open;
  to.maximum_open = from.maximum_open;
  set_strings(to.choices, strings(from.choices));
  to.live = from.live;
  set_string(to.description, text(from.description));
}

}  // namespace flexcast::wire
