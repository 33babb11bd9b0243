// Where something stands in a scene, and how the reader refuses it. Exceptions stay inside this folder: load_scene
// turns them into an Error.
#pragma once

#include <stdexcept>
#include <string>

namespace flexcast {

struct Place {
  std::string source;  // "scene.toml:12", or "--set beam.young=-5"
  std::string owner;   // "[[body]] \"beam\""; empty outside of bodies and probes
  std::string key;     // "material.young"; empty: the owner itself

  // scene.toml:12: [[body]] "beam":
  std::string prefix() const;
};

class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws: scene.toml:12: [[body]] "beam": material.young WHAT
[[noreturn]] void refuse(const Place& place, const std::string& what);

// Throws, for what concerns no key or names its key itself: scene.toml:12: [[body]] "beam": WHAT
[[noreturn]] void refuse_owner(const Place& place, const std::string& what);

}  // namespace flexcast
