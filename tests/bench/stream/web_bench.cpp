// flexcast-web-bench: what flexcast-web delivers to fast and slow clients, and what it costs.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/bench/stream/child.h"
#include "tests/bench/stream/frame_feed.h"
#include "tests/bench/stream/frame_tally.h"
#include "tests/bench/stream/percentiles.h"
#include "tests/bench/stream/subscriber.h"
#include "tests/bench/stream/web_consumer.h"

namespace {

using namespace flexcast;
using namespace flexcast::bench;
using namespace std::chrono_literals;

constexpr const char* example = R"(
Example:
  flexcast-web-bench --seconds 10

Frames are published at a rate, and flexcast-web sends them to one client, to three, and to three beside one that takes
a frame each 50 ms. A row: frames a second that were published, that the slowest of the fast clients and that the slow
one got; CPU time of flexcast-web as a part of a core and its resident memory, from /proc; latency at the median from
the end of a step to the client's last byte, and to a plain DDS subscriber beside it.)";

constexpr auto slow_pause = 50ms;

struct Settings {
  int domain = 97;
  double seconds = 5.0;
  double rate = 60.0;
  std::int64_t kilobytes = 2400;
  std::int64_t particles() const { return 1000 * kilobytes / 12; }
};

// flexcast-web as a child process.
class Bridge {
 public:
  explicit Bridge(int domain)
      : program_((std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flexcast-web").string()),
        child_(program_, {"--port", "0", "--domain", std::to_string(domain)}) {
    const std::string ready = child_.hear();  // ready: http://127.0.0.1:PORT/
    port_ = static_cast<std::uint16_t>(std::atoi(ready.c_str() + ready.rfind(':') + 1));
  }
  std::uint16_t port() const { return port_; }

  double cpu_seconds() const {
    std::ifstream file("/proc/" + std::to_string(child_.pid()) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 2));
    std::string skipped;
    for (int i = 0; i < 11; ++i) fields >> skipped;
    double user = 0, system = 0;
    fields >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  double resident_megabytes() const {
    std::ifstream file("/proc/" + std::to_string(child_.pid()) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
    return 0.0;
  }

 private:
  std::string program_;
  Child child_;
  std::uint16_t port_ = 0;
};

std::uint64_t push_for(FrameFeed& feed, double rate, double seconds) {
  std::uint64_t frames = 0;
  const auto begin = std::chrono::steady_clock::now();
  const auto period = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(1.0 / rate));
  for (auto next = begin; next < begin + std::chrono::duration<double>(seconds); next += period, ++frames) {
    std::this_thread::sleep_until(next);
    feed.push();
  }
  return frames;
}

void bench_row(const Settings& settings, int fast, int slow, bool with_subscriber) {
  const auto participant = join(settings.domain);
  FrameFeed feed(participant, settings.particles());
  const Bridge bridge(settings.domain);
  push_for(feed, settings.rate, 0.5);
  std::vector<std::unique_ptr<WebConsumer>> clients;
  for (int i = 0; i < fast + slow; ++i)
    clients.push_back(std::make_unique<WebConsumer>(bridge.port(), i < fast ? 0ms : slow_pause));
  std::unique_ptr<Child> subscriber;
  if (with_subscriber) {
    subscriber = std::make_unique<Child>(
        "/proc/self/exe", std::vector<std::string>{"--subscriber", std::to_string(12 * settings.particles()),
                                                   "--domain", std::to_string(settings.domain)});
    subscriber->hear();
  }
  push_for(feed, settings.rate, 1.0);
  for (const auto& client : clients) client->clear();
  if (subscriber) subscriber->tell("clear");
  const double cpu = bridge.cpu_seconds(), begin = monotonic_seconds();
  const auto published = static_cast<double>(push_for(feed, settings.rate, settings.seconds));
  const double span = monotonic_seconds() - begin;
  const double cost = (bridge.cpu_seconds() - cpu) / span;
  std::this_thread::sleep_for(100ms);
  double least = 1e9, slow_rate = 0.0;
  std::vector<double> latencies;
  for (std::size_t i = 0; i < clients.size(); ++i) {
    const Consumption got = clients[i]->consumption();
    const double rate = static_cast<double>(got.frames) / span;
    if (i >= static_cast<std::size_t>(fast)) {
      slow_rate = rate;
    } else {
      least = std::min(least, rate);
      latencies.insert(latencies.end(), got.latencies.begin(), got.latencies.end());
    }
  }
  std::string direct = "-";
  if (subscriber) {
    subscriber->tell("report");
    const auto report = nlohmann::json::parse(subscriber->hear());
    if (report.contains("ours")) direct = fmt::format("{:.2f}", 1e3 * report["ours"]["p50"].get<double>());
  }
  std::puts(fmt::format("{} fast, {} slow  published {:5.1f}  fast {:5.1f}  slow {:5.1f}  CPU {:5.1f} %  RSS {:5.1f} MB"
                        "  latency p50 {:6.2f} ms, p99 {:6.2f} ms, DDS alone {} ms",
                        fast, slow, published / span, least, slow_rate, 100.0 * cost, bridge.resident_megabytes(),
                        1e3 * calc_percentile(latencies, 0.5), 1e3 * calc_percentile(latencies, 0.99), direct)
                .c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::size_t subscriber = 0;
  CLI::App app("Measures what flexcast-web delivers and costs.", "flexcast-web-bench");
  app.footer(example);
  app.add_option("--seconds", settings.seconds, "of each row; default 5")->check(CLI::Range(0.3, 3600.0));
  app.add_option("--rate", settings.rate, "frames a second; default 60")->check(CLI::Range(1.0, 1000.0));
  app.add_option("--kilobytes", settings.kilobytes, "of a frame; default 2400")->check(CLI::Range(12, 100'000));
  app.add_option("--domain", settings.domain, "DDS domain; default 97")->check(CLI::Range(0, 230));
  app.add_option("--subscriber", subscriber, "be the plain reader, of frames of so many bytes")->group("");
  app.set_version_flag("--version", std::string("flexcast-web-bench ") + FLEXCAST_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (subscriber > 0) return run_subscriber(settings.domain, subscriber);
  spdlog::set_level(spdlog::level::warn);
  bench_row(settings, 1, 0, false);
  bench_row(settings, 3, 0, false);
  bench_row(settings, 3, 1, false);
  bench_row(settings, 1, 0, true);
  return 0;
}
