// SIGINT and SIGTERM end the work under way, not the process.
#pragma once

namespace flexcast::ctl {

// While one of these lives. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool happened() const;

 private:
  void (*previous_[2])(int) = {};
};

}  // namespace flexcast::ctl
