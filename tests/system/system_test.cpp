#include "tests/system/system_test.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace flexcast::test {
namespace {

namespace fs = std::filesystem;

// Below 100 the ports of a domain stay out of the range from which the system deals them out.
constexpr int lowest_domain = 1;
constexpr int highest_domain = 99;

// Whether some participant has the domain's first port (DDSI: 7400 + 250 domain + 10).
bool is_in_use(int domain) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7410 + 250 * domain));
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  const bool bound = bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(socket);
  return !bound;
}

// By process and test, so that neither two runs of this program nor two of its tests meet.
int choose_domain() {
  static int count = 0;
  constexpr int domains = highest_domain - lowest_domain + 1;
  for (int tries = 0; tries < domains; ++tries) {
    const int domain = lowest_domain + (static_cast<int>(getpid()) + 37 * count++) % domains;
    if (!is_in_use(domain)) return domain;
  }
  throw std::runtime_error("every DDS domain is in use");
}

std::string make_folder() {
  std::string folder = fs::temp_directory_path() / "flexcast-system-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("cannot make " + folder);
  return folder;
}

void expect_line(Process& process, const std::string& part) {
  if (process.wait_for_line(part, patience)) return;
  const std::string state = process.runs() ? "still runs" : "has ended";
  throw std::runtime_error(process.command() + " did not say '" + part + "' and " + state + ":\n" + process.err());
}

}  // namespace

SystemTest::SystemTest() : folder_(make_folder()), domain_(choose_domain()) {
  unsetenv("CYCLONEDDS_URI");  // the profile is loopback, for the programs and for us
}

SystemTest::~SystemTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path SystemTest::write_file(const std::string& name, const std::string& content) const {
  const fs::path file = path(name);
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::unique_ptr<Process> SystemTest::start(const std::string& program, const Arguments& arguments) const {
  return std::make_unique<Process>(program_path(program), arguments);
}

std::unique_ptr<Process> SystemTest::start_server(const fs::path& scene, Arguments arguments) const {
  arguments.insert(arguments.begin(), {scene.string(), "--domain", std::to_string(domain_)});
  auto server = start("flexcast-server", arguments);
  expect_line(*server, "ready:");
  return server;
}

std::unique_ptr<Process> SystemTest::start_waiting_recorder(const std::string& file, Arguments arguments) const {
  arguments.insert(arguments.begin(), {"-o", path(file).string(), "--domain", std::to_string(domain_), "--json"});
  return start("flexcast-record", arguments);
}

std::unique_ptr<Process> SystemTest::start_recorder(const std::string& file, Arguments arguments) const {
  auto recorder = start_waiting_recorder(file, std::move(arguments));
  expect_line(*recorder, "recording:");
  return recorder;
}

Ended SystemTest::run(const std::string& program, const Arguments& arguments) const {
  const auto process = start(program, arguments);
  const auto code = process->wait(patience);
  if (!code) throw std::runtime_error(process->command() + " does not end");
  return {*code, process->out(), process->err()};
}

Ended SystemTest::ctl(Arguments arguments) const {
  arguments.insert(arguments.begin(), {"--domain", std::to_string(domain_)});
  return run("flexcast-ctl", arguments);
}

Json SystemTest::ctl_json(Arguments arguments) const {
  arguments.push_back("--json");
  const Ended ended = ctl(std::move(arguments));
  if (ended.code != 0) throw std::runtime_error("flexcast-ctl failed: " + ended.err);
  return Json::parse(ended.out);
}

client::Connection SystemTest::connect(const std::string& world) const {
  auto connection = client::Connection::open({.world = world, .domain = domain_, .wait = patience});
  if (!connection) throw std::runtime_error(connection.error().message);
  return std::move(connection).value();
}

void SystemTest::wait_for_recorder(const std::function<bool(const flexcast_RecorderInfo&)>& wanted) {
  if (!recorders_) {
    participant_ = wire::Participant::create({.domain = domain_}).value();
    recorders_ = wire::Reader<flexcast_RecorderInfo>::create(*participant_).value();
  }
  for (const client::Deadline deadline(patience); !deadline.passed();) {
    recorders_->wait(deadline.left());
    const auto samples = recorders_->take();
    for (const auto [recorder, info] : samples.value()) {
      if (info.valid && wanted(recorder)) return;
    }
  }
  throw std::runtime_error("the recorder does not come to what the test waits for");
}

void SystemTest::wait_for_frames(std::uint64_t frames) {
  wait_for_recorder([&](const flexcast_RecorderInfo& recorder) { return recorder.frames >= frames; });
}

fs::path program_path(const std::string& program) {
  return fs::path(FLEXCAST_BINARY_DIR) / "bin" / program;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return std::move(std::ostringstream() << file.rdbuf()).str();
}

client::Status wait_for_status(client::Connection& connection,
                               const std::function<bool(const flexcast_Status&)>& wanted) {
  for (const client::Deadline deadline(patience); !deadline.passed();) {
    const auto status = connection.status();
    if (status && wanted(*status.value())) return status.value();
  }
  throw std::runtime_error("no status as the test waits for");
}

std::string end(Process& process, int signal) {
  process.send(signal);
  const auto code = process.wait(patience);
  if (!code) throw std::runtime_error(process.command() + " does not end");
  EXPECT_EQ(*code, 0) << process.command();
  return process.out();
}

Json end_recorder(Process& recorder, int signal) {
  return Json::parse(end(recorder, signal));
}

Json await_recorder(Process& recorder) {
  if (!recorder.wait(patience)) {
    throw std::runtime_error(recorder.command() + " waits for more and has this:\n" + end(recorder, SIGINT));
  }
  return end_recorder(recorder);
}

client::Reply applied(const client::Result<client::Reply>& reply) {
  if (!reply) throw std::runtime_error(reply.error().message);
  EXPECT_TRUE(reply.value().applied()) << reply.value().reason;
  return reply.value();
}

}  // namespace flexcast::test
