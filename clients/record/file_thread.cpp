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
}

mcap::Status FileThread::write_next() {
  if (const auto item = queue_.pop(idle_period)) return file_.write(*item);
  return file_.flush_if_older(system_time());
}

}  // namespace flexcast::record
