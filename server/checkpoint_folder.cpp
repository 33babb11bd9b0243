#include "server/checkpoint_folder.h"

#include "server/name.h"

namespace flexcast::server {

Result<std::filesystem::path> CheckpointFolder::find_path(const std::string& name) const {
  if (auto checked = check_name(name); !checked) return checked.error();
  return folder_ / (name + ".checkpoint");
}

Result<std::filesystem::path> CheckpointFolder::save(const std::string& name, const Checkpoint& checkpoint) const {
  auto path = find_path(name);
  if (!path) return path.error();
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) return Error{folder_.string() + ": the folder cannot be made: " + error.message()};
  if (auto written = write_checkpoint(path.value(), checkpoint); !written) return written.error();
  return path;
}

Result<Checkpoint> CheckpointFolder::load(const std::string& name) const {
  const auto path = find_path(name);
  if (!path) return path.error();
  return read_checkpoint(path.value());
}

}  // namespace flexcast::server
