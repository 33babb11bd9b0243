#include "clients/record/file_thread.h"

#include <chrono>

namespace flexcast::record {
namespace {

constexpr std::chrono::milliseconds idle_period{50};  // of looking for chunks that are old enough

std::int64_t system_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

void FileThread::start() {
  thread_ = std::thread(&FileThread::run, this);
}

mcap::Status FileThread::finish() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
  return status_;
}

void FileThread::run() {
  while (status_ && !queue_.finished()) {
    status_ = write_next();
    bytes_written_ = file_.bytes_written();
  }
  if (status_) return;
  failed_ = true;
  queue_.close();
  discard_rest();
}

void FileThread::discard_rest() {
  while (const auto item = queue_.pop(std::chrono::nanoseconds(0))) note_unwritten(*item);
}

void FileThread::note_unwritten(const Item& item) {
  const auto* message = std::get_if<Message>(&item);
  if (!message || message->topic != wire::TopicId::frames) return;
  auto head = wire::peek_frame_head(message->bytes);
  if (!head) return;
  head.value().world = {};  // lives as long as the item
  unwritten_.push_back(head.value());
}

mcap::Status FileThread::write_next() {
  const auto item = queue_.pop(idle_period);
  if (!item) return file_.flush_if_older(system_time());
  mcap::Status status = file_.write(*item);
  if (!status) note_unwritten(*item);
  return status;
}

}  // namespace flexcast::record
