#include "clients/record/recovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clients/mcap/format.h"
#include "clients/mcap/mapped_file.h"
#include "clients/record/new_file.h"
#include "clients/record/part_report.h"
#include "clients/record/recording_copy.h"
#include "clients/record/ring_parts.h"

namespace flexcast::record {
namespace {

bool has_end(mcap::Bytes file) {
  if (file.size() < 2 * mcap::kMagic.size()) return false;
  const mcap::Bytes end = file.last(mcap::kMagic.size());
  return std::equal(end.begin(), end.end(), mcap::kMagic.begin());
}

mcap::ReadEnd find_end(mcap::Bytes file) {
  mcap::Reader reader(file);
  while (reader.next()) {
  }
  return reader.end();
}

bool is_no_recording(const mcap::ReadEnd& end) {
  return end.ending == mcap::Ending::kDamaged && end.intact_bytes <= mcap::kMagic.size();
}

Report empty_report(const std::string& path) {
  Report report;
  report.file = path;
  report.domain = -1;
  return report;
}

Report make_report(const ContentLedger& content) {
  Report report{.file = {}, .world = content.world(), .domain = -1, .profile = {}, .reception = content.reception()};
  report.reception.end = EndReason::recovered;
  return report;
}

// A killed recorder has left parts; if the whole is there already, it was killed while it removed them.
wire::Result<Recovery> recover_ring(const std::string& path) {
  const auto whole = mcap::MappedFile::open(path);
  Recovery recovery{.was_complete = whole && has_end(whole.value().bytes()), .report = empty_report(path)};
  if (!recovery.was_complete) {
    const auto of_what_is_left = [](const ContentLedger& content) {
      return restrict_report(make_report(content), content);
    };
    auto report = join_ring(path, of_what_is_left);
    if (!report) return report.error();
    recovery.report = std::move(report).value();
  }
  remove_ring(path);
  return recovery;
}

}  // namespace

mcap::Result<Recovery> recover(mcap::Bytes file, mcap::ByteSink& sink) {
  RecordingCopy copy(sink, find_compression(file));
  mcap::Reader reader(file);
  while (const mcap::Record* record = reader.next()) {
    if (auto status = copy.take(reader, *record); !status) return status;
  }
  if (is_no_recording(reader.end())) return mcap::Status::failure(reader.end().message);
  Recovery recovery;
  recovery.cut_bytes = file.size() - reader.end().intact_bytes;
  recovery.report = make_report(copy.ledger());
  if (auto status = copy.complete(recovery.report); !status) return status;
  return recovery;
}

wire::Result<Recovery> recover(const std::string& path) {
  if (has_ring(path)) return recover_ring(path);
  const auto old = mcap::MappedFile::open(path);
  if (!old) return wire::Error{old.status().message()};
  const mcap::Bytes bytes = old.value().bytes();
  if (has_end(bytes)) {
    const mcap::ReadEnd end = find_end(bytes);
    if (end.ending != mcap::Ending::kComplete)
      return wire::Error{path + " has its end and is left alone: " + end.message};
    return Recovery{.was_complete = true, .report = empty_report(path)};
  }
  auto file = NewFile::create(path);
  if (!file) return file.error();
  auto recovery = recover(bytes, file.value().sink());
  if (!recovery) return wire::Error{path + ": " + recovery.status().message()};
  recovery.value().report.file = path;
  if (auto kept = file.value().keep(); !kept) return kept.error();
  return std::move(recovery).value();
}

std::string to_text(const Recovery& recovery) {
  const Report& report = recovery.report;
  if (recovery.was_complete) return fmt::format("{} is complete: nothing was changed\n", report.file);
  return to_text(report) +
         fmt::format("  completed; {} bytes after the last whole chunk were cut\n", recovery.cut_bytes);
}

std::string to_json(const Recovery& recovery) {
  using Json = nlohmann::ordered_json;
  Json json = recovery.was_complete ? Json{{"file", recovery.report.file}} : Json::parse(to_json(recovery.report));
  json["was_complete"] = recovery.was_complete;
  json["cut_bytes"] = recovery.cut_bytes;
  return json.dump();
}

}  // namespace flexcast::record
