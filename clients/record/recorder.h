// Recorder: records one world to one file. Two threads of its own: one takes samples off the network, one writes.
//
//   auto recorder = Recorder::start(options, [] { return false; });
//   while (!recorder.value()->ended()) recorder.value()->tend();   // ten times a second, say
//   auto report = recorder.value()->finish();
#pragma once

#include <memory>
#include <string>

#include "clients/mcap/file_sink.h"
#include "clients/record/announcer.h"
#include "clients/record/file_thread.h"
#include "clients/record/find_world.h"
#include "clients/record/options.h"
#include "clients/record/receiver.h"
#include "clients/record/report.h"

namespace flexcast::record {

class Recorder {
 public:
  // Waits for the world, subscribes, waits for the match, and then creates the file: until then nothing is written or
  // replaced. When it returns the recording runs and the server knows of it.
  static wire::Result<std::unique_ptr<Recorder>> start(const Options& options, const Interrupted& interrupted);

  const std::string& world() const { return world_; }
  int domain() const { return participant_.domain(); }

  bool ended() const { return receiver_->ended(); }  // a limit was reached, or the file failed
  Progress progress() const { return receiver_->progress(); }
  std::uint64_t bytes_written() const { return file_thread_->bytes_written(); }

  // Tells the domain how the recording is doing. Returns a line for people when the server has gone or come back, else
  // "".
  std::string tend();

  // Ends the recording and completes the file. Once. The error says why the file is not complete.
  wire::Result<Report> finish();

 private:
  Recorder(wire::Participant participant, wire::WorldWatch watch, Announcer announcer, Subscriptions subscriptions,
           const std::string& world, const std::string& path);
  wire::Result<void> wait_for_match(std::chrono::duration<double> wait, const Interrupted& interrupted);
  wire::Result<void> open(const Options& options);
  mcap::Status complete(Report& report);

  const std::string world_;
  const std::string path_;
  wire::Participant participant_;
  wire::WorldWatch watch_;
  Announcer announcer_;
  Subscriptions subscriptions_;
  ItemQueue queue_;
  std::unique_ptr<mcap::FileSink> sink_;
  std::unique_ptr<RecordingFile> file_;
  std::unique_ptr<FileThread> file_thread_;
  std::unique_ptr<Receiver> receiver_;
  bool present_ = true;  // the server
};

}  // namespace flexcast::record
