// Recorder: records one world. Two threads of its own: one takes samples off the network, one writes.
//
//   auto recorder = Recorder::start(options, [] { return false; });
//   while (!recorder.value()->ended()) recorder.value()->tend();   // twenty times a second, say
//   auto report = recorder.value()->finish();
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "clients/record/announcer.h"
#include "clients/record/destination.h"
#include "clients/record/file_thread.h"
#include "clients/record/find_world.h"
#include "clients/record/options.h"
#include "clients/record/receiver.h"
#include "clients/record/remote_control.h"
#include "clients/record/report.h"

namespace flexcast::record {

class Recorder {
 public:
  // Waits for the world, subscribes, waits for the match, and then creates the file: until then nothing is written or
  // replaced. When it returns the recording runs (or is paused, if so asked) and the server knows of it.
  static wire::Result<std::unique_ptr<Recorder>> start(const Options& options, const Interrupted& interrupted);

  const std::string& world() const { return world_; }
  int domain() const { return participant_.domain(); }
  bool is_paused() const { return receiver_->is_paused(); }

  // A limit was reached, the file failed, or a RECORDER_STOP has come.
  bool ended() const { return stop_asked_ || receiver_->ended(); }
  Progress progress() const { return receiver_->progress(); }
  std::uint64_t bytes_written() const { return file_thread_->bytes_written(); }

  // Carries out what other programs command and tells the domain how the recording is doing. Returns a line for people
  // when the server has gone or come back, else "".
  std::string tend();

  // Ends the recording and completes the file. Once. After a failed write the report has a `failure` and says what
  // could be kept; the error says why the file is not complete.
  wire::Result<Report> finish();

 private:
  Recorder(wire::Participant participant, wire::WorldWatch watch, std::unique_ptr<Announcer> announcer,
           RemoteControl remote, Subscriptions subscriptions, const std::string& world, const std::string& path);
  wire::Result<void> wait_for_match(std::chrono::duration<double> wait, const Interrupted& interrupted);
  wire::Result<void> open(const Options& options);
  void carry_out_commands();
  bool carry_out(const RemoteCommand& command);
  void update_lockstep();
  flexcast_RecorderState state() const;
  Report make_report() const;
  wire::Result<Report> complete();
  wire::Result<Report> rescue(const std::string& failure);

  const std::string world_;
  const std::string path_;
  wire::Participant participant_;
  wire::WorldWatch watch_;
  std::unique_ptr<Announcer> announcer_;
  RemoteControl remote_;
  std::deque<RemoteCommand> commands_;  // not carried out yet
  Subscriptions subscriptions_;
  ItemQueue queue_;
  std::unique_ptr<Receiver> receiver_;
  std::unique_ptr<Destination> destination_;
  std::unique_ptr<FileThread> file_thread_;
  bool present_ = true;  // the server
  bool stop_asked_ = false;
};

}  // namespace flexcast::record
