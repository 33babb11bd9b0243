#include "clients/record/item_queue.h"

namespace flexcast::record {
namespace {

std::size_t size_of(const Item& item) {
  return sizeof item + payload_bytes(item);
}

bool is_frame(const Item& item) {
  const auto* message = std::get_if<Message>(&item);
  return message && message->topic == wire::TopicId::frames;
}

}  // namespace

Pushed ItemQueue::push(Item&& item) {
  const std::size_t size = size_of(item);
  const std::size_t limit = is_frame(item) ? capacity_ - capacity_ / 16 : capacity_;
  {
    const std::scoped_lock lock(mutex_);
    popped_ = false;
    if (closed_) return Pushed::closed;
    if (!items_.empty() && bytes_ + size > limit) return Pushed::full;
    bytes_ += size;
    items_.push_back(std::move(item));
  }
  changed_.notify_one();
  return Pushed::taken;
}

std::optional<Item> ItemQueue::pop(std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, timeout, [this] { return closed_ || !items_.empty(); });
  if (items_.empty()) return std::nullopt;
  std::optional<Item> item = std::move(items_.front());
  items_.pop_front();
  bytes_ -= size_of(*item);
  popped_ = true;
  lock.unlock();
  room_.notify_one();
  return item;
}

void ItemQueue::wait_for_room(std::chrono::nanoseconds timeout) {
  std::unique_lock lock(mutex_);
  room_.wait_for(lock, timeout, [this] { return closed_ || popped_; });
}

void ItemQueue::close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  room_.notify_all();
}

bool ItemQueue::finished() const {
  const std::scoped_lock lock(mutex_);
  return closed_ && items_.empty();
}

std::size_t ItemQueue::bytes() const {
  const std::scoped_lock lock(mutex_);
  return bytes_;
}

}  // namespace flexcast::record
