// Reads the sections of a case of a rolling sphere, and applies the defaults.
#include "viscontact/case_file/rolling/rolling_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/case_file/sections.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/geometry.hpp"

namespace viscontact::case_file {
namespace {

using lubrication::MotionKind;

double number_or(const TomlSection& section, std::string_view key, double fallback,
                 const Allowed& allowed = kFinite) {
  return section.has(key) ? section.number(key, allowed) : fallback;
}

/// Reads `force`, the components along the plane and away from it, or `weight` and `incline`: the
/// weight less the buoyancy, and the angle of the plane that falls towards +x.
void read_force_of(const TomlSection& section, reduced_model::RollingMotion& motion) {
  constexpr Allowed kAngle = {[](double v) { return std::abs(v) <= 1.6; },
                              "of radians from -1.6 to 1.6"};
  if (section.has("weight") == section.has("force"))
    section.fail("force", "or weight must be there, one of the two");
  if (section.has("weight")) {
    const double weight = section.number("weight", kFinite);
    const double incline = number_or(section, "incline", 0, kAngle);
    motion.force = weight * std::sin(incline);
    motion.normal_force = -weight * std::cos(incline);
    return;
  }
  if (section.has("incline"))
    section.fail("incline", "belongs to weight; give weight in place of force");
  const auto force = section.numbers("force", kFinite);
  if (force.size() != 2)
    section.fail("force", fmt::format("has {} numbers; it must have two, along the plane and away "
                                      "from it",
                                      force.size()));
  motion.force = force[0];
  motion.normal_force = force[1];
}

std::vector<std::string> read_models(const TomlSection& section) {
  std::vector<std::string> all;
  for (const auto& model : reduced_model::rolling_models()) all.emplace_back(model.name);
  if (!section.has("models")) return all;
  auto models = section.texts("models");
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (std::ranges::find(all, models[i]) == all.end())
      section.fail("models", fmt::format("contains '{}'; the models are: {}", models[i],
                                         fmt::join(all, ", ")));
    if (std::find(models.begin(), models.begin() + static_cast<std::ptrdiff_t>(i), models[i]) !=
        models.begin() + static_cast<std::ptrdiff_t>(i))
      section.fail("models", fmt::format("contains '{}' twice", models[i]));
  }
  return models;
}

void read_rolling(const TomlSection& section, RollingCase& c) {
  auto& motion = c.motion;
  motion.initial_gap = section.number("initial_gap", kPositive);
  motion.normal_velocity = number_or(section, "normal_velocity", 0);
  motion.velocity = number_or(section, "velocity", 0);
  motion.angular_velocity = number_or(section, "angular_velocity", 0);
  read_force_of(section, motion);
  motion.torque = number_or(section, "torque", 0);
  motion.plane_velocity = number_or(section, "plane_velocity", 0);
  motion.roughness = number_or(section, "roughness", 0, kNotNegative);
  motion.friction = number_or(section, "friction", 0, kNotNegative);
  motion.end_time = section.number("end_time", kPositive);
  motion.time_step = section.number("time_step", kPositive);
  constexpr Allowed kOfTolerance = {[](double v) { return v >= 1e-13 && v <= 1e-2; },
                                    "from 1e-13 to 0.01"};
  motion.relative_tolerance = number_or(section, "relative_tolerance", 1e-9, kOfTolerance);
  c.models = read_models(section);
  section.finish();
  if (motion.roughness >= c.radius)
    section.fail("roughness", fmt::format("is {}; it must be less than the sphere's radius, {}",
                                          motion.roughness, c.radius));
  if (motion.initial_gap < motion.roughness)
    section.fail("initial_gap", fmt::format("is {}; it must be at least the roughness, {}",
                                            motion.initial_gap, motion.roughness));
  if (motion.time_step > motion.end_time)
    section.fail("time_step", fmt::format("is {}; it must be at most end_time, {}",
                                          motion.time_step, motion.end_time));
}

void check_tabulation(const TomlSection& section, const freefem_axi::Tabulation& tabulation) {
  if (tabulation.geometry != freefem_axi::default_geometry().name)
    section.fail("geometry", fmt::format("is {}; a sphere rolls on a plane", tabulation.geometry));
  for (const auto motion : {MotionKind::kApproach, MotionKind::kSlide, MotionKind::kRoll})
    if (std::ranges::find(tabulation.motions, motion) == tabulation.motions.end())
      section.fail("motion", fmt::format("lacks {}; a sphere that rolls needs approach, slide and "
                                         "roll",
                                         to_string(motion)));
}

}  // namespace

bool is_rolling_case(const std::filesystem::path& path) {
  return TomlSection::parse(read_file(path), path.string()).has("rolling");
}

RollingCase read_rolling_case(const std::filesystem::path& path) {
  RollingCase c;
  c.text = read_file(path);
  c.path = path;
  const auto root = TomlSection::parse(c.text, path.string());
  c.title = root.has("title") ? root.text("title") : "";
  const auto fluid = root.section("fluid");
  c.viscosity = fluid.number("viscosity", kPositive);
  fluid.finish();
  const auto sphere = root.section("sphere");
  c.radius = sphere.number("radius", kPositive);
  c.motion.mass = sphere.number("mass", kPositive);
  c.motion.moment_of_inertia =
      number_or(sphere, "moment_of_inertia", 0.4 * c.motion.mass * c.radius * c.radius, kPositive);
  sphere.finish();
  read_rolling(root.section("rolling"), c);
  if (root.has("tabulation") == root.has("fit"))
    root.fail("tabulation", "or fit must be there, one of the two");
  if (root.has("tabulation")) {
    const auto section = root.section("tabulation");
    c.tabulation = read_tabulation(section, c.viscosity, c.radius);
    check_tabulation(section, *c.tabulation);
  } else {
    const auto section = root.section("fit");
    c.fit = path.parent_path() / section.text("file");
    section.finish();
  }
  root.finish();
  return c;
}

}  // namespace viscontact::case_file
