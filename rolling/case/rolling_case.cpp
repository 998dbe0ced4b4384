// Functions named ..._keys declare the keys of a section and read them into their last arguments.
#include "viscontact/rolling/case/rolling_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "viscontact/case_file/shared_sections.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/freefem_axi/geometry.hpp"

namespace viscontact::rolling {
namespace {

using lubrication::MotionKind;

/// The keys from which the force of the motion is computed: two components of a force [M L/T^2], or
/// the weight less the buoyancy [M L/T^2] and the angle of the plane [rad], > 0 if it falls towards
/// +x.
struct WeightKeys {
  std::vector<double> force;
  double weight = 0, incline = 0;
  double gravity = 0;  // [L/T^2]
};

/// Declares force, weight, gravity and incline. `mass` [M] is the mass of the sphere minus the mass
/// of the fluid that it displaces.
void weight_keys(case_file::Keys& keys, WeightKeys& given, double mass) {
  // A little more than a right angle.
  constexpr Allowed kAngle = {[](double v) { return std::abs(v) <= 1.6; },
                              "of radians from -1.6 to 1.6"};
  constexpr std::array kOneOf = {"force", "weight", "gravity"};
  std::string_view first;
  for (const auto* key : kOneOf)
    if (keys.has(key)) {
      keys.require(first.empty(), key,
                   "must be left out, because {} is given; only one of force, weight and gravity "
                   "may be given",
                   first);
      first = key;
    }
  keys.require(!first.empty(), "force",
               "is missing; it must be two numbers, or weight or gravity must be given");
  keys.optional("force", case_file::numbers(given.force, kFinite, "two numbers"),
                {"along the plane, and away from it", "from `weight` or `gravity`, and `incline`"});
  keys.require(!keys.has("incline") || !keys.has("force"), "incline",
               "belongs to weight and gravity; give one of them in place of force");
  keys.optional("weight", case_file::number(given.weight, kFinite),
                {"weight less buoyancy, in place of `force`: the force `weight` sin(`incline`) "
                 "along the plane and -`weight` cos(`incline`) away from it",
                 "from `force` or `gravity`"});
  if (keys.optional(
          "gravity", case_file::number(given.gravity, kFinite),
          {"acceleration, negative towards a plane that is level, in place of `weight`: the "
           "[weight less buoyancy](physics.md#4-motion-of-one-sphere-reduced_model) is (4.15)",
           "from `force` or `weight`"}))
    given.weight = -mass * given.gravity;
  keys.optional("incline", case_file::number(given.incline, kAngle), {"angle of the plane"});
  keys.require(!keys.has("force") || given.force.size() == 2, "force",
               "has {} numbers; it must have two, along the plane and away from it",
               given.force.size());
}

/// Reads the names of models. Throws Error(kBadInput) for an unknown name and for one that is given
/// twice.
void read_rolling_models(const case_file::TomlSection& section, std::string_view key,
                         std::vector<std::string>& models) {
  const auto all = rolling_models();
  models = section.texts(key);
  for (auto model = models.begin(); model != models.end(); ++model) {
    section.require(find_named(all, *model) != nullptr, key, "contains '{}'; the models are: {}",
                    *model, names_of(all));
    section.require(std::find(models.begin(), model, *model) == model, key, "contains '{}' twice",
                    *model);
  }
}

void rolling_keys(case_file::Keys& keys, RollingCase& c) {
  auto& motion = c.motion;
  keys.required("initial_gap", case_file::number(motion.initial_gap, kPositive),
                {"gap at the start, at least the roughness"});
  keys.optional("normal_velocity", case_file::number(motion.normal_velocity, kFinite),
                {"at the start, away from the plane"});
  keys.optional("velocity", case_file::number(motion.velocity, kFinite),
                {"at the start, along the plane"});
  keys.optional("angular_velocity", case_file::number(motion.angular_velocity, kFinite),
                {"at the start, about y (> 0 rolls along +x)"});
  c.has_gravity = keys.has("gravity");
  WeightKeys force;
  weight_keys(keys, force,
              case_file::mass_less_displaced_fluid(motion.mass, c.fluid_density, c.radius));
  c.gravity = force.gravity;
  const bool has_components = force.force.size() == 2;
  motion.force = has_components ? force.force[0] : force.weight * std::sin(force.incline);
  motion.normal_force = has_components ? force.force[1] : -force.weight * std::cos(force.incline);
  keys.optional("torque", case_file::number(motion.torque, kFinite), {"about y"});
  keys.optional("plane_velocity", case_file::number(motion.plane_velocity, kFinite),
                {"of the plane along x; it carries the fluid along"});
  keys.optional("roughness", case_file::number(motion.roughness, kNotNegative),
                {"gap at which the solids touch, less than the radius"});
  keys.optional("friction", case_file::number(motion.friction, kNotNegative),
                {"Coulomb's coefficient of the solids"});
  keys.required("end_time", case_file::number(motion.end_time, kPositive), {"end of the motion"});
  keys.required("time_step", case_file::number(motion.time_step, kPositive),
                {"the step of `viscous_contact`, and the spacing of all rows"});
  // This range is also that of inertial.relative_tolerance in reduced_model/models/inertial.hpp.
  constexpr Allowed kOfTolerance = {[](double v) { return v >= 1e-13 && v <= 1e-2; },
                                    "from 1e-13 to 0.01"};
  keys.optional("relative_tolerance", case_file::number(motion.relative_tolerance, kOfTolerance),
                {"of CVODE"});
  keys.optional("models",
                case_file::custom("a list of `smooth`, `rough`, `viscous_contact`",
                                  read_rolling_models, c.models),
                {"the models that are run", "all"});
}

void check_rolling(const case_file::TomlSection& section, const RollingCase& c) {
  const auto& motion = c.motion;
  section.require(motion.roughness < c.radius, "roughness",
                  "is {}; it must be less than the sphere's radius, {}", motion.roughness,
                  c.radius);
  section.require(motion.initial_gap >= motion.roughness, "initial_gap",
                  "is {}; it must be at least the roughness, {}", motion.initial_gap,
                  motion.roughness);
  section.require(motion.time_step <= motion.end_time, "time_step",
                  "is {}; it must be at most end_time, {}", motion.time_step, motion.end_time);
}

void check_tabulation(const case_file::TomlSection& section,
                      const freefem_axi::Tabulation& tabulation) {
  section.require(tabulation.geometry == freefem_axi::default_geometry().name, "geometry",
                  "is {}; a sphere rolls on a plane", tabulation.geometry);
  for (const auto motion : {MotionKind::kApproach, MotionKind::kSlide, MotionKind::kRoll})
    section.require(std::ranges::count(tabulation.motions, motion) > 0, "motion",
                    "lacks {}; a sphere that rolls needs approach, slide and roll",
                    to_string(motion));
}

void rolling_sphere_keys(case_file::Keys& keys, RollingCase& c) {
  double density = 0;
  case_file::sphere_keys(keys, c.radius, density, c.motion.mass, true);
  c.motion.moment_of_inertia = 0.4 * c.motion.mass * c.radius * c.radius;  // homogeneous sphere
  keys.optional("moment_of_inertia", case_file::number(c.motion.moment_of_inertia, kPositive),
                {"about an axis through the centre", "2 m r²/5"});
}

void pair_fit_keys(case_file::Keys& keys, RollingCase& c) {
  std::string file;
  keys.required("file", case_file::file_name(file),
                {"fit of a pair (JSON) beside a plane, which is "
                 "[scaled](physics.md#3-the-fit-fitting) to radius and viscosity of the case"});
  c.fit = c.path.parent_path() / file;
}

void rolling_sweep_keys(case_file::Keys& keys, case_file::SweepRequest& sweep) {
  keys.required("vary", case_file::texts(sweep.vary), {"`KEY=RANGE` each, as on the command line"});
  case_file::points_and_plot_keys(keys, sweep);
}

}  // namespace

void read_root(const case_file::TomlSection& root, RollingCase& c) {
  case_file::read_title_and_units(root, c);
  for (const auto& model : rolling_models()) c.models.emplace_back(model.name);
  case_file::read_keys(root.section("fluid"), case_file::fluid_keys, c.viscosity, c.fluid_density);
  case_file::read_keys(root.section("sphere"), rolling_sphere_keys, c);
  const auto rolling = root.section("rolling");
  case_file::read_keys(rolling, rolling_keys, c);
  check_rolling(rolling, c);
  root.require(root.has("tabulation") != root.has("fit"), "tabulation",
               "or fit must be there, one of the two");
  if (root.has("tabulation")) {
    const auto section = root.section("tabulation");
    c.tabulation = case_file::read_tabulation(section, c.viscosity, c.radius);
    check_tabulation(section, *c.tabulation);
  } else {
    case_file::read_keys(root.section("fit"), pair_fit_keys, c);
  }
  if (root.has("sweep"))
    case_file::read_keys(root.section("sweep"), rolling_sweep_keys, c.sweep.emplace());
  root.finish();
}

RollingCase read_rolling_case(const std::filesystem::path& path) {
  return case_file::read_case_file<RollingCase>(path);
}

motions::PairFit fit_for(const RollingCase& c, motions::PairFit fit,
                         const std::filesystem::path& file) {
  if (!fit.geometry.empty() && fit.geometry != freefem_axi::default_geometry().name)
    throw_bad_input({file.string()}, "is the fit of a sphere beside: {}; it must be a plane",
                    fit.geometry);
  return motions::scaled_to(std::move(fit), c.viscosity, c.radius);
}

std::vector<case_file::KeyTable> tables_of_rolling_case() {
  return {case_file::describe_keys("[sphere] of a rolling sphere", rolling_sphere_keys),
          case_file::describe_keys("[rolling]", rolling_keys),
          case_file::describe_keys("[fit] of a rolling sphere", pair_fit_keys),
          case_file::describe_keys("[sweep] of a rolling sphere", rolling_sweep_keys)};
}

}  // namespace viscontact::rolling
