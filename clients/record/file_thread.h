// FileThread: the thread that writes what is in the queue to the file.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "clients/record/item_queue.h"
#include "clients/record/item_sink.h"
#include "idl/wire/frame_head.h"

namespace flexcast::record {

class FileThread {
 public:
  // Both must outlive this object. The file belongs to the thread until finish() has returned.
  FileThread(ItemQueue& queue, ItemSink& file) : queue_(queue), file_(file) {}
  ~FileThread() { (void)finish(); }
  FileThread(const FileThread&) = delete;
  FileThread& operator=(const FileThread&) = delete;

  void start();

  // Closes the queue, writes what is in it and returns the first failure. The file stays open.
  mcap::Status finish();

  // After a failure nothing is written any more and the queue is closed.
  bool failed() const { return failed_; }
  std::uint64_t bytes_written() const { return bytes_written_; }

  // After finish(): the frames (each chunk of them) that were in the queue when the file had failed already.
  const std::vector<wire::FrameHead>& unwritten() const { return unwritten_; }

 private:
  void run();
  mcap::Status write_next();
  void discard_rest();
  void note_unwritten(const Item& item);

  ItemQueue& queue_;
  ItemSink& file_;
  mcap::Status status_;                     // of the thread, until it is joined
  std::vector<wire::FrameHead> unwritten_;  // the same
  std::atomic<bool> failed_ = false;
  std::atomic<std::uint64_t> bytes_written_ = 0;
  std::thread thread_;
};

}  // namespace flexcast::record
