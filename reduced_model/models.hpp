// The table of models of motion. A model is added by writing its file and its row here
// (models.cpp).
#pragma once

#include <span>
#include <string_view>

#include "reduced_model/contact_model.hpp"

namespace viscontact {

struct Model {
  std::string_view name;         ///< what users type, and the stem of its trajectory file
  std::string_view description;  ///< a line for --help and legends
  Trajectory (*simulate)(const Motion&, const LubricationForce&);
  ContactModel (*contact)(const Motion&, const LubricationForce&) =
      nullptr;  ///< of a contact model: what gamma stands for
};

/// Every model there is.
std::span<const Model> all_models();

/// The model of that name. Throws Error(kBadInput) that lists the names there are.
const Model& find_model(std::string_view name);

/// Runs a model and fills in its name and the wall time. An Error carries the model's name in
/// front.
Trajectory simulate(const Model& model, const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
