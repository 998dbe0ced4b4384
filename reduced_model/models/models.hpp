// The models of motion of one sphere by name (physics.md, section 4), and the function that runs
// one. A new model is a source of its own and a row of the table in models.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/model_parameter.hpp"
#include "viscontact/reduced_model/models/contact/contact_model.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// A model of motion.
struct Model {
  std::string_view name;         ///< what users type; its trajectory file is NAME.csv
  std::string_view description;  ///< one line, for --help and legends
  /// Null for a contact model that run_contact_model() runs.
  Trajectory (*simulate)(const Motion&, const lubrication::LubricationForce&);
  /// Null if this is not a contact model.
  MakeContactModel contact = nullptr;
  /// Whether it runs when a case names no models.
  bool by_default = true;
  /// Whether the motion depends on the mass.
  bool inertia = true;
  /// Whether the motion depends on the drag of the fluid.
  bool fluid = true;
  /// The parameters that the model reads. In the motion of a case each of them has a value; without
  /// one, the model throws Error(kBadInput), but a missing kRestitution counts as 0.
  std::span<const ModelParameter> parameters;
  /// The model's time step; null if it has no fixed step.
  const ModelParameter* time_step = nullptr;
  /// What trajectory files state as the time step if the model has no fixed one.
  std::string_view steps = "variable";
  /// Whether a sweep runs it when its case and its command name no models.
  bool in_sweeps = false;
  /// True for one model.
  bool usual_reference = false;
  /// Throws Error(kBadInput) for a motion that `simulate` would refuse; null: it refuses none.
  void (*check)(const Motion&) = nullptr;
};

/// The place of a model in this list decides on the colour of its lines in the report.
std::span<const Model> all_models();

/// The models that run when a case names none.
std::vector<Model> default_models();

/// The models that run only when they are named.
std::vector<Model> models_on_request();

/// The models that a sweep runs when a user names none.
std::vector<Model> sweep_models();

/// Others are compared with this model when a user names no reference.
std::string usual_reference();

/// The usual reference if it is among these names or if there are none, otherwise the first name.
std::string reference_of(const std::vector<std::string>& names);

/// The parameters of all models, each key once, in the order of the models.
std::vector<ModelParameter> model_parameters();

/// The sections of a case with model_parameters() and the roughness, each once.
std::vector<std::string_view> model_sections();

/// Suffix of a model that runs with the exact drag (lubrication/plane_drag.hpp) in place of the
/// fit.
inline constexpr std::string_view kExactDragSuffix = "_brenner";

/// Suffix of a contact model that runs with smooth surfaces, whatever the roughness of the case.
inline constexpr std::string_view kSmoothSuffix = "_smooth";

/// A model, the drag and the surfaces that it runs with.
struct ModelChoice {
  std::string name;              ///< with its suffixes
  const Model* model = nullptr;  ///< never null in a result of known_model()
  bool exact_drag = false;       ///< whether the exact drag replaces the fit (kExactDragSuffix)
  bool smooth = false;           ///< whether the roughness of the case is ignored (kSmoothSuffix)
};

/// The model with this name, which may have suffixes; nothing if there is none.
std::optional<ModelChoice> known_model(std::string_view name);

/// The same. Throws Error(kBadInput), which lists the names, if there is no such model.
ModelChoice find_model(std::string_view name);

/// False if the number of the case at this key, such as "viscous_contact.roughness[0]", cannot
/// change what the model computes. True for all keys of [motion] but initial_velocity, and for keys
/// that belong neither to [fluid], [sphere] and the roughness nor to a parameter of a model.
bool depends_on(const ModelChoice& choice, std::string_view key);

/// A copy of `force`, or the exact drag near a plane of the same viscosity and radius.
lubrication::LubricationForce drag_of(const ModelChoice& choice,
                                      const lubrication::LubricationForce& force);

/// A copy of `motion`, with roughness 0 if `choice.smooth` is true.
Motion motion_of(const ModelChoice& choice, const Motion& motion);

/// The contact model that the choice, which must be of one, makes of motion_of(choice, motion) and
/// `force`. `force` must outlive the result, which refers to it.
ContactModel contact_model_of(const ModelChoice& choice, const Motion& motion,
                              const lubrication::LubricationForce& force);

/// One line for legends.
std::string description_of(const ModelChoice& choice);

/// Checks a motion without running the model. Throws the Error(kBadInput) that simulate() would
/// throw if a time step has no value or makes more than 1e8 steps, if the model refuses the motion
/// (Model::check), or if a contact model refuses the initial gap, the roughness or the fit. Gaps
/// that the motion reaches later do not matter. Of `force`, only its interval of gaps and its
/// coefficient k of 1/q decide whether an error is thrown.
void check_model(const ModelChoice& choice, const Motion& motion,
                 const lubrication::LubricationForce& force);

/// Runs a model and fills in the name of the trajectory, its budget and the computing time. The
/// messages of all Errors begin with the name of the model. Throws the errors of the model,
/// Error(kNotConverged) if a number of the motion is not finite or times do not increase, and
/// Error(kInterrupted) at a stop.
Trajectory simulate(const ModelChoice& choice, const Motion& motion,
                    const lubrication::LubricationForce& force);

/// The gaps at which a model evaluates the whole drag in a motion [L].
struct ReachedGaps {
  /// Nothing for a model that evaluates no drag in a thin film.
  std::optional<double> smallest;
  double largest = 0;  ///< [L]
};

/// Runs the model with `force`, which must be the exact drag, or a fit with formulas below and
/// above its interval: a motion that leaves the interval gives no result. If a contact model makes
/// contact at a threshold gap, `smallest` is the film thickness that it computes from gamma,
/// because the drag at these gaps determines it. Returns nothing if the model evaluates no drag, or
/// if the motion cannot be computed. Throws Error(kInterrupted) at a stop.
std::optional<ReachedGaps> reached_gaps(const ModelChoice& choice, const Motion& motion,
                                        const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
