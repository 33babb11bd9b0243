#include "clients/record/destination.h"

#include <filesystem>

#include "clients/record/ring_destination.h"
#include "clients/record/ring_parts.h"
#include "clients/record/single_destination.h"
#include "clients/record/split_destination.h"

namespace flexcast::record {

wire::Result<void> check_output(const Options& options) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::path path = options.file;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) return wire::Error{"there is no folder " + folder.string()};
  if (fs::is_directory(path, ignored)) return wire::Error{path.string() + " is a folder"};
  const fs::path first = options.split_size ? fs::path(part_path(options.file, 0)) : path;
  if (fs::exists(first, ignored) && !options.force) {
    return wire::Error{first.string() + " exists already: give another name, or --force to replace it"};
  }
  if (options.keep_last && has_ring(options.file) && !options.force) {
    return wire::Error{ring_folder(options.file) + " exists already: --recover " + options.file +
                       " completes it, --force throws it away"};
  }
  return {};
}

wire::Result<std::unique_ptr<Destination>> make_destination(const Options& options, MakeReport make_report) {
  if (options.split_size) return SplitDestination::create(options, std::move(make_report));
  if (options.keep_last) return RingDestination::create(options, std::move(make_report));
  auto file = OpenFile::create(options.file, options.compression, options.force);
  if (!file) return file.error();
  return std::unique_ptr<Destination>(
      std::make_unique<SingleDestination>(std::move(file).value(), std::move(make_report)));
}

mcap::Status to_mcap(const wire::Result<void>& result) {
  return result ? mcap::Status() : mcap::Status::failure(result.error().message);
}

}  // namespace flexcast::record
