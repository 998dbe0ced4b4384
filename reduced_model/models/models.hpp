// The table of models of motion. A model is added by writing its file and its row here
// (models.cpp).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/reduced_model/models/contact_model.hpp"

namespace viscontact {

struct Model {
  std::string_view name;         ///< what users type, and the stem of its trajectory file
  std::string_view description;  ///< a line for --help and legends
  Trajectory (*simulate)(const Motion&, const LubricationForce&);
  ContactModel (*contact)(const Motion&, const LubricationForce&) =
      nullptr;             ///< of a contact model: what gamma stands for
  bool by_default = true;  ///< runs where a case names no models
  bool inertia = true;     ///< the mass matters
  /// The keys, apart from those of [motion], of a case on which the model depends, separated by
  /// blanks; empty: not stated, it may depend on every key. `sphere.mass` follows from `inertia`.
  std::string_view settings = {};
};

/// Every model there is.
std::span<const Model> all_models();

/// Those that run where a case names none.
std::vector<Model> default_models();

/// The others, which run where they are named.
std::vector<Model> models_on_request();

/// What may end the name of a model that is to run with the exact drag (lubrication/plane_drag.hpp) in place of the fitted one: inertial_brenner.
inline constexpr std::string_view kExactDragSuffix = "_brenner";

/// What may end the name of a contact model whose surfaces are to be smooth, whatever the case's roughness: viscous_contact_smooth.
inline constexpr std::string_view kSmoothSuffix = "_smooth";

/// A model with the drag and the surfaces that it is to run with.
struct ModelChoice {
  std::string name;  ///< that of the model, with its suffixes
  const Model* model = nullptr;
  bool exact_drag = false;
  bool smooth = false;
};

/// The model of that name, which may have suffixes. Throws Error(kBadInput) that lists the names there are.
ModelChoice find_model(std::string_view name);

/// False if a number of the case at this key, such as "viscous_contact.roughness[0]", cannot change
/// anything that the model computes.
bool depends_on(const ModelChoice& choice, std::string_view key);

/// The drag that it runs with: `force`, or the exact one of the same viscosity and radius.
LubricationForce drag_of(const ModelChoice& choice, const LubricationForce& force);

/// The motion that it runs: `motion`, without roughness if its surfaces are to be smooth.
Motion motion_of(const ModelChoice& choice, const Motion& motion);

/// A line for legends.
std::string description_of(const ModelChoice& choice);

/// What simulate() would refuse of the motion's numbers, found without running the model: throws the same Error(kBadInput). Of `force` only its interval
/// matters.
void check_model(const ModelChoice& choice, const Motion& motion, const LubricationForce& force);

/// Runs a model and fills in its name, its books and the wall time. An Error carries the model's name in
/// front.
Trajectory simulate(const ModelChoice& choice, const Motion& motion, const LubricationForce& force);

/// The same with `force` as it is.
inline Trajectory simulate(const Model& model, const Motion& motion,
                           const LubricationForce& force) {
  return simulate(ModelChoice{std::string(model.name), &model}, motion, force);
}

}  // namespace viscontact
