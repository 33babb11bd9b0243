// A server without physics: answers commands from a small parameter table, publishes statuses and, on demand, frames.
// It remembers replies and executes a repeated request once.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "clients/client/value.h"
#include "idl/wire/fill.h"
#include "idl/wire/names.h"
#include "idl/wire/reader.h"
#include "idl/wire/writer.h"
#include "tests/support/network.h"

namespace flexcast::test {

class FakeServer {
 public:
  explicit FakeServer(std::string world, std::uint64_t server_id = 1, std::string version = "0")
      : world_(std::move(world)), server_id_(server_id), version_(std::move(version)) {
    wire::Owned<flexcast_SceneInfo> scene;
    wire::set_string(scene->world, world_);
    scene->particles = 2;
    (void)scenes_.write(*scene);
    thread_ = std::jthread([this](std::stop_token stop) { serve(stop); });
  }

  std::atomic<int> received{0};  // commands, repeated ones too
  std::atomic<int> executed{0};
  std::atomic<int> ignore{0};      // so many commands get lost
  std::atomic<int> deaf{0};        // so many replies get lost
  std::atomic<bool> quiet{false};  // no statuses
  std::atomic<bool> stuck{false};  // statuses, but the step loop stands still

  // Falls silent, as one that ends on purpose.
  void say_goodbye() {
    quiet = true;
    wire::Owned<flexcast_Status> status;
    wire::set_string(status->world, world_);
    const std::scoped_lock lock(status_mutex_);
    (void)statuses_.dispose(*status);
  }
  std::atomic<int> statuses{0};  // sent

  const wire::Participant& participant() const { return participant_; }

  // From now on its statuses are of this run and say that it did not publish these: first, last, first, last, ...
  // Returns when one has said so, unless it is quiet.
  void say_unpublished(std::uint64_t run_id, std::vector<std::uint64_t> ranges) {
    {
      const std::scoped_lock lock(unpublished_mutex_);
      run_id_ = run_id;
      unpublished_ = std::move(ranges);
    }
    for (const int before = statuses; !quiet && statuses < before + 2;) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  // Whether somebody reads its frames.
  bool is_read() const { return frames_.matched().current > 0; }

  // One frame of `chunks` chunks with two particles each, or the first `sent` of them: x counts up over the frame from
  // 100 * frame.
  void publish(std::uint64_t run_id, std::uint64_t frame, std::uint32_t chunks = 1, std::uint32_t sent = ~0u) const {
    for (std::uint32_t chunk = 0; chunk < std::min(chunks, sent); ++chunk) {
      wire::Owned<flexcast_ParticleFrame> sample;
      wire::set_string(sample->world, world_);
      sample->run_id = run_id;
      sample->frame = sample->step = frame;
      sample->parameter_revision = revision_;
      sample->chunk = chunk;
      sample->chunks = chunks;
      sample->first = 2 * chunk;
      sample->total = 2 * chunks;
      const float x = 100.0f * static_cast<float>(frame) + 2.0f * static_cast<float>(chunk);
      wire::copy(sample->positions, std::array{x, 0.0f, 0.0f, x + 1.0f, 0.0f, 0.0f});
      (void)frames_.write(*sample);
    }
  }

 private:
  using Parameter = client::Parameter;

  void serve(const std::stop_token& stop) {
    auto next_status = std::chrono::steady_clock::now();
    while (!stop.stop_requested()) {
      if (!quiet && std::chrono::steady_clock::now() >= next_status) {
        next_status += std::chrono::milliseconds(50);
        publish_status();
      }
      (void)commands_.wait(std::chrono::milliseconds(5));
      const auto samples = commands_.take();
      for (const auto [command, info] : samples.value())
        if (info.valid && wire::text(command.world) == world_) receive(command);
    }
  }

  void publish_status() {
    const std::scoped_lock lock(status_mutex_);
    if (quiet) return;
    wire::Owned<flexcast_Status> status;
    wire::set_string(status->world, world_);
    status->state = state_;
    status->server_id = server_id_;
    if (!stuck) ++heartbeat_;
    status->heartbeat = heartbeat_;
    status->report.step = step_;
    status->report.min_j = std::nan("");
    status->rate = 1;
    wire::set_string(status->version, version_);
    {
      const std::scoped_lock run_lock(unpublished_mutex_);
      status->run_id = run_id_;
      wire::copy(status->unpublished, unpublished_);
    }
    (void)statuses_.write(*status);
    ++statuses;
  }

  void receive(const flexcast_Command& command) {
    ++received;
    if (ignore > 0) {
      --ignore;
      return;
    }
    const std::pair key{std::string(wire::text(command.client_id)), command.request_id};
    auto known = replies_sent_.find(key);
    if (known == replies_sent_.end()) {
      wire::Owned<flexcast_Reply> reply;
      wire::set_string(reply->world, world_);
      wire::set_string(reply->client_id, key.first);
      reply->request_id = key.second;
      reply->kind = command.kind;
      ++executed;
      execute(command, *reply);
      reply->applied_step = step_;
      reply->state = state_;
      reply->parameter_revision = revision_;
      known = replies_sent_.emplace(key, std::move(reply)).first;
    }
    if (deaf > 0)
      --deaf;
    else
      (void)replies_.write(*known->second);
  }

  void execute(const flexcast_Command& command, flexcast_Reply& reply) {
    switch (command.kind) {
      case flexcast_COMMAND_SET:
        return set(command, reply);
      case flexcast_COMMAND_GET:
        return get(command, reply);
      case flexcast_COMMAND_DESCRIBE:
        return describe(reply);
      case flexcast_COMMAND_RESET:
        step_ = 0;
        return;
      case flexcast_COMMAND_PAUSE:
        state_ = flexcast_WORLD_PAUSED;
        return;
      case flexcast_COMMAND_RESUME:
        state_ = flexcast_WORLD_RUNNING;
        return;
      case flexcast_COMMAND_STEP:
        step_ += command.count;
        return;
      case flexcast_COMMAND_RUN_UNTIL:
        step_ = static_cast<std::uint64_t>(command.time * 1000);
        return;
      case flexcast_COMMAND_SAVE:
        saved_[std::string(wire::text(command.name))] = step_;
        return;
      case flexcast_COMMAND_RESTORE:
        return restore(std::string(wire::text(command.name)), reply);
      case flexcast_COMMAND_GRAB:
        grabbed_[command.particle] =
            client::to_text(client::Vector{command.target[0], command.target[1], command.target[2]}) + " m, " +
            client::to_text(command.stiffness) + " N/m";
        return;
      case flexcast_COMMAND_RELEASE:
        return release(command.particle, reply);
      case flexcast_COMMAND_STATUS:
        return;
      default:
        reply.outcome = flexcast_OUTCOME_UNSUPPORTED;
        wire::set_string(reply.reason, std::string(wire::name_of(command.kind)) + " is not supported");
    }
  }

  static void reject(flexcast_Reply& reply, const std::string& reason) {
    reply.outcome = flexcast_OUTCOME_REJECTED;
    wire::set_string(reply.reason, reason);
  }

  void restore(const std::string& name, flexcast_Reply& reply) {
    const auto saved = saved_.find(name);
    if (saved == saved_.end()) return reject(reply, "there is no checkpoint '" + name + "'");
    step_ = saved->second;
  }

  // Tells in the reply's values what was pulled where.
  void release(std::uint32_t particle, flexcast_Reply& reply) {
    const auto grabbed = grabbed_.extract(particle);
    if (grabbed.empty()) return reject(reply, "particle " + std::to_string(particle) + " is not grabbed");
    put({{"released", grabbed.mapped()}}, reply);
  }

  void set(const flexcast_Command& command, flexcast_Reply& reply) {
    if (command.check_revision && command.expected_revision != revision_) {
      return reject(reply, "parameter revision " + std::to_string(revision_) + " is in force, not " +
                               std::to_string(command.expected_revision));
    }
    std::vector<Parameter> changed;
    for (const auto& value : wire::elements(command.values)) {
      changed.push_back(client::from_wire(value));
      const auto known = values_.find(changed.back().name);
      if (known == values_.end() || known->second.index() != changed.back().value.index()) {
        return reject(reply,
                      "no parameter takes " + changed.back().name + " = " + client::to_text(changed.back().value));
      }
    }
    for (const auto& parameter : changed) values_[parameter.name] = parameter.value;
    ++revision_;
    put(changed, reply);
  }

  void get(const flexcast_Command& command, flexcast_Reply& reply) const {
    std::vector<Parameter> wanted;
    for (const auto& value : wire::elements(command.values)) {
      const auto known = values_.find(std::string(wire::text(value.name)));
      if (known != values_.end()) wanted.push_back({known->first, known->second});
    }
    if (wire::elements(command.values).empty())
      for (const auto& [name, value] : values_) wanted.push_back({name, value});
    put(wanted, reply);
  }

  static void put(const std::vector<Parameter>& values, flexcast_Reply& reply) {
    auto slots = wire::resize(reply.values, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) client::to_wire(slots[i], values[i]);
  }

  void describe(flexcast_Reply& reply) const {
    auto slots = wire::resize(reply.descriptors, values_.size());
    std::size_t i = 0;
    std::vector<Parameter> all;
    for (const auto& [name, value] : values_) {
      auto& descriptor = slots[i++];
      wire::set_string(descriptor.name, name);
      descriptor.kind = client::kind_of(value);
      descriptor.minimum = -INFINITY;
      descriptor.maximum = INFINITY;
      descriptor.live = true;
      client::to_wire(descriptor.initial, {name, value});
      wire::set_string(descriptor.description, "about " + name);
      all.push_back({name, value});
    }
    put(all, reply);
  }

  std::string world_;
  std::uint64_t server_id_;
  std::string version_;
  std::mutex status_mutex_;  // between statuses and the goodbye
  wire::Participant participant_ = join_test_domain();
  wire::Writer<flexcast_SceneInfo> scenes_ = wire::Writer<flexcast_SceneInfo>::create(participant_).value();
  // Of the topics that a recorder waits for and nothing is published on.
  wire::Writer<flexcast_Topology> topologies_ = wire::Writer<flexcast_Topology>::create(participant_).value();
  wire::Writer<flexcast_ParameterSet> parameters_ = wire::Writer<flexcast_ParameterSet>::create(participant_).value();
  wire::Writer<flexcast_Event> events_ = wire::Writer<flexcast_Event>::create(participant_).value();
  wire::Writer<flexcast_Status> statuses_ = wire::Writer<flexcast_Status>::create(participant_).value();
  wire::Writer<flexcast_Reply> replies_ = wire::Writer<flexcast_Reply>::create(participant_).value();
  wire::Writer<flexcast_ParticleFrame> frames_ = wire::Writer<flexcast_ParticleFrame>::create(participant_).value();
  wire::Reader<flexcast_Command> commands_ = wire::Reader<flexcast_Command>::create(participant_).value();
  std::mutex unpublished_mutex_;  // for the two below
  std::uint64_t run_id_ = 0;
  std::vector<std::uint64_t> unpublished_;
  flexcast_WorldState state_ = flexcast_WORLD_RUNNING;
  std::uint64_t step_ = 0, heartbeat_ = 0;
  std::atomic<std::uint64_t> revision_{0};
  std::map<std::string, client::Value> values_{{"beam.young", 1e6},
                                               {"gravity", client::Vector{0, 0, -9.81}},
                                               {"solver.linear", std::string("auto")},
                                               {"time.substeps", std::int64_t{1}}};
  std::map<std::string, std::uint64_t> saved_;    // steps
  std::map<std::uint32_t, std::string> grabbed_;  // "[x, y, z] m, k N/m"
  std::map<std::pair<std::string, std::uint64_t>, wire::Owned<flexcast_Reply>> replies_sent_;
  std::jthread thread_;  // last: everything else is there while it runs
};

}  // namespace flexcast::test
