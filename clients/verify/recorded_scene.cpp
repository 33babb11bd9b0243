#include "clients/verify/recorded_scene.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "core/scene/file_places.h"
#include "idl/wire/fill.h"

namespace flexcast::verify {
namespace {

namespace fs = std::filesystem;

// Goes with the object, and all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code ignored;
    std::string path = fs::temp_directory_path(ignored) / "flexcast-verify-XXXXXX";
    if (mkdtemp(path.data()) != nullptr) path_ = path;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }  // "": it could not be made

 private:
  fs::path path_;
};

// Files in a folder of their own, whatever names a scene has for them: absolute, above it, or beside it. What the scene
// names in one folder lies in one folder here, so that the halves of a pair find each other.
class FileStore {
 public:
  explicit FileStore(fs::path root) : root_(std::move(root)) {}

  fs::path place_of(const fs::path& name) {
    const auto folder = folders_.emplace(name.parent_path().string(), folders_.size()).first;
    return root_ / std::to_string(folder->second) / name.filename();
  }

  Result<void> write(const flexcast_SceneFile& file) {
    const fs::path name = wire::text(file.name);
    const std::string last = name.filename().string();
    if (last.empty() || last == "." || last == "..") {
      return Error{"the recording has a file of the scene under the name '" + name.string() + "', which names none"};
    }
    const fs::path path = place_of(name);
    std::error_code failed;
    fs::create_directories(path.parent_path(), failed);
    std::ofstream stream(path, std::ios::binary);
    const auto content = wire::elements(file.content);
    stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    if (failed || !stream.flush()) return Error{"cannot write " + path.string()};
    return {};
  }

 private:
  fs::path root_;
  std::map<std::string, std::size_t> folders_;  // by name, numbered as they come
};

}  // namespace

Result<Scene> load_recorded_scene(const flexcast_SceneInfo& info) {
  const TemporaryFolder folder;
  if (folder.path().empty()) return Error{"cannot make a temporary folder for the scene's files"};
  FileStore store(folder.path());
  for (const flexcast_SceneFile& file : wire::elements(info.files)) {
    if (auto written = store.write(file); !written) return written.error();
  }
  return load_scene_text(
      std::string(wire::text(info.scene_text)), "the recorded scene",
      [&store](const fs::path& name) { return store.place_of(name); }, wire::strings(info.overrides));
}

}  // namespace flexcast::verify
