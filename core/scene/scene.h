// Scenes: a TOML file (or text) becomes a description, and a description a simulation. The only folder that sees TOML.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/sim/simulation.h"

namespace flexcast {

struct SceneDescription;

// A file the scene refers to, as it was read: recordings carry it.
struct SceneAttachment {
  std::string name;  // as the scene file writes it; the other half of a TetGen pair beside it
  std::string content;
};

// Where a body's mesh comes from, for those who load the scene again with a finer one.
struct SceneMesh {
  std::string body;
  bool fem = false;                 // tetrahedra, else springs
  std::string file;                 // as written; "": generated
  std::vector<std::int64_t> cells;  // of a generated mesh
  bool names_nodes = false;         // a selector of the body counts on its node numbers
};

struct Scene {
  std::string name;
  std::string description;
  std::string exact;                   // name of its exact solution; "": none is known
  std::vector<SceneMesh> meshes;       // one a body
  std::string text;                    // the scene file, byte for byte
  std::vector<std::string> overrides;  // PATH=VALUE, as given
  std::vector<SceneAttachment> files;
  std::vector<std::string> notes;  // repairs of meshes and the like, for the user to read
  std::unique_ptr<Simulation> simulation;
};

// `overrides`: PATH=VALUE with VALUE as in TOML; PATH is a path of the scene file ("time.step", "beam.material.young",
// "beam.mesh.cells", body names standing for their table; "contact.ground.friction", "handle.grip.translate") or the
// name of a parameter ("beam.young"). Errors name file and line (or the override), key, value and what is allowed.
Result<Scene> load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

// The same from text; `directory` is where relative mesh paths start, `origin` stands for the file name in errors.
Result<Scene> load_scene_text(const std::string& text, const std::string& origin = "scene",
                              const std::filesystem::path& directory = ".",
                              const std::vector<std::string>& overrides = {});

// The two halves of loading, for those who change a description in between. `directory` as above.
Result<SceneDescription> describe_scene(const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides = {});
Result<std::unique_ptr<Simulation>> make_simulation(const SceneDescription& description,
                                                    const std::filesystem::path& directory);

}  // namespace flexcast
