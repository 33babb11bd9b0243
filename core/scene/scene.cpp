#include "core/scene/scene.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <new>
#include <sstream>

#include "core/scene/build.h"
#include "core/scene/file_places.h"
#include "core/scene/overrides.h"
#include "core/scene/place.h"
#include "core/scene/scene_reader.h"

namespace flexcast {
namespace {

toml::table parse(const std::string& text, const std::string& origin) {
  try {
    return toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw SceneError(origin + (line > 0 ? ":" + std::to_string(line) : "") +
                     ": not valid TOML: " + std::string(error.description()));
  }
}

// Values in range can still multiply up to more than a double holds.
void check_start(const Simulation& simulation, const SceneDescription& description) {
  const StepReport report = simulation.calc_report();
  const std::pair<const char*, double> energies[] = {{"elastic", report.elastic},
                                                     {"gravity", report.gravity},
                                                     {"contact", report.contact},
                                                     {"kinetic", report.kinetic},
                                                     {"external", report.work}};
  for (const auto& [name, value] : energies) {
    if (!std::isfinite(value))
      refuse_owner(description.bodies.front().place, "the " + std::string(name) +
                                                         " energy of the scene at its start is not finite in double "
                                                         "precision; sizes or coefficients are too extreme");
  }
}

bool names_nodes(const Selector& selector) {
  return std::holds_alternative<NodeSelector>(selector.what);
}

bool names_nodes(const BodyDescription& body) {
  const auto any = [](const auto& entries) {
    return std::any_of(entries.begin(), entries.end(), [](const auto& entry) { return names_nodes(entry.select); });
  };
  return any(body.particle_masses) || any(body.pins) || any(body.displacements) || any(body.velocities) ||
         any(body.forces) || any(body.surface_forces) || any(body.handles);
}

std::vector<SceneMesh> list_meshes(const SceneDescription& description) {
  std::vector<SceneMesh> meshes;
  for (const BodyDescription& body : description.bodies)
    meshes.push_back({body.name, body.law != nullptr, body.mesh.file, body.mesh.cells, names_nodes(body)});
  return meshes;
}

SceneDescription describe(const std::string& text, const std::string& origin,
                          const std::vector<std::string>& overrides) {
  toml::table document = parse(text, origin);
  for (const std::string& assignment : overrides) apply_override(document, assignment);
  return read_scene(document);
}

std::unique_ptr<Simulation> simulate(const SceneDescription& description, BuiltScene built) {
  auto simulation = std::make_unique<Simulation>(std::move(built.model), description.settings, std::move(built.state),
                                                 std::move(built.probes));
  check_start(*simulation, description);
  return simulation;
}

Scene load(const std::string& text, const std::string& origin, const FilePlaces& files,
           const std::vector<std::string>& overrides) {
  const SceneDescription description = describe(text, origin, overrides);
  BuiltScene built = build_scene(description, files);

  Scene scene;
  scene.name = description.name;
  scene.description = description.description;
  scene.exact = description.exact;
  scene.meshes = list_meshes(description);
  scene.text = text;
  scene.overrides = overrides;
  scene.files = std::move(built.files);
  scene.notes = std::move(built.notes);
  scene.simulation = simulate(description, std::move(built));
  return scene;
}

// Relative names start in the directory.
FilePlaces make_places(const std::filesystem::path& directory) {
  return [directory](const std::filesystem::path& name) { return directory / name; };
}

Result<std::string> read_text(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    return Error{file.string() + ": is a folder; expected a scene file (TOML)"};
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
  if (!stream.is_open() || stream.bad())
    return Error{file.string() + ": cannot be read: " + (errno ? std::strerror(errno) : "unknown reason")};
  return std::move(text).str();
}

// What `make` returns, or what it throws as an error.
template <class Make>
auto guard(const std::string& origin, Make make) -> Result<decltype(make())> {
  try {
    return make();
  } catch (const SceneError& error) {
    return Error{error.what()};
  } catch (const std::bad_alloc&) {
    return Error{origin + ": not enough memory for this scene"};
  } catch (const std::exception& error) {
    return Error{origin + ": " + error.what()};
  }
}

}  // namespace

Result<Scene> load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const auto text = read_text(file);
  if (!text) return text.error();
  return load_scene_text(text.value(), file.string(), file.parent_path(), overrides);
}

Result<Scene> load_scene_text(const std::string& text, const std::string& origin,
                              const std::filesystem::path& directory, const std::vector<std::string>& overrides) {
  return load_scene_text(text, origin, make_places(directory), overrides);
}

Result<Scene> load_scene_text(const std::string& text, const std::string& origin, const FilePlaces& files,
                              const std::vector<std::string>& overrides) {
  return guard(origin, [&] { return load(text, origin, files, overrides); });
}

Result<SceneDescription> describe_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const auto text = read_text(file);
  if (!text) return text.error();
  return guard(file.string(), [&] { return describe(text.value(), file.string(), overrides); });
}

Result<std::unique_ptr<Simulation>> make_simulation(const SceneDescription& description,
                                                    const std::filesystem::path& directory) {
  return guard(description.name,
               [&] { return simulate(description, build_scene(description, make_places(directory))); });
}

}  // namespace flexcast
