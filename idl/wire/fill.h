// Filling the generated C structs: owned copies (freed by Owned<T>) or views of memory that is somebody else's.
//
//   Owned<flexcast_Reply> reply;
//   set_string(reply->world, "cantilever");
//   for (auto& value : resize(reply->values, n)) set_string(value.name, ...);
//   view(frame->positions, std::span<const float>(...));    // no copy: must live until write() has returned
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "idl/wire/types.h"

namespace flexcast::wire {

void* allocate_zeroed(std::size_t bytes);  // by Cyclone's allocator; never null
void free_allocated(void* memory);

// Null counts as "".
inline std::string_view text(const char* string) {
  return string ? std::string_view(string) : std::string_view();
}

// Frees what the field held and copies `value` (up to its first zero byte).
void set_string(char*& field, std::string_view value);

template <class Sequence>
using Element = std::remove_pointer_t<decltype(std::declval<Sequence&>()._buffer)>;

// A sequence's elements. S is any generated dds_sequence_...
template <class S>
std::span<Element<S>> elements(S& sequence) {
  return {sequence._buffer, sequence._length};
}
template <class S>
std::span<const Element<S>> elements(const S& sequence) {
  return {sequence._buffer, sequence._length};
}

// Gives an EMPTY sequence n zeroed elements of its own and returns them. (Sequences of structs and strings cannot be
// emptied here without leaking what their elements hold: fill each sequence once.)
template <class S>
std::span<Element<S>> resize(S& sequence, std::size_t n) {
  if (n > 0) {
    sequence._buffer = static_cast<Element<S>*>(allocate_zeroed(n * sizeof(Element<S>)));
    sequence._maximum = sequence._length = static_cast<std::uint32_t>(n);
    sequence._release = true;
  }
  return elements(sequence);
}

// Replaces a sequence of numbers by a copy.
template <class S>
requires std::is_arithmetic_v<Element<S>>
void copy(S& sequence, std::span<const std::type_identity_t<Element<S>>> values) {
  if (sequence._release) free_allocated(sequence._buffer);
  sequence = S{};
  resize(sequence, values.size());
  if (!values.empty()) std::memcpy(sequence._buffer, values.data(), values.size_bytes());
}

// Lets a sequence of numbers show memory that is somebody else's; it must stay until the sample has been written.
template <class S>
requires std::is_arithmetic_v<Element<S>>
void view(S& sequence, std::span<const std::type_identity_t<Element<S>>> values) {
  if (sequence._release) free_allocated(sequence._buffer);
  sequence._buffer = const_cast<Element<S>*>(values.data());
  sequence._maximum = sequence._length = static_cast<std::uint32_t>(values.size());
  sequence._release = false;
}

// Fills an empty sequence of strings.
void set_strings(dds_sequence_string& sequence, std::span<const std::string> values);
std::vector<std::string> strings(const dds_sequence_string& sequence);

// Deep copies into a zeroed struct.
void copy(flexcast_ParameterValue& to, const flexcast_ParameterValue& from);
void copy(flexcast_ParameterDescriptor& to, const flexcast_ParameterDescriptor& from);

}  // namespace flexcast::wire
