// Owned<T>: owns one generated struct with its strings and sequences, and frees them all.
#pragma once

#include <cstring>
#include <type_traits>
#include <utility>

#include "idl/wire/types.h"

namespace flexcast::wire {

// Frees strings and sequences (those with _release), leaves the struct itself.
void free_contents(void* sample, const dds_topic_descriptor_t& descriptor);

// Starts with every string null (written as ""), every sequence empty, every number 0: ready to be filled (fill.h) and
// written.
template <class T>
class Owned {
 public:
  Owned() { std::memset(static_cast<void*>(&value_), 0, sizeof value_); }
  Owned(Owned&& other) noexcept : Owned() { std::swap(value_, other.value_); }
  Owned& operator=(Owned&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Owned() { free_contents(&value_, descriptor_of<T>()); }

  T& operator*() { return value_; }
  const T& operator*() const { return value_; }
  T* operator->() { return &value_; }
  const T* operator->() const { return &value_; }

 private:
  static_assert(std::is_trivially_copyable_v<T>);
  T value_;
};

}  // namespace flexcast::wire
