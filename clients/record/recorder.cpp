#include "clients/record/recorder.h"

#include <filesystem>
#include <thread>

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::size_t queue_bytes = std::size_t{256} << 20;
constexpr auto match_period = 5ms;
// Until the server surely knows of the match too, and a world that stands still has sent its newest frame again.
constexpr auto settle_time = 300ms;

// What can be said before there is anything to record.
wire::Result<void> check_output(const Options& options) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path path = options.file;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) return wire::Error{"there is no folder " + folder.string()};
  if (fs::is_directory(path, ignored)) return wire::Error{path.string() + " is a folder"};
  if (fs::exists(path, ignored) && !options.force) {
    return wire::Error{path.string() + " exists already: give another name, or --force to replace it"};
  }
  return {};
}

Limits limits_of(const Options& options) {
  Limits limits;
  if (options.frames) limits.frames = *options.frames;
  if (options.duration) {
    limits.duration =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(*options.duration));
  }
  return limits;
}

}  // namespace

wire::Result<std::unique_ptr<Recorder>> Recorder::start(const Options& options, const Interrupted& interrupted) {
  if (auto checked = check_output(options); !checked) return checked.error();
  auto participant =
      wire::Participant::create({.domain = options.domain, .profile = options.profile, .security = options.security});
  if (!participant) return participant.error();
  auto watch = wire::WorldWatch::create(participant.value());
  if (!watch) return watch.error();
  const std::chrono::duration<double> wait(options.wait);
  const auto found = find_world(watch.value(), participant.value(), options.world, wait, interrupted);
  if (!found) return found.error();
  const std::string& world = found.value().name;
  auto announcer = Announcer::create(participant.value(), world, options.file);
  if (!announcer) return announcer.error();
  auto subscriptions = Subscriptions::create(participant.value(), world);
  if (!subscriptions) return subscriptions.error();

  std::unique_ptr<Recorder> recorder(new Recorder(std::move(participant).value(), std::move(watch).value(),
                                                  std::move(announcer).value(), std::move(subscriptions).value(), world,
                                                  options.file));
  if (auto matched = recorder->wait_for_match(wait, interrupted); !matched) return matched.error();
  if (auto opened = recorder->open(options); !opened) return opened.error();
  return recorder;
}

Recorder::Recorder(wire::Participant participant, wire::WorldWatch watch, Announcer announcer,
                   Subscriptions subscriptions, const std::string& world, const std::string& path)
    : world_(world),
      path_(path),
      participant_(std::move(participant)),
      watch_(std::move(watch)),
      announcer_(std::move(announcer)),
      subscriptions_(std::move(subscriptions)),
      queue_(queue_bytes) {}

wire::Result<void> Recorder::wait_for_match(std::chrono::duration<double> wait, const Interrupted& interrupted) {
  const std::string place = describe_place(world_, participant_);
  announcer_.announce(flexcast_RECORDER_WAITING, {}, 0);
  for (const auto begin = Clock::now();;) {
    watch_.update();
    const wire::World* world = watch_.find(world_);
    if (world && subscriptions_.is_matched(world->participant)) break;
    if (interrupted()) return wire::Error{"interrupted while connecting to " + place};
    if (Clock::now() - begin > wait) return wire::Error{place + " does not publish all topics of a server"};
    std::this_thread::sleep_for(match_period);
  }
  std::this_thread::sleep_for(settle_time);
  return {};
}

wire::Result<void> Recorder::open(const Options& options) {
  auto sink = mcap::FileSink::create(path_, {.replace_existing = options.force});
  if (!sink) return wire::Error{sink.status().message()};
  sink_ = std::move(sink).value();
  auto file = RecordingFile::create(*sink_, options.compression);
  if (!file) return wire::Error{file.status().message()};
  file_ = std::move(file).value();
  auto receiver = Receiver::create(participant_, subscriptions_, queue_, world_, limits_of(options));
  if (!receiver) return receiver.error();
  receiver_ = std::move(receiver).value();
  file_thread_ = std::make_unique<FileThread>(queue_, *file_);
  file_thread_->start();
  receiver_->start();
  announcer_.announce(flexcast_RECORDER_RECORDING, {}, 0);
  return {};
}

std::string Recorder::tend() {
  watch_.update();
  const bool present = watch_.find(world_) != nullptr;
  announcer_.announce(present ? flexcast_RECORDER_RECORDING : flexcast_RECORDER_WAITING, progress(), bytes_written());
  if (present == std::exchange(present_, present)) return "";
  return describe_place(world_, participant_) + (present ? " is back" : " has gone: waiting for it");
}

wire::Result<Report> Recorder::finish() {
  receiver_->stop();
  Report report{.file = path_,
                .world = world_,
                .domain = domain(),
                .profile = participant_.profile(),
                .reception = receiver_->reception()};
  mcap::Status status = file_thread_->finish();
  if (status) status = complete(report);
  std::string error = status.message();
  if (status && report.reception.end == EndReason::failed) error = report.reception.error;
  announcer_.announce(error.empty() ? flexcast_RECORDER_FINISHED : flexcast_RECORDER_FAILED, progress(),
                      file_->bytes_written(), error);
  if (!error.empty()) return wire::Error{error};
  return report;
}

mcap::Status Recorder::complete(Report& report) {
  if (auto status = file_->add_metadata("flexcast.recording", recording_metadata(report)); !status) return status;
  if (auto status = file_->add_metadata("flexcast.gaps", gaps_metadata(report)); !status) return status;
  report.messages = file_->messages();
  if (auto status = file_->close(); !status) return status;
  report.bytes = file_->bytes_written();
  return sink_->close();
}

}  // namespace flexcast::record
