// SystemTest: the real programs on a DDS domain and in a folder of the test's own. Whatever a test starts ends with it.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clients/client/connection.h"
#include "idl/wire/participant.h"
#include "idl/wire/reader.h"
#include "tests/support/process.h"

namespace flexcast::test {

using namespace std::chrono_literals;
using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

// How long anything may take before a test gives up; nothing is measured by it. Generous: machines are busy.
inline constexpr auto patience = 40s;

struct Ended {
  int code = 0;
  std::string out, err;
};

class SystemTest : public testing::Test {
 protected:
  SystemTest();
  ~SystemTest() override;

  int domain() const { return domain_; }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write_file(const std::string& name, const std::string& content) const;

  // These throw, and so fail the test, when the program does not come to life (or to its end) within `patience`.
  std::unique_ptr<Process> start_server(const std::filesystem::path& scene, Arguments arguments = {}) const;
  std::unique_ptr<Process> start_recorder(const std::string& file, Arguments arguments = {}) const;  // adds --json
  // The same, but it looks for its world still.
  std::unique_ptr<Process> start_waiting_recorder(const std::string& file, Arguments arguments = {}) const;
  std::unique_ptr<Process> start(const std::string& program, const Arguments& arguments) const;
  Ended run(const std::string& program, const Arguments& arguments) const;
  Ended ctl(Arguments arguments) const;      // on this test's domain
  Json ctl_json(Arguments arguments) const;  // must succeed; what it prints with --json

  client::Connection connect(const std::string& world = "") const;

  // Waits until what the (only) recorder tells the domain, once a second, is as wanted.
  void wait_for_recorder(const std::function<bool(const flexcast_RecorderInfo&)>& wanted);
  void wait_for_frames(std::uint64_t frames);  // in all, by the recorder

 private:
  std::filesystem::path folder_;
  int domain_;
  std::optional<wire::Participant> participant_;
  std::optional<wire::Reader<flexcast_RecorderInfo>> recorders_;
};

std::filesystem::path program_path(const std::string& program);  // of this build
std::string read_file(const std::filesystem::path& path);

// The status for which `wanted` is true; throws if none comes within `patience`.
client::Status wait_for_status(client::Connection& connection,
                               const std::function<bool(const flexcast_Status&)>& wanted);

// Sends the signal, waits for the end, which must be a clean one, and returns what the program printed.
std::string end(Process& process, int signal);
Json end_recorder(Process& recorder, int signal = SIGINT);  // the summary
Json await_recorder(Process& recorder);                     // of one that ends on its own

// The value of a reply, which must be that of an applied command.
client::Reply applied(const client::Result<client::Reply>& reply);

}  // namespace flexcast::test
