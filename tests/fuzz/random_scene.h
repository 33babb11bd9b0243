// Random scene files: mostly sensible ones, with extremes and nonsense among the values.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "core/sim/parameters.h"
#include "tests/support/random.h"

namespace flexcast::test {

class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {}

  std::string make() {
    strange_ = chance(0.5) ? 0.0 : 0.03;  // every second scene is meant well
    text_ = "name = \"fuzz\"\n";
    if (chance(0.6)) add("gravity", vector(20.0));
    add_time();
    if (chance(0.3)) add_solver();
    const int bodies = pick(5) == 0 ? 2 : 1;
    for (int i = 0; i < bodies; ++i) add_body("body" + std::to_string(i));
    if (chance(0.3)) add_contact();
    if (chance(0.3)) text_ += "[[probe]]\nname = \"tip\"\nbody = \"body0\"\nnode = " + integer(0, 3) + "\n";
    return text_;
  }

  // For parameters: a value of any kind as text.
  std::string any_value() {
    switch (pick(6)) {
      case 0:
        return choice({"symplectic_euler", "xpbd", "vbd", "neo_hookean", "pcg", "ldlt", "rubber"});
      case 1:
        return vector(2.0);
      case 2:
        return integer(0, 20);
      default:
        return number(chance(0.5) ? 1.0 : 1e4);
    }
  }

  // A value of the parameter's kind near its initial one.
  std::string value_like(const ParameterDescriptor& descriptor) {
    switch (descriptor.row->kind) {
      case ParameterKind::number:
        return number(std::max(1e-6, std::abs(std::get<double>(descriptor.initial))));
      case ParameterKind::integer:
        return integer(1, 6);
      case ParameterKind::vector:
        return vector(1.0);
      case ParameterKind::choice:
        return descriptor.row
            ->choices[static_cast<std::size_t>(pick(static_cast<int>(descriptor.row->choices.size())))];
    }
    return "0";
  }

  bool chance(double probability) { return random_.uniform(0.0, 1.0) < probability; }
  int pick(int count) { return static_cast<int>(random_.uniform(0.0, 1.0) * count) % count; }
  double uniform(double low, double high) { return random_.uniform(low, high); }

 private:
  void add(std::string_view key, const std::string& value) { text_ += std::string(key) + " = " + value + "\n"; }

  static std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    const bool whole = std::string_view(text).find_first_of(".en") == std::string_view::npos;
    return whole ? std::string(text) + ".0" : text;
  }

  // About `scale`, rarely extreme or no number at all.
  std::string number(double scale) {
    static constexpr std::array extremes = {"0.0",   "-1.0",   "1e-300", "1e-30",  "1e-9",  "1e9",      "1e30",
                                            "1e300", "-1e30",  "nan",    "inf",    "-inf",  "\"text\"", "true",
                                            "[1.0]", "5e-324", "0.5",    "0.4999", "-0.999"};
    if (chance(strange_)) return extremes[static_cast<std::size_t>(pick(extremes.size()))];
    return text_of(scale * uniform(0.05, 1.5));
  }
  std::string vector(double scale) {
    if (chance(strange_)) return "[1.0, 2.0]";
    const auto component = [&] { return chance(strange_) ? number(scale) : text_of(scale * uniform(-1.0, 1.0)); };
    const std::string x = component(), y = component(), z = component();
    return "[" + x + ", " + y + ", " + z + "]";
  }
  std::string integer(int low, int high) {
    if (chance(strange_)) return choice({"-1", "0", "1000000000000", "1.5", "\"one\""}, false);
    return std::to_string(low + pick(high - low + 1));
  }
  std::string choice(std::vector<std::string_view> choices, bool quoted = true) {
    const std::string word(choices[static_cast<std::size_t>(pick(static_cast<int>(choices.size())))]);
    if (quoted && chance(strange_)) return "\"nonsense\"";
    return quoted ? "\"" + word + "\"" : word;
  }
  std::string selector() {
    switch (pick(4)) {
      case 0:
        return "{ nodes = [" + integer(0, 3) + ", " + integer(0, 4) + "] }";
      case 1:
        return "{ sphere = [0.0, 0.0, 0.0, " + number(1.0) + "] }";
      case 2:
        return "{ box = [[-1.0, -1.0, -1.0], [" + number(0.5) + ", 2.0, 2.0]] }";
      default:
        return "{ all = true }";
    }
  }

  void add_time() {
    text_ += "[time]\n";
    add("step", number(chance(0.2) ? 1.0 : 1e-2));
    add("integrator", choice({"forward_euler", "symplectic_euler", "velocity_verlet", "rk4", "backward_euler",
                              "implicit_midpoint", "bdf2", "xpbd", "vbd", "quasi_static"}));
    if (chance(0.3)) add("substeps", integer(1, 3));
  }
  void add_solver() {
    text_ += "[solver]\n";
    add("linear", choice({"auto", "pcg", "ldlt"}));
    add("newton_iterations", integer(1, 12));
    if (chance(0.3)) add("iterations", integer(1, 8));
    if (chance(0.3)) add("linear_tolerance", number(1e-4));
  }
  void add_body(const std::string& name) {
    text_ += "[[body]]\n";
    add("name", "\"" + name + "\"");
    const bool fem = chance(0.6);
    add("model", fem ? "\"fem\"" : "\"mass_spring\"");
    fem ? add_fem() : add_springs();
    if (chance(0.3)) add("drag", number(1.0));
    if (chance(0.2)) add("origin", vector(2.0));
    if (chance(0.2)) add("rotation", vector(3.0));
    if (chance(0.4)) add("pin", "[ { select = " + selector() + (chance(0.3) ? ", axes = \"xz\"" : "") + " } ]");
    if (chance(0.3)) add("displacement", "[ { select = " + selector() + ", value = " + vector(0.7) + " } ]");
    if (chance(0.3)) {
      add("velocity", "[ { select = " + selector() + ", value = " + vector(5.0) + ", spin = " + vector(5.0) + " } ]");
    }
    if (chance(0.2)) add("force", "[ { select = " + selector() + ", value = " + vector(10.0) + " } ]");
    if (chance(0.1)) add("particle_mass", "[ { select = " + selector() + ", value = " + number(10.0) + " } ]");
    if (chance(0.2)) {
      add("handle", "[ { name = \"" + name + "grip\", select = { nodes = [" + integer(0, 2) +
                        "] }, translate = " + vector(0.5) + ", rotate = " + vector(3.0) + ", start = " + number(0.01) +
                        ", duration = " + number(0.03) + " } ]");
    }
  }
  void add_fem() {
    add("mesh", "{ shape = \"beam\", cells = [" + integer(1, 2) + ", 1, 1], size = [1.0, " + number(0.7) + ", 0.5] }");
    add("element", choice({"tet4", "tet4", "tet10"}));
    add("material", "{ law = " + choice({"linear", "corotational", "st_venant_kirchhoff", "neo_hookean"}) +
                        ", young = " + number(1e4) + ", poisson = " + number(0.3) + ", density = " + number(1000.0) +
                        " }");
    if (chance(0.3)) add("damping", "{ mass = " + number(1.0) + ", stiffness = " + number(1e-2) + " }");
    if (chance(0.1)) add("surface_force", "[ { select = { all = true }, value = " + vector(10.0) + " } ]");
  }
  void add_springs() {
    switch (pick(3)) {
      case 0:
        add("mesh", "{ shape = \"rope\", cells = [" + integer(1, 6) + "], size = [" + number(1.0) + "] }");
        break;
      case 1:
        add("mesh", "{ shape = \"grid\", cells = [" + integer(1, 3) + ", 2], size = [1.0, " + number(1.0) + "] }");
        break;
      default:
        add("mesh", "{ shape = \"lattice\", cells = [1, 1, " + integer(1, 2) + "], size = [1.0, 1.0, 1.0] }");
    }
    add("springs", "{ stiffness = " + number(100.0) + ", damping = " + number(1.0) + " }");
    add(chance(0.5) ? "mass" : "total_mass", number(0.3));
  }
  void add_contact() {
    text_ += "[[contact]]\nname = \"ground\"\n";
    switch (pick(3)) {
      case 0:
        text_ += "shape = \"plane\"\npoint = " + vector(0.5) + "\nnormal = " + vector(1.0) + "\n";
        break;
      case 1:
        text_ += "shape = \"sphere\"\ncenter = " + vector(1.0) + "\nradius = " + number(0.7) + "\n";
        break;
      default:
        text_ += "shape = \"box\"\nlo = [-1.0, -1.0, -1.0]\nhi = [" + number(1.0) + ", 0.5, 0.5]\n";
    }
    if (chance(0.6)) add("friction", number(0.4));
    if (chance(0.3)) add("stiffness", number(1e4));
  }

  SplitMix64 random_;
  std::string text_;
  double strange_ = 0.0;
};

}  // namespace flexcast::test
