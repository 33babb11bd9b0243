#include "clients/verify/recorded_scene.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

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

// Where the scene lies, so deep that its files may lie beside it or some folders above.
const fs::path depth = "a/b/c/d/e/f/g/h";

Result<void> write_file(const fs::path& root, const flexcast_SceneFile& file) {
  const std::string name(wire::text(file.name));
  const fs::path inside = (depth / name).lexically_normal();
  if (fs::path(name).is_absolute() || name.empty() || inside.begin()->string() == "..") {
    return Error{"the scene's file '" + name + "' has no place beside the scene; name it by a relative path there"};
  }
  const fs::path path = root / inside;
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  std::ofstream stream(path, std::ios::binary);
  const auto content = wire::elements(file.content);
  stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  if (failed || !stream.flush()) return Error{"cannot write " + path.string()};
  return {};
}

}  // namespace

Result<Scene> load_recorded_scene(const flexcast_SceneInfo& info) {
  const TemporaryFolder folder;
  if (folder.path().empty()) return Error{"cannot make a temporary folder for the scene's files"};
  std::error_code failed;
  fs::create_directories(folder.path() / depth, failed);
  if (failed) return Error{"cannot make a folder below " + folder.path().string() + ": " + failed.message()};
  for (const flexcast_SceneFile& file : wire::elements(info.files)) {
    if (auto written = write_file(folder.path(), file); !written) return written.error();
  }
  return load_scene_text(std::string(wire::text(info.scene_text)), "the recorded scene", folder.path() / depth,
                         wire::strings(info.overrides));
}

}  // namespace flexcast::verify
