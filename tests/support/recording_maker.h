// RecordingMaker: writes a recording message by message, as flexcast-record does, without a network. The world "beam"
// is one tetrahedron (body "block": particles 0 to 3) and one spring (body "rope": particles 4 and 5); a frame is every
// 0.1 s.
#pragma once

#include <unistd.h>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clients/mcap/file_sink.h"
#include "clients/mcap/writer.h"
#include "idl/wire/fill.h"
#include "idl/wire/owned.h"
#include "idl/wire/topics.h"
#include "tests/support/encode.h"

namespace flexcast::test {

class RecordingMaker {
 public:
  static constexpr std::uint32_t particles = 6;

  // `chunk_bytes`: of the MCAP file.
  explicit RecordingMaker(const std::string& path, std::size_t chunk_bytes = std::size_t{1} << 20)
      : sink_(mcap::FileSink::create(path, {.replace_existing = true}).value()),
        writer_(*sink_, {.chunk_bytes = chunk_bytes}) {
    for (const wire::TopicRow& row : wire::topic_table()) {
      const auto schema = writer_.add_schema(row.type_name, "omgidl", std::string_view("text")).value();
      channels_[row.id] = writer_.add_channel(row.name, "cdr", schema).value();
    }
  }

  void add_scene(std::uint64_t run_id, const std::string& precision = "float64",
                 const std::vector<std::string>& fields = {"positions", "velocities"}) {
    auto scene = make<flexcast_SceneInfo>(run_id);
    scene->topology_revision = 1;
    scene->particles = particles;
    wire::set_string(scene->precision, precision);
    wire::set_strings(scene->fields, fields);
    const auto bodies = wire::resize(scene->bodies, 2);
    wire::set_string(bodies[0].name, "block");
    wire::set_string(bodies[1].name, "rope");
    auto& probe = wire::resize(scene->probes, 1)[0];
    wire::set_string(probe.name, "tip");
    wire::set_string(probe.body, "rope");
    probe.particle = 5;
    add(*scene);
  }

  void add_topology(std::uint64_t run_id) {
    for (const std::uint32_t body : {0u, 1u}) {
      auto topology = make<flexcast_Topology>(run_id);
      topology->topology_revision = 1;
      topology->body = body;
      topology->chunks = 1;
      if (body == 0) wire::copy(topology->tetrahedra, std::array<std::uint32_t, 4>{0, 1, 2, 3});
      if (body == 1) wire::copy(topology->springs, std::array<std::uint32_t, 2>{4, 5});
      add(*topology);
    }
  }

  void add_parameters(std::uint64_t run_id, std::uint64_t revision) {
    auto set = make<flexcast_ParameterSet>(run_id);
    set->parameter_revision = revision;
    add(*set);
  }

  void add_event(std::uint64_t run_id, std::uint64_t index) {
    auto event = make<flexcast_Event>(run_id);
    event->index = index;
    add(*event);
  }

  void add_status(std::uint64_t run_id, std::uint64_t step, double kinetic) {
    auto status = make<flexcast_Status>(run_id);
    status->state = flexcast_WORLD_RUNNING;
    status->heartbeat = 1000 + step;
    status->server_id = 7;
    status->report.step = step;
    status->report.kinetic = kinetic;
    wire::set_string(status->version, "9.8.7");
    add(*status);
  }

  // Coordinate c of particle p is frame + 0.01 (3 p + c), its velocity the negative of that. Chunks are of one body
  // each.
  void add_frame(std::uint64_t run_id, std::uint64_t number, std::uint64_t parameter_revision = 1,
                 std::uint32_t chunks = 1) {
    for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) add_chunk(run_id, number, parameter_revision, chunk, chunks);
  }

  void add_chunk(std::uint64_t run_id, std::uint64_t number, std::uint64_t parameter_revision, std::uint32_t chunk,
                 std::uint32_t chunks) {
    auto frame = make<flexcast_ParticleFrame>(run_id);
    frame->frame = number;
    frame->step = 10 * number;
    frame->time = calc_time(number);
    frame->parameter_revision = parameter_revision;
    frame->topology_revision = 1;
    frame->chunk = chunk;
    frame->chunks = chunks;
    frame->first = chunk == 0 ? 0 : 4;
    frame->total = particles;
    const std::uint32_t end = chunks == 1 || chunk == 1 ? particles : 4;
    std::vector<double> positions, velocities;
    for (std::uint32_t i = 3 * frame->first; i < 3 * end; ++i) {
      positions.push_back(calc_coordinate(number, i));
      velocities.push_back(-positions.back());
    }
    wire::copy(frame->positions64, positions);
    wire::copy(frame->velocities64, velocities);
    add(*frame);
  }

  static double calc_time(std::uint64_t number) { return 0.1 * static_cast<double>(number); }
  static double calc_coordinate(std::uint64_t number, std::uint32_t i) {
    return static_cast<double>(number) + 0.01 * i;
  }

  // Scene, topology, parameters, a first event, and `frames` frames.
  void add_run(std::uint64_t run_id, std::uint64_t frames, std::uint32_t chunks = 1) {
    add_scene(run_id);
    add_topology(run_id);
    add_parameters(run_id, 1);
    add_event(run_id, 0);
    for (std::uint64_t frame = 0; frame < frames; ++frame) add_frame(run_id, frame, 1, chunks);
  }

  template <class T>
  void add(const T& sample) {
    const auto bytes = encode(sample);
    expect(writer_.write_message(channels_.at(wire::topic_of<T>().id), sequence_++, 20, 10, bytes).ok());
  }

  // The file is complete, or lacks its end.
  void close() { expect(writer_.close().ok() && sink_->close().ok()); }
  void cut() { expect(writer_.flush().ok() && sink_->close().ok()); }

 private:
  template <class T>
  static wire::Owned<T> make(std::uint64_t run_id) {
    wire::Owned<T> sample;
    wire::set_string(sample->world, "beam");
    sample->run_id = run_id;
    return sample;
  }
  static void expect(bool done) {
    if (!done) throw std::runtime_error("the recording of a test cannot be written");
  }

  std::unique_ptr<mcap::FileSink> sink_;
  mcap::Writer writer_;
  std::map<wire::TopicId, mcap::ChannelId> channels_;
  std::uint32_t sequence_ = 0;
};

// A folder of the test's own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = std::filesystem::temp_directory_path() / "flexcast-test-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    folder_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace flexcast::test
