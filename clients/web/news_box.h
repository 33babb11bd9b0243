// NewsBox: where the DDS thread leaves what the network's thread takes.
#pragma once

#include <mutex>
#include <utility>

#include "clients/web/news.h"

namespace flexcast::web {

class NewsBox {
 public:
  void put(News news) {
    const std::scoped_lock lock(mutex_);
    delivery_.news.push_back(std::move(news));
  }

  // Takes the place of a frame that has not been taken: the newest wins.
  void put_frame(const std::string& world, FramePointer frame) {
    const std::scoped_lock lock(mutex_);
    std::swap(delivery_.frames[world], frame);  // the old one is freed after the lock
  }

  Delivery take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(delivery_, {});
  }

 private:
  std::mutex mutex_;
  Delivery delivery_;
};

}  // namespace flexcast::web
