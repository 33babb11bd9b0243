// Queue<T>: hands values from one thread to another. Bounded if a limit is given.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "server/convert/clock.h"

namespace flexcast::server {

template <class T>
class Queue {
 public:
  explicit Queue(std::size_t limit = std::numeric_limits<std::size_t>::max()) : limit_(limit) {}

  // False when the queue is full: nothing was taken in.
  bool push(T value) {
    {
      const std::scoped_lock lock(mutex_);
      if (values_.size() >= limit_) return false;
      values_.push_back(std::move(value));
    }
    changed_.notify_one();
    return true;
  }

  // Everything that waits, in the order it came.
  std::vector<T> take_all() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(values_, {});
  }

  std::size_t size() const {
    const std::scoped_lock lock(mutex_);
    return values_.size();
  }

  // Until something waits, wake() is called or the time is up.
  void wait_for(Clock::duration timeout) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, timeout, [this] { return woken_ || !values_.empty(); });
    woken_ = false;
  }

  // Ends the present wait_for, or the next.
  void wake() {
    {
      const std::scoped_lock lock(mutex_);
      woken_ = true;
    }
    changed_.notify_one();
  }

 private:
  std::size_t limit_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> values_;
  bool woken_ = false;
};

}  // namespace flexcast::server
