#include "clients/record/scene_files.h"

#include <functional>
#include <string_view>

#include "idl/wire/fill.h"

namespace flexcast::record {

std::vector<Attachment> SceneFiles::take_new(const flexcast_SceneInfo& scene, std::int64_t now) {
  std::vector<Attachment> files;
  const std::string_view name = wire::text(scene.name);
  add(files, std::string(name.empty() ? "scene" : name) + ".toml", "application/toml", now,
      std::as_bytes(std::span(wire::text(scene.scene_text))));
  for (const flexcast_SceneFile& file : wire::elements(scene.files)) {
    add(files, std::string(wire::text(file.name)), "application/octet-stream", now,
        std::as_bytes(wire::elements(file.content)));
  }
  return files;
}

void SceneFiles::add(std::vector<Attachment>& files, std::string name, const char* media_type, std::int64_t now,
                     std::span<const std::byte> content) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  if (!known_.emplace(name, text.size(), std::hash<std::string_view>()(text)).second) return;
  files.push_back({std::move(name), media_type, now, {content.begin(), content.end()}});
}

}  // namespace flexcast::record
