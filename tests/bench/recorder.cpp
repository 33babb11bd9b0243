// flexcast-recorder-bench: what recording costs beside what receiving costs. A child process publishes frames as fast
// as it can over loopback; in turns a bare loop (take, write to /dev/shm) and the recorder (to /dev/shm, uncompressed,
// with all checksums) take the same amount. Then the file's thread alone.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <thread>

#include "clients/mcap/file_sink.h"
#include "clients/record/recorder.h"
#include "clients/record/recording_file.h"
#include "idl/wire/fill.h"
#include "idl/wire/wait_set.h"

namespace flexcast {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t chunks = 3;
constexpr std::size_t chunk_floats = 200'000;  // three numbers a particle: 2.4 MB a frame
constexpr double frame_bytes = 4.0 * chunks * chunk_floats;
constexpr const char* world = "bench";
constexpr auto patience = 60s;

struct Settings {
  int domain = 210;
  int rounds = 5;
  int frames = 150;  // of each measurement
  bool publish = false;
};

template <class T>
T value_of(wire::Result<T> result) {
  if (result) return std::move(result).value();
  fmt::print(stderr, "flexcast-recorder-bench: {}\n", result.error().message);
  std::exit(1);
}

template <class T>
wire::Owned<T> make_message() {
  wire::Owned<T> message;
  wire::set_string(message->world, world);
  return message;
}

// ---------------------------------------------------------------- the child

// All writers of a server, so that a recorder finds it.
struct Server {
  explicit Server(const wire::Participant& participant)
      : scenes(value_of(wire::Writer<flexcast_SceneInfo>::create(participant))),
        topologies(value_of(wire::Writer<flexcast_Topology>::create(participant))),
        parameters(value_of(wire::Writer<flexcast_ParameterSet>::create(participant))),
        statuses(value_of(wire::Writer<flexcast_Status>::create(participant))),
        replies(value_of(wire::Writer<flexcast_Reply>::create(participant))),
        events(value_of(wire::Writer<flexcast_Event>::create(participant))),
        frames(value_of(wire::Writer<flexcast_ParticleFrame>::create(
            participant, wire::frames_writer_qos(static_cast<std::size_t>(frame_bytes))))) {}

  void introduce() const {
    auto scene = make_message<flexcast_SceneInfo>();
    scene->particles = chunks * chunk_floats / 3;
    wire::set_strings(scene->fields, std::vector<std::string>{"positions"});
    (void)scenes.write(*scene);
  }
  void say_status() const { (void)statuses.write(*make_message<flexcast_Status>()); }

  wire::Writer<flexcast_SceneInfo> scenes;
  wire::Writer<flexcast_Topology> topologies;
  wire::Writer<flexcast_ParameterSet> parameters;
  wire::Writer<flexcast_Status> statuses;
  wire::Writer<flexcast_Reply> replies;
  wire::Writer<flexcast_Event> events;
  wire::Writer<flexcast_ParticleFrame> frames;
};

void publish_frame(const Server& server, std::uint64_t frame, const std::vector<float>& positions) {
  auto sample = make_message<flexcast_ParticleFrame>();
  sample->run_id = 1;
  sample->frame = sample->step = frame;
  sample->chunks = chunks;
  sample->total = chunks * chunk_floats / 3;
  wire::view(sample->positions, positions);
  for (sample->chunk = 0; sample->chunk < chunks; ++sample->chunk) (void)server.frames.write(*sample);
}

[[noreturn]] void publish(const Settings& settings) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto participant = value_of(wire::Participant::create({.domain = settings.domain, .profile = "loopback"}));
  const Server server(participant);
  server.introduce();
  std::vector<float> positions(chunk_floats);
  std::uint32_t random = 1;
  for (float& x : positions) x = static_cast<float>(random = random * 1664525u + 1013904223u);
  auto next_status = Clock::now();
  for (std::uint64_t frame = 0;;) {
    if (Clock::now() >= next_status) {
      server.say_status();
      next_status += 250ms;
    }
    if (server.frames.matched().current > 0) {
      publish_frame(server, frame++, positions);
    } else {
      std::this_thread::sleep_for(1ms);
    }
  }
}

class Child {
 public:
  explicit Child(const Settings& settings) : pid_(fork()) {
    if (pid_ != 0) return;
    const std::string domain = std::to_string(settings.domain);
    execl("/proc/self/exe", "flexcast-recorder-bench", "--publish", "--domain", domain.c_str(), nullptr);
    _exit(1);
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t pid_;
};

// ---------------------------------------------------------------- measuring

struct Cost {
  double bytes = 0;
  double wall = 0;  // s
  double cpu = 0;   // s, of the whole process

  double rate() const { return bytes / 1e6 / wall; }         // MB/s
  double cpu_per_gb() const { return cpu / (bytes / 1e9); }  // s/GB
};

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Meter {
 public:
  Cost cost(double bytes) const {
    return {bytes, std::chrono::duration<double>(Clock::now() - begin_).count(), cpu_seconds() - cpu_};
  }

 private:
  Clock::time_point begin_ = Clock::now();
  double cpu_ = cpu_seconds();
};

std::string scratch_file(const char* name) {
  return fmt::format("/dev/shm/flexcast-recorder-bench-{}-{}", getpid(), name);
}

// The least that a recorder could do.
Cost measure_bare_loop(const Settings& settings) {
  const std::string path = scratch_file("bare");
  const auto participant = value_of(wire::Participant::create({.domain = settings.domain, .profile = "loopback"}));
  const auto reader =
      value_of(wire::RawReader::create(participant, wire::topic(wire::TopicId::frames),
                                       wire::frames_recorder_qos(static_cast<std::size_t>(frame_bytes), chunks)));
  auto sink = mcap::FileSink::create(path, {.replace_existing = true});
  double bytes = 0;
  std::optional<Meter> meter;
  const auto take = [&](const wire::RawSample& sample) {
    if (!meter) meter.emplace();
    bytes += static_cast<double>(sample.bytes.size());
    if (!sink.value()->write(sample.bytes)) std::exit(1);
  };
  const double wanted = settings.frames * frame_bytes;
  for (const auto latest = Clock::now() + patience; bytes < wanted && Clock::now() < latest;) {
    reader.wait(100ms);
    (void)value_of(reader.take_raw(take));
  }
  const Cost cost = meter ? meter->cost(bytes) : Cost{};
  // A reader that is full could not be deleted.
  while (value_of(reader.take_raw([](const wire::RawSample&) {})) > 0) {
  }
  std::filesystem::remove(path);
  return cost;
}

Cost measure_recorder(const Settings& settings) {
  record::Options options;
  options.file = scratch_file("recorder.mcap");
  options.world = world;
  options.domain = settings.domain;
  options.profile = "loopback";
  options.compression = mcap::Compression::kNone;
  options.force = true;
  auto recorder = value_of(record::Recorder::start(options, [] { return false; }));
  const auto latest = Clock::now() + patience;
  while (recorder->progress().frames == 0 && Clock::now() < latest) std::this_thread::sleep_for(1ms);
  const Meter meter;
  const std::uint64_t before = recorder->progress().frames;
  const std::uint64_t wanted = before + static_cast<std::uint64_t>(settings.frames);
  while (recorder->progress().frames < wanted && Clock::now() < latest) std::this_thread::sleep_for(5ms);
  const record::Report report = value_of(recorder->finish());
  // Incomplete frames were received and written, too.
  const double share = 1 - static_cast<double>(before) / static_cast<double>(record::frame_count(report));
  const Cost cost = meter.cost(share * static_cast<double>(report.bytes));
  std::filesystem::remove(options.file);
  return cost;
}

// MB/s of the file's thread, by its own processor time.
double measure_file_thread(const Settings& settings) {
  const std::string path = scratch_file("file.mcap");
  auto sink = mcap::FileSink::create(path, {.replace_existing = true});
  auto file = record::RecordingFile::create(*sink.value(), mcap::Compression::kNone);
  const std::vector<std::byte> bytes(4 * chunk_floats, std::byte{7});
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  record::Item item = record::Message{.topic = wire::TopicId::frames, .bytes = bytes};
  const double begin = now();
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(settings.frames) * chunks; ++i) {
    std::get<record::Message>(item).sequence = i;
    if (!file.value()->write(item)) std::exit(1);
  }
  if (!file.value()->close()) std::exit(1);
  const double seconds = now() - begin;
  std::filesystem::remove(path);
  return settings.frames * frame_bytes / 1e6 / seconds;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run(const Settings& settings) {
  std::vector<double> ratios, rates;
  {
    const Child child(settings);
    fmt::print("| round | bare MB/s | bare CPU s/GB | recorder MB/s | recorder CPU s/GB | ratio of CPU |\n");
    fmt::print("|---|---|---|---|---|---|\n");
    for (int round = 0; round < settings.rounds; ++round) {
      const Cost bare = measure_bare_loop(settings);
      const Cost recorder = measure_recorder(settings);
      ratios.push_back(recorder.cpu_per_gb() / bare.cpu_per_gb());
      fmt::print("| {} | {:.0f} | {:.2f} | {:.0f} | {:.2f} | {:.2f} |\n", round, bare.rate(), bare.cpu_per_gb(),
                 recorder.rate(), recorder.cpu_per_gb(), ratios.back());
      std::fflush(stdout);
    }
  }
  for (int round = 0; round < settings.rounds; ++round) rates.push_back(measure_file_thread(settings));
  fmt::print("\nmedian ratio of CPU: {:.2f}\nfile thread alone, median: {:.0f} MB/s of processor time\n",
             median(ratios), median(rates));
}

}  // namespace
}  // namespace flexcast

int main(int argc, char** argv) {
  flexcast::Settings settings;
  CLI::App app("What recording costs beside what receiving costs.", "flexcast-recorder-bench");
  app.add_option("--domain", settings.domain, "DDS domain; default 210");
  app.add_option("--rounds", settings.rounds, "of both measurements; default 5")->check(CLI::Range(1, 1000));
  app.add_option("--frames", settings.frames, "of 2.4 MB in each measurement; default 150")->check(CLI::Range(2, 2000));
  app.add_flag("--publish", settings.publish)->group("");
  app.set_version_flag("--version", std::string("flexcast-recorder-bench ") + FLEXCAST_VERSION);
  app.footer("\nExample:\n  flexcast-recorder-bench --rounds 3");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (settings.publish) flexcast::publish(settings);
  flexcast::run(settings);
  return 0;
}
