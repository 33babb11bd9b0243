#include <limits>

#include "core/forces/model.h"
#include "core/integrators/integrator.h"
#include "core/sim/parameters.h"
#include "core/sim/settings.h"

namespace flexcast {
namespace {

using Scope = ParameterRow::Scope;
using Kind = ParameterKind;

constexpr Range count{1.0, 1e6, false, false};
constexpr Range tolerance{0.0, 1.0, true, true};

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorRow& row : integrators()) names.emplace_back(row.name);
  return names;
}

// Rows whose value is one field: of the settings, of the model, or of a body.
template <class Field>
ParameterRow settings_row(std::string_view name, Kind kind, std::string_view unit, Range range,
                          std::string_view description, Field field) {
  using Value = std::remove_reference_t<decltype(field(std::declval<Settings&>()))>;
  using Stored = std::conditional_t<std::is_same_v<Value, int>, std::int64_t, Value>;
  return {Scope::scene,
          name,
          name,
          kind,
          unit,
          range,
          {},
          true,
          description,
          [field](const Model&, const Settings& settings, std::size_t) -> ParameterValue {
            return static_cast<Stored>(field(const_cast<Settings&>(settings)));
          },
          [field](Model&, Settings& settings, std::size_t, const ParameterValue& value) {
            field(settings) = static_cast<Value>(std::get<Stored>(value));
          }};
}

ParameterRow body_row(Scope scope, std::string_view name, std::string_view scene_key, std::string_view unit,
                      Range range, std::string_view description, double Body::*field) {
  return {scope,
          name,
          scene_key,
          Kind::number,
          unit,
          range,
          {},
          true,
          description,
          [field](const Model& model, const Settings&, std::size_t body) -> ParameterValue {
            return model.bodies[body].*field;
          },
          [field](Model& model, Settings&, std::size_t body, const ParameterValue& value) {
            model.bodies[body].*field = std::get<double>(value);
          }};
}

ParameterRow gravity_row() {
  return {
      Scope::scene,
      "gravity",
      "gravity",
      Kind::vector,
      "m/s^2",
      ranges::any,
      {},
      true,
      "acceleration of everything that has mass",
      [](const Model& model, const Settings&, std::size_t) -> ParameterValue { return model.gravity; },
      [](Model& model, Settings&, std::size_t, const ParameterValue& value) { model.gravity = std::get<Vec3>(value); }};
}

ParameterRow with_choices(ParameterRow row, std::vector<std::string> choices) {
  row.choices = std::move(choices);
  return row;
}

std::vector<ParameterRow> make_rows() {
  std::vector<ParameterRow> rows;
  rows.push_back(gravity_row());
  rows.push_back(settings_row("time.step", Kind::number, "s", ranges::positive, "time that one step covers",
                              [](Settings& s) -> double& { return s.time.step; }));
  rows.push_back(
      with_choices(settings_row("time.integrator", Kind::choice, "", ranges::any, "scheme that takes the steps",
                                [](Settings& s) -> std::string& { return s.time.integrator; }),
                   integrator_names()));
  rows.push_back(settings_row("time.substeps", Kind::integer, "", count, "integrator steps per step",
                              [](Settings& s) -> int& { return s.time.substeps; }));
  rows.push_back(
      with_choices(settings_row("solver.linear", Kind::choice, "", ranges::any, "linear solver of implicit schemes",
                                [](Settings& s) -> std::string& { return s.solver.linear; }),
                   {"auto", "pcg", "ldlt"}));
  rows.push_back(settings_row("solver.linear_tolerance", Kind::number, "", tolerance,
                              "relative residual at which pcg ends",
                              [](Settings& s) -> double& { return s.solver.linear_tolerance; }));
  rows.push_back(settings_row("solver.newton_iterations", Kind::integer, "", count,
                              "Newton iterations a step at most; 1: linearly implicit",
                              [](Settings& s) -> int& { return s.solver.newton_iterations; }));
  rows.push_back(settings_row("solver.newton_tolerance", Kind::number, "", tolerance,
                              "norm of the residual over the norms of its terms",
                              [](Settings& s) -> double& { return s.solver.newton_tolerance; }));
  rows.push_back(settings_row("stream.every", Kind::integer, "", count, "publish every n-th step",
                              [](Settings& s) -> int& { return s.stream.every; }));

  rows.push_back(
      body_row(Scope::fem_body, "young", "material.young", "Pa", ranges::positive, "Young's modulus", &Body::young));
  rows.push_back(
      body_row(Scope::fem_body, "poisson", "material.poisson", "", ranges::poisson, "Poisson's ratio", &Body::poisson));
  rows.push_back(body_row(Scope::fem_body, "density", "material.density", "kg/m^3", ranges::positive, "density at rest",
                          &Body::density));
  rows.push_back(body_row(Scope::fem_body, "damping.stiffness", "damping.stiffness", "s", ranges::non_negative,
                          "Kelvin-Voigt damping time", &Body::stiffness_damping));
  rows.push_back(body_row(Scope::spring_body, "stiffness", "springs.stiffness", "N", ranges::non_negative,
                          "k_s of every spring: force per relative extension", &Body::stiffness));
  rows.push_back(body_row(Scope::spring_body, "damping", "springs.damping", "N.s", ranges::non_negative,
                          "k_d of every spring", &Body::damping));
  rows.push_back(body_row(Scope::spring_body, "mass", "mass", "kg", ranges::positive, "mass of every particle",
                          &Body::particle_mass));
  rows.push_back(body_row(Scope::any_body, "damping.mass", "damping.mass", "1/s", ranges::non_negative,
                          "mass-proportional damping rate", &Body::mass_damping));
  rows.push_back(
      body_row(Scope::any_body, "drag", "drag", "N.s/m", ranges::non_negative, "drag on every particle", &Body::drag));
  return rows;
}

}  // namespace

std::span<const ParameterRow> parameter_rows() {
  static const std::vector<ParameterRow> rows = make_rows();
  return rows;
}

}  // namespace flexcast
