// `--set PATH=VALUE`: values put into the TOML document before it is read.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace flexcast {

// PATH is a path of the scene file, the names of bodies and probes standing for their tables ("beam.material.young",
// "time.step") and those of obstacles and handles with the kind before them ("contact.ground.friction",
// "handle.grip.translate"), or a parameter's name ("beam.young"). VALUE is written as in TOML; a bare word is a string.
// Of keys that exclude each other (mass and total_mass, at and node) the one set replaces the other. The nodes put in
// show
// "--set PATH=VALUE" as their source. Throws SceneError.
void apply_override(toml::table& document, const std::string& assignment);

}  // namespace flexcast
