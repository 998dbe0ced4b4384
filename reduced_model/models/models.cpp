// The registry of models, the suffixes of their names, and the budget of models whose film is the
// whole drag.
#include "viscontact/reduced_model/models/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <string>

#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/reduced_model/integration/explicit_euler.hpp"
#include "viscontact/reduced_model/models/inelastic_contact.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/reference.hpp"
#include "viscontact/reduced_model/models/reference_exact.hpp"
#include "viscontact/reduced_model/models/viscous_contact.hpp"
#include "viscontact/reduced_model/models/viscous_contact_exact.hpp"
#include "viscontact/reduced_model/models/viscous_contact_regular_drag.hpp"
#include "viscontact/reduced_model/models/viscous_contact_threshold.hpp"

namespace viscontact {
namespace {

constexpr bool kByDefault = true;
constexpr bool kOnRequest = false;
constexpr bool kInertia = true;
constexpr bool kNoInertia = false;
constexpr auto kNoContact = nullptr;

constexpr std::array kModels = {
    Model{"reference", "no inertia, explicit Euler (the lecture's)", simulate_reference, nullptr,
          kByDefault, kNoInertia, "fluid.viscosity sphere.radius reference.time_step",
          TimeSteps::kReference},
    Model{"reference_exact", "no inertia, first integral", simulate_reference_exact, nullptr,
          kByDefault, kNoInertia, "fluid.viscosity sphere.radius reference.time_step"},
    Model{"inertial", "with inertia, CVODE", simulate_inertial, kNoContact, kByDefault, kInertia,
          "fluid.viscosity sphere.radius reference.time_step inertial.relative_tolerance"},
    Model{"viscous_contact", "viscous contact", simulate_viscous_contact, viscous_contact,
          kByDefault, kInertia,
          "fluid.viscosity sphere.radius viscous_contact.time_step viscous_contact.roughness",
          TimeSteps::kContact},
    Model{"viscous_contact_regular_drag", "viscous contact and regular drag",
          simulate_viscous_contact_regular_drag, viscous_contact_regular_drag, kByDefault, kInertia,
          "fluid.viscosity sphere.radius viscous_contact.time_step viscous_contact.roughness",
          TimeSteps::kContact},
    Model{"viscous_contact_threshold", "whole drag down to a threshold gap, viscous contact there",
          simulate_viscous_contact_threshold, viscous_contact_threshold, kByDefault, kInertia,
          "fluid.viscosity sphere.radius viscous_contact.time_step viscous_contact.roughness "
          "viscous_contact.threshold_gap",
          TimeSteps::kContact},
    Model{"viscous_contact_exact", "viscous contact from event to event, no time step",
          simulate_viscous_contact_exact, viscous_contact, kOnRequest, kInertia,
          "fluid.viscosity sphere.radius viscous_contact.time_step viscous_contact.roughness",
          TimeSteps::kNone},
    Model{"inelastic_contact", "plain inelastic contact", simulate_inelastic_contact,
          inelastic_contact, kOnRequest, kInertia, "viscous_contact.time_step",
          TimeSteps::kContact},
    Model{"explicit_euler", "with inertia, explicit Euler", simulate_explicit_euler, nullptr,
          kOnRequest, kInertia, "fluid.viscosity sphere.radius viscous_contact.time_step",
          TimeSteps::kContact},
};

/// The budget of a model whose film is the whole drag. The film's impulse between two rows is the
/// change of momentum minus the impulse of the force, its work that impulse times the mean
/// velocity.
MomentumEnergyBudget books_of_drag(const std::vector<TrajectoryRow>& rows, const Motion& motion,
                                   bool inertia) {
  MomentumEnergyBudget books;
  const double m = inertia ? motion.mass : 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& a = rows[i - 1];
    const auto& b = rows[i];
    const double push = (b.time - a.time) * motion.external_force.mean(a.time, b.time);
    books.film_work += (m * (b.velocity - a.velocity) - push) * (a.velocity + b.velocity) / 2;
  }
  const auto& first = rows.front();
  const auto& last = rows.back();
  books.external_impulse = motion.external_force.impulse(last.time);
  books.film_impulse = m * (last.velocity - first.velocity) - books.external_impulse;
  books.external_work =
      m / 2 * (last.velocity - first.velocity) * (last.velocity + first.velocity) - books.film_work;
  return books;
}

/// Throws Error(kNotConverged) if a number of the trajectory is not finite, or if times do not
/// increase.
void check_finite(const Trajectory& trajectory) {
  const auto refuse = [](double time) {
    throw Error(
        ErrorKind::kNotConverged,
        fmt::format("a number of the motion leaves the range of a double at time {:.6g}", time));
  };
  const auto is_number = [](const OptionalDouble& value) {
    return !value || std::isfinite(*value);
  };
  for (const auto& row : trajectory.rows)
    if (!(std::isfinite(row.time) && std::isfinite(row.gap) && std::isfinite(row.velocity) &&
          is_number(row.lubrication_force) && is_number(row.external_force) &&
          is_number(row.gamma) && is_number(row.solid_force)))
      refuse(row.time);
  for (const auto& entry : kBudgetEntries)
    if (!std::isfinite((*trajectory.books).*entry.value)) refuse(trajectory.rows.back().time);
  for (std::size_t i = 1; i < trajectory.rows.size(); ++i)
    if (!(trajectory.rows[i].time > trajectory.rows[i - 1].time)) refuse(trajectory.rows[i].time);
}

}  // namespace

std::span<const Model> all_models() { return kModels; }

std::vector<Model> default_models() {
  std::vector<Model> models;
  std::ranges::copy_if(kModels, std::back_inserter(models), &Model::by_default);
  return models;
}

std::vector<Model> models_on_request() {
  std::vector<Model> models;
  std::ranges::remove_copy_if(kModels, std::back_inserter(models), &Model::by_default);
  return models;
}

ModelChoice find_model(std::string_view name) {
  ModelChoice choice{std::string(name)};
  const auto take = [&](std::string_view suffix) {
    const bool has_it = find_named(kModels, name) == nullptr && name.ends_with(suffix);
    if (has_it) name.remove_suffix(suffix.size());
    return has_it;
  };
  for (int i = 0; i < 2; ++i) {  // the suffixes may be in either order
    choice.exact_drag = choice.exact_drag || take(kExactDragSuffix);
    choice.smooth = choice.smooth || take(kSmoothSuffix);
  }
  const auto* found = find_named(kModels, name);
  if (found != nullptr && choice.smooth && found->contact == nullptr) found = nullptr;
  choice.model = found != nullptr ? found : &require_named(kModels, choice.name, "model");
  return choice;
}

bool depends_on(const ModelChoice& choice, std::string_view key) {
  key = key.substr(0, key.find('['));
  if (key == "sphere.mass" || key == "motion.initial_velocity") return choice.model->inertia;
  if (key.starts_with("motion.")) return true;
  if (choice.smooth && key == "viscous_contact.roughness") return false;
  std::string_view rest = choice.model->settings;
  if (rest.empty()) return true;
  while (!rest.empty()) {
    const auto end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == key) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

Motion motion_of(const ModelChoice& choice, const Motion& motion) {
  Motion result = motion;
  if (choice.smooth) result.roughness = {0, 0};
  return result;
}

std::string description_of(const ModelChoice& choice) {
  return fmt::format("{}{}{}", choice.model->description, choice.exact_drag ? ", exact drag" : "",
                     choice.smooth ? ", smooth" : "");
}

LubricationForce drag_of(const ModelChoice& choice, const LubricationForce& force) {
  return choice.exact_drag ? LubricationForce::exact_plane(force.viscosity(), force.radius())
                           : force;
}

void check_model(const ModelChoice& choice, const Motion& motion, const LubricationForce& force) {
  try {
    const Motion own_motion = motion_of(choice, motion);
    const bool contact = choice.model->contact != nullptr;
    (void)step_count(motion.end_time,
                     contact ? motion.contact_time_step : motion.reference_time_step);
    if (contact) (void)choice.model->contact(own_motion, force);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("model {}: {}", choice.name, error.what()));
  }
}

Trajectory simulate(const ModelChoice& choice, const Motion& motion,
                    const LubricationForce& force) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const Motion own_motion = motion_of(choice, motion);
    const LubricationForce own_force = drag_of(choice, force);
    Trajectory trajectory = choice.model->simulate(own_motion, own_force);
    trajectory.model = choice.name;
    if (!trajectory.books)
      trajectory.books = books_of_drag(trajectory.rows, motion, choice.model->inertia);
    check_finite(trajectory);
    trajectory.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return trajectory;
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("model {}: {}", choice.name, error.what()));
  }
}

}  // namespace viscontact
