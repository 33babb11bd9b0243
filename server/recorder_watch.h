// RecorderWatch: the thread that listens to recorders and keeps the roll of those that run in lockstep.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "idl/wire/reader.h"
#include "idl/wire/wait_set.h"
#include "server/recorder_roll.h"

namespace flexcast::server {

class RecorderWatch {
 public:
  // `roll` must outlive this object. `changed` is called after every change of it, on the thread of this object.
  static wire::Result<std::unique_ptr<RecorderWatch>> create(const wire::Participant& participant, std::string world,
                                                             RecorderRoll& roll, std::function<void()> changed);
  ~RecorderWatch() { stop(); }
  RecorderWatch(const RecorderWatch&) = delete;
  RecorderWatch& operator=(const RecorderWatch&) = delete;

  void start();
  void stop();

 private:
  RecorderWatch(std::string world, RecorderRoll& roll, std::function<void()> changed,
                wire::Reader<flexcast_RecorderInfo> reader, wire::GuardCondition stop_signal, wire::WaitSet wait_set);
  void run();
  void take();
  void forget_the_dead();
  void follow(const flexcast_RecorderInfo& recorder, const wire::SampleInfo& info);

  std::string world_;
  RecorderRoll& roll_;
  std::function<void()> changed_;
  std::map<std::string, std::uint64_t> writers_;  // of the recorders on the roll
  wire::Reader<flexcast_RecorderInfo> reader_;
  wire::GuardCondition stop_signal_;
  wire::WaitSet wait_set_;  // goes before what is attached to it
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace flexcast::server
