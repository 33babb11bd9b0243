#include "clients/export/exporter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "clients/export/csv.h"
#include "clients/export/frame_reader.h"
#include "clients/export/output_file.h"
#include "clients/export/vtu.h"
#include "idl/wire/fill.h"

namespace flexcast::exporting {
namespace {

namespace fs = std::filesystem;
using client::Frame;
using wire::Error;
using wire::Result;

// What one export works on.
struct Job {
  recording::Recording& recording;
  const recording::Index& index;
  const Selection& selection;
  const Options& options;
  const ExportProgress& progress;
  std::vector<std::string> fields;  // that are exported
  bool doubles = false;
};

bool contains(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

// The fields to export: those asked for, which must have been streamed, or all that were.
Result<std::vector<std::string>> choose_fields(const flexcast_SceneInfo& scene, const Options& options) {
  const std::vector<std::string> streamed = wire::strings(scene.fields);
  if (!contains(streamed, "positions")) return Error{options.file + ": no positions were streamed"};
  for (const std::string& field : options.fields) {
    if (contains(streamed, field)) continue;
    return Error{fmt::format("{}: {} was not streamed; there is: {}", options.file, field, fmt::join(streamed, ", "))};
  }
  return options.fields.empty() ? streamed : options.fields;
}

template <class Visit>
Result<void> for_each_frame(const Job& job, Summary& summary, Visit visit) {
  std::uint64_t done = 0;
  for (const std::size_t i : job.selection.frames) {
    if (job.progress) job.progress(done++);
    const recording::FrameEntry& entry = job.index.frames()[i];
    const auto frame = read_frame(job.recording, job.index, entry);
    if (!frame || frame->positions.empty()) {
      summary.incomplete.push_back(entry.number);
      continue;
    }
    if (auto visited = visit(*frame, entry); !visited) return visited.error();
    ++summary.frames;
  }
  return {};
}

// ---------------------------------------------------------------- VTK

std::string vtu_name(const recording::FrameEntry& entry) {
  return fmt::format("frame_{:08}.vtu", entry.number);
}

Result<void> prepare_folder(const Job& job) {
  const fs::path folder = job.options.vtk;
  if (auto free = check_replaceable(folder / "run.pvd", job.options.force); !free) return free.error();
  for (const std::size_t i : job.selection.frames) {
    const fs::path file = folder / vtu_name(job.index.frames()[i]);
    if (auto free = check_replaceable(file, job.options.force); !free) return free.error();
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Error{"cannot make the folder " + folder.string() + ": " + error.message()};
  return {};
}

// The cells that belong to a frame: read once for each revision of the topology.
Result<const Geometry*> find_geometry(const Job& job, const Frame& frame, const recording::FrameEntry& entry,
                                      std::map<std::uint64_t, Geometry>& known) {
  if (const auto found = known.find(frame.topology_revision); found != known.end()) return &found->second;
  const auto head = read_head(job.recording, entry);
  if (!head) return head.error();
  const auto ordinals = job.index.find_in_force(head.value(), entry.first);
  auto geometry = read_geometry(job.recording, ordinals, frame.particles);
  if (!geometry) return geometry.error();
  return &known.emplace(frame.topology_revision, std::move(geometry).value()).first->second;
}

Result<Summary> export_vtk(const Job& job) {
  if (auto prepared = prepare_folder(job); !prepared) return prepared.error();
  const fs::path folder = job.options.vtk;
  const PointFields fields{contains(job.fields, "velocities"), contains(job.fields, "stretch"),
                           contains(job.fields, "stress"), job.doubles};
  Summary summary;
  summary.output = (folder / "run.pvd").string();
  std::map<std::uint64_t, Geometry> known;
  std::vector<std::pair<double, std::string>> files;
  auto written = for_each_frame(job, summary, [&](const Frame& frame, const recording::FrameEntry& entry) {
    const auto geometry = find_geometry(job, frame, entry, known);
    if (!geometry) return Result<void>(geometry.error());
    const std::string content = make_vtu(frame, *geometry.value(), fields);
    summary.bytes += content.size();
    files.emplace_back(frame.time, vtu_name(entry));
    return write_file(folder / files.back().second, content);
  });
  if (!written) return written.error();
  const std::string list = make_pvd(files);
  if (auto done = write_file(folder / "run.pvd", list); !done) return done.error();
  summary.bytes += list.size();
  summary.files = summary.frames + 1;
  return summary;
}

// ---------------------------------------------------------------- CSV

Result<void> check_probes(const Job& job, const std::vector<Probe>& probes, const Frame& frame) {
  for (const Probe& probe : probes) {
    if (probe.particle < frame.particles) continue;
    return Error{fmt::format("{}: probe {} is particle {} of a world of {}", job.options.file, probe.name,
                             probe.particle, frame.particles)};
  }
  return {};
}

Result<Summary> export_csv(const Job& job, const std::vector<Probe>& probes) {
  if (auto free = check_replaceable(job.options.csv, job.options.force); !free) return free.error();
  const bool velocities = contains(job.fields, "velocities");
  auto table = OutputFile::create(job.options.csv);
  if (!table) return table.error();
  if (auto written = table.value().write(make_csv_header(probes, velocities)); !written) return written.error();
  Summary summary;
  summary.output = job.options.csv;
  auto rows = for_each_frame(job, summary, [&](const Frame& frame, const recording::FrameEntry&) {
    if (auto checked = check_probes(job, probes, frame); !checked) return checked;
    return table.value().write(make_csv_row(frame, probes, velocities && !frame.velocities.empty()));
  });
  if (!rows) return rows.error();
  if (auto closed = table.value().close(); !closed) return closed.error();
  summary.files = 1;
  summary.bytes = table.value().bytes();
  return summary;
}

}  // namespace

Result<Summary> export_frames(recording::Recording& recording, const recording::Index& index,
                              const Selection& selection, const Options& options, const ExportProgress& progress) {
  const auto scene = read_scene(recording, index, index.frames()[selection.frames.front()]);
  if (!scene) return scene.error();
  auto fields = choose_fields(*scene.value(), options);
  if (!fields) return fields.error();
  Job job{recording, index, selection, options, progress, std::move(fields).value(), false};
  job.doubles = wire::text(scene.value()->precision) == "float64";
  auto summary = options.vtk.empty() ? export_csv(job, probes_of(*scene.value())) : export_vtk(job);
  if (!summary) return summary;
  summary.value().fields = job.fields;
  return summary;
}

}  // namespace flexcast::exporting
