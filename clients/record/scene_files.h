// SceneFiles: the scene file and the files it refers to, as attachments of the recording; each content once.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "clients/record/item.h"
#include "idl/wire/types.h"

namespace flexcast::record {

class SceneFiles {
 public:
  // Those files of the scene that were not given before. The scene file is called NAME.toml after the scene, the others
  // as the scene file calls them. `now`: ns since 1970.
  std::vector<Attachment> take_new(const flexcast_SceneInfo& scene, std::int64_t now);

 private:
  void add(std::vector<Attachment>& files, std::string name, const char* media_type, std::int64_t now,
           std::span<const std::byte> content);

  std::set<std::tuple<std::string, std::size_t, std::size_t>> known_;  // name, size, hash of the content
};

}  // namespace flexcast::record
