// ItemQueue: from the receiving thread to the file's thread, bounded in bytes. When the disk is too slow it is full;
// the receiver then drops what comes and counts it, or waits for room if the server waits for it.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "clients/record/item.h"

namespace flexcast::record {

enum class Pushed { taken, full, closed };

class ItemQueue {
 public:
  // Frames leave a sixteenth free, so that the few small messages beside them are not dropped with them.
  explicit ItemQueue(std::size_t capacity_bytes) : capacity_(capacity_bytes) {}

  // An empty queue takes an item of any size. One that is not taken is left as it is.
  Pushed push(Item&& item);

  // Waits until something was popped since the last push; at most for `timeout`.
  void wait_for_room(std::chrono::nanoseconds timeout);

  // The oldest item; none if there was none within the timeout or the queue is finished.
  std::optional<Item> pop(std::chrono::nanoseconds timeout);

  // Nothing more is taken; what waits can be popped.
  void close();
  bool finished() const;  // closed and empty

  std::size_t bytes() const;

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::condition_variable room_;
  std::deque<Item> items_;
  std::size_t bytes_ = 0;
  bool closed_ = false;
  bool popped_ = false;  // since the last push
};

}  // namespace flexcast::record
