// CheckpointFolder: a world's checkpoints on disk, by name.
#pragma once

#include <filesystem>
#include <string>

#include "core/sim/checkpoint.h"

namespace flexcast::server {

class CheckpointFolder {
 public:
  // Made when the first checkpoint is saved.
  explicit CheckpointFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // A checkpoint of that name is replaced, as a whole or not at all. Returns its path.
  Result<std::filesystem::path> save(const std::string& name, const Checkpoint& checkpoint) const;
  Result<Checkpoint> load(const std::string& name) const;

 private:
  Result<std::filesystem::path> find_path(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace flexcast::server
