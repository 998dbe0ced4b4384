// The table of models. Their order decides on the colours of the report.
#include "viscontact/reduced_model/models/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <iterator>

#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/regime.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_exact.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/reference.hpp"

namespace viscontact::reduced_model {
namespace {

/// The motion with inertia (physics.md (4.1)) by explicit Euler in the gap q and the velocity u,
/// with the mass m, the resistance R, the mean external force f^n of a step, and h =
/// viscous_contact.time_step:
///
///     m (u^{n+1} - u^n)/h = -R(q^n) u^n + f^n,     q^{n+1} = q^n + h u^n.
///
/// The film damps at the rate R/m, which grows without bound as q falls. As soon as h R(q)/m > 2,
/// the velocity changes its sign at each step and grows, and the sphere goes through the wall. In
/// the exact motion, the sphere never touches the wall. The trajectory ends with a row of gap 0
/// where the sphere goes through the wall, or at the end of the motion. Throws Error(kBadInput) if
/// the gap leaves the interval of the fit, or if there are more than 1e8 steps.
Trajectory simulate_explicit_euler(const Motion& motion,
                                   const lubrication::LubricationForce& force) {
  const double end = motion.end_time;
  const double step = motion.parameter(kContactTimeStep);
  const int steps = step_count(end, step);
  Trajectory trajectory;
  double q = motion.initial_gap;
  double u = motion.initial_velocity;
  for (int n = 0;; ++n) {
    const double t = step_time(n, steps, end, step);
    if (n % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    const double drag = -force.resistance(q) * u;
    trajectory.rows.push_back({t, q, u, drag, motion.external_force.value(t), {}});
    if (n == steps) break;
    const double next = step_time(n + 1, steps, end, step);
    const double h = next - t;
    const double fall = -h * u;
    ++trajectory.steps;
    if (!(q - fall > 0)) {
      // The time at which the straight line of this step crosses the wall, where no drag is
      // defined.
      const double crossing = t + q / fall * h;
      trajectory.rows.push_back({crossing, 0, u, {}, motion.external_force.value(crossing), {}});
      break;
    }
    if (const double last = motion_ends_at(force.largest_gap()); q - fall >= last) {
      const double crossing = t + (last - q) / -fall * h;
      trajectory.rows.push_back({crossing, last, u, {}, motion.external_force.value(crossing), {}});
      break;
    }
    u += h / motion.mass * (drag + motion.external_force.mean(t, next));
    q -= fall;
  }
  return trajectory;
}

constexpr bool kByDefault = true, kOnRequest = false;
constexpr bool kInertia = true, kNoInertia = false;
constexpr bool kFluid = true, kNoFluid = false;
constexpr bool kInSweeps = true, kUsualReference = true;

constexpr std::array kReferenceParameters = {kReferenceTimeStep};
constexpr std::array kTimeStepParameters = {kContactTimeStep};
constexpr std::array kContactParameters = {kContactTimeStep, kRestitution};

constexpr std::array kModels = {
    Model{"reference", "no inertia, explicit Euler (the lecture's)", simulate_reference, nullptr,
          kByDefault, kNoInertia, kFluid, kReferenceParameters, &kReferenceTimeStep},
    Model{"reference_exact", "no inertia, first integral", simulate_reference_exact, nullptr,
          kByDefault, kNoInertia, kFluid, kReferenceParameters},
    Model{"inertial", "with inertia, CVODE", simulate_inertial, nullptr, kByDefault, kInertia,
          kFluid, kInertialParameters, nullptr, "variable", kInSweeps, kUsualReference},
    Model{"viscous_contact", "viscous contact", nullptr, viscous_contact, kByDefault, kInertia,
          kFluid, kContactParameters, &kContactTimeStep, "", kInSweeps},
    Model{"viscous_contact_regular_drag", "viscous contact and regular drag", nullptr,
          viscous_contact_regular_drag, kByDefault, kInertia, kFluid, kContactParameters,
          &kContactTimeStep},
    Model{"viscous_contact_threshold", "whole drag down to a threshold gap, viscous contact there",
          nullptr, viscous_contact_threshold, kByDefault, kInertia, kFluid, kThresholdParameters,
          &kContactTimeStep},
    Model{"viscous_contact_exact", "viscous contact from event to event, no time step",
          simulate_viscous_contact_exact, viscous_contact, kOnRequest, kInertia, kFluid,
          kContactParameters, nullptr, "none"},
    Model{"inelastic_contact", "plain inelastic contact", nullptr, inelastic_contact, kOnRequest,
          kInertia, kNoFluid, kContactParameters, &kContactTimeStep},
    Model{"explicit_euler", "with inertia, explicit Euler", simulate_explicit_euler, nullptr,
          kOnRequest, kInertia, kFluid, kTimeStepParameters, &kContactTimeStep},
    Model{"viscous_contact_leapfrog", "viscous contact by a leapfrog, of second order", nullptr,
          viscous_contact_leapfrog, kOnRequest, kInertia, kFluid, kContactParameters,
          &kContactTimeStep},
    Model{"inertial_rough", "with inertia and solid contact, CVODE", simulate_inertial_rough,
          nullptr, kOnRequest, kInertia, kFluid, kInertialRoughParameters, nullptr, "variable",
          !kInSweeps, !kUsualReference, check_start_outside_roughness},
    // A new model stands here, at the end of the list, so that the others keep their colours in the
    // report.
};

/// The budget of a model that resolves the whole drag; the drag counts as the force of the film.
/// Between two rows, the impulse of the film is the change of momentum minus the impulse of the
/// external force. Its work is this impulse times the mean of both velocities.
MomentumEnergyBudget budget_of_drag(const std::vector<TrajectoryRow>& rows, const Motion& motion,
                                    bool inertia) {
  assert(!rows.empty());
  MomentumEnergyBudget budget;
  const double m = inertia ? motion.mass : 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& a = rows[i - 1];
    const auto& b = rows[i];
    const double push = (b.time - a.time) * motion.external_force.mean(a.time, b.time);
    budget.film_work += (m * (b.velocity - a.velocity) - push) * (a.velocity + b.velocity) / 2;
  }
  const auto& first = rows.front();
  const auto& last = rows.back();
  budget.external_impulse = motion.external_force.impulse(last.time);
  budget.film_impulse = m * (last.velocity - first.velocity) - budget.external_impulse;
  budget.external_work =
      m / 2 * (last.velocity - first.velocity) * (last.velocity + first.velocity) -
      budget.film_work;
  return budget;
}

/// Throws Error(kBadInput) if the sphere starts at or beyond the wall opposite its neighbour.
void check_start_below_wall(const Motion& motion, const lubrication::LubricationForce& force) {
  if (!(motion.initial_gap < motion_ends_at(force.largest_gap())))
    throw Error(ErrorKind::kBadInput,
                "motion.initial_gap is {}; it must be less than {}, at which the sphere touches "
                "the wall opposite",
                motion.initial_gap, force.largest_gap());
}

void set_regime(const ModelChoice& choice, const Motion& motion,
                const lubrication::LubricationForce& force, Trajectory& trajectory) {
  if (!choice.model->fluid) return;
  double speed = 0, lowest_gamma = 0;
  for (const auto& row : trajectory.rows) {
    speed = std::max(speed, std::abs(row.velocity));
    if (row.gamma) lowest_gamma = std::min(lowest_gamma, *row.gamma);
  }
  const double radius = force.radius(), viscosity = force.viscosity();
  trajectory.stokes_number = lubrication::stokes_number(motion.mass, radius, speed, viscosity);
  if (motion.fluid_density > 0)
    trajectory.reynolds_number =
        lubrication::reynolds_number(motion.fluid_density, radius, speed, viscosity);
  if (lowest_gamma < 0 && choice.model->contact != nullptr &&
      !choice.model->contact(motion, force).drag)
    trajectory.film_stokes_number = motion.mass * speed / -lowest_gamma;
}

/// Throws Error(kNotConverged) if a number of the trajectory is not finite, or if times do not
/// increase.
void check_finite(const Trajectory& trajectory) {
  assert(trajectory.budget && !trajectory.rows.empty());
  const auto refuse = [](double time) {
    throw Error(ErrorKind::kNotConverged,
                "a number of the motion leaves the range of a double at time {:.6g}", time);
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
    if (!std::isfinite((*trajectory.budget).*entry.value)) refuse(trajectory.rows.back().time);
  for (std::size_t i = 1; i < trajectory.rows.size(); ++i)
    if (!(trajectory.rows[i].time > trajectory.rows[i - 1].time)) refuse(trajectory.rows[i].time);
}

std::vector<Model> models_with(bool Model::*property) {
  std::vector<Model> models;
  std::ranges::copy_if(kModels, std::back_inserter(models), property);
  return models;
}

}  // namespace

std::span<const Model> all_models() { return kModels; }

std::vector<Model> default_models() { return models_with(&Model::by_default); }

std::vector<Model> sweep_models() { return models_with(&Model::in_sweeps); }

std::vector<Model> models_on_request() {
  std::vector<Model> models;
  std::ranges::remove_copy_if(kModels, std::back_inserter(models), &Model::by_default);
  return models;
}

std::string usual_reference() {
  return std::string(std::ranges::find(kModels, true, &Model::usual_reference)->name);
}

std::string reference_of(const std::vector<std::string>& names) {
  const std::string usual = usual_reference();
  return names.empty() || std::ranges::find(names, usual) != names.end() ? usual : names.front();
}

std::vector<ModelParameter> model_parameters() {
  std::vector<ModelParameter> all;
  for (const auto& model : kModels)
    for (const auto& parameter : model.parameters)
      if (std::ranges::find(all, parameter.key, &ModelParameter::key) == all.end())
        all.push_back(parameter);
  return all;
}

std::vector<std::string_view> model_sections() {
  std::vector<std::string_view> sections;
  const auto add = [&](std::string_view section) {
    if (std::ranges::find(sections, section) == sections.end()) sections.push_back(section);
  };
  for (const auto& parameter : model_parameters()) add(parameter.section());
  add(section_of(kRoughnessKey));
  return sections;
}

std::optional<ModelChoice> known_model(std::string_view name) {
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
  if (found == nullptr || (choice.smooth && found->contact == nullptr)) return {};
  choice.model = found;
  return choice;
}

ModelChoice find_model(std::string_view name) {
  if (const auto choice = known_model(name)) return *choice;
  return {std::string(name), &require_named(kModels, name, "model")};  // throws
}

bool depends_on(const ModelChoice& choice, std::string_view key) {
  assert(choice.model != nullptr);
  key = key.substr(0, key.find('['));
  const Model& model = *choice.model;
  if (key == "sphere.mass" || key == "motion.initial_velocity") return model.inertia;
  if (key == "fluid.viscosity" || key == "sphere.radius") return model.fluid;
  const auto has_key = [&](const auto& parameters) {
    return std::ranges::find(parameters, key, &ModelParameter::key) != std::end(parameters);
  };
  // The roughness matters where solids touch, which they do in models with a restitution. Plain
  // inelastic contact (fluid = false) has no film and does not use it.
  if (key == kRoughnessKey) {
    const auto& all = model.parameters;
    return model.fluid && !choice.smooth &&
           std::ranges::find(all, kRestitution.key, &ModelParameter::key) != all.end();
  }
  return has_key(model.parameters) || !has_key(model_parameters());
}

Motion motion_of(const ModelChoice& choice, const Motion& motion) {
  Motion result = motion;
  if (choice.smooth) result.roughness = {0, 0};
  return result;
}

ContactModel contact_model_of(const ModelChoice& choice, const Motion& motion,
                              const lubrication::LubricationForce& force) {
  assert(choice.model != nullptr && choice.model->contact != nullptr);
  return choice.model->contact(motion_of(choice, motion), force);
}

std::string description_of(const ModelChoice& choice) {
  assert(choice.model != nullptr);
  return fmt::format("{}{}{}", choice.model->description, choice.exact_drag ? ", exact drag" : "",
                     choice.smooth ? ", smooth" : "");
}

lubrication::LubricationForce drag_of(const ModelChoice& choice,
                                      const lubrication::LubricationForce& force) {
  return choice.exact_drag
             ? lubrication::LubricationForce::exact_plane(force.viscosity(), force.radius())
                   .below_wall(force.largest_gap())
             : force;
}

void check_model(const ModelChoice& choice, const Motion& motion,
                 const lubrication::LubricationForce& force) {
  assert(choice.model != nullptr);
  with_place("model " + choice.name, [&] {
    for (const auto& parameter : choice.model->parameters)
      if (parameter.is_time_step) (void)step_count(motion.end_time, motion.parameter(parameter));
    if (choice.model->check != nullptr) choice.model->check(motion);
    check_start_below_wall(motion, force);
    if (choice.model->contact != nullptr) (void)contact_model_of(choice, motion, force);
  });
}

namespace {

/// When the gaps are first reached; a contact model has the film that its gamma stands for.
std::vector<GapTime> gap_times_of(const std::vector<TrajectoryRow>& rows,
                                  const std::vector<double>& gaps,
                                  const std::optional<ContactModel>& contact) {
  if (gaps.empty() || !contact) return gap_times(rows, gaps);
  const auto film = [&](double gamma) {
    try {
      return contact->film_thickness ? contact->film_thickness(gamma) : contact->contact_gap;
    } catch (const Error&) {
      return 0.0;  // thinner than the interval of the fit or than a double
    }
  };
  // Without an impulse, the film is as thick as the film law allows.
  const double thickest = film(-std::numeric_limits<double>::min());
  return gap_times(
      rows, gaps, [&](const TrajectoryRow& row) { return film(*row.gamma); }, thickest);
}

}  // namespace

Trajectory simulate(const ModelChoice& choice, const Motion& motion,
                    const lubrication::LubricationForce& force) {
  assert(choice.model != nullptr);
  const auto start = std::chrono::steady_clock::now();
  Trajectory trajectory;
  with_place("model " + choice.name, [&] {
    const Model& model = *choice.model;
    const Motion own_motion = motion_of(choice, motion);
    const lubrication::LubricationForce own_force = drag_of(choice, force);
    check_start_below_wall(own_motion, own_force);
    trajectory = model.simulate != nullptr
                     ? model.simulate(own_motion, own_force)
                     : run_contact_model(model.contact, own_motion, own_force);
    trajectory.model = choice.name;
    if (!trajectory.budget)
      trajectory.budget = budget_of_drag(trajectory.rows, motion, model.inertia);
    check_finite(trajectory);
    trajectory.gap_times =
        gap_times_of(trajectory.rows, own_motion.gaps_to_reach,
                     model.contact != nullptr ? std::optional(model.contact(own_motion, own_force))
                                              : std::nullopt);
    set_regime(choice, own_motion, own_force, trajectory);
  });
  trajectory.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return trajectory;
}

std::optional<ReachedGaps> reached_gaps(const ModelChoice& choice, const Motion& motion,
                                        const lubrication::LubricationForce& force) {
  try {
    const Trajectory trajectory = simulate(choice, motion, force);
    const auto [low, high] = std::ranges::minmax_element(trajectory.rows, {}, &TrajectoryRow::gap);
    if (choice.model->contact == nullptr) return ReachedGaps{low->gap, high->gap};
    const ContactModel contact = contact_model_of(choice, motion, force);
    if (!contact.drag) return {};
    ReachedGaps reached{{}, high->gap};
    if (contact.contact_gap > 0) reached.smallest = trajectory.film_from_gamma.value_or(low->gap);
    return reached;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    return {};
  }
}

}  // namespace viscontact::reduced_model
