#include "reduced_model/models.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string>

#include "common/error.hpp"
#include "common/named.hpp"
#include "reduced_model/inertial.hpp"
#include "reduced_model/reference.hpp"
#include "reduced_model/reference_exact.hpp"
#include "reduced_model/viscous_contact.hpp"
#include "reduced_model/viscous_contact_regular_drag.hpp"
#include "reduced_model/viscous_contact_threshold.hpp"

namespace viscontact {
namespace {

constexpr std::array kModels = {
    Model{"reference", "no inertia, explicit Euler (the lecture's)", simulate_reference},
    Model{"reference_exact", "no inertia, first integral", simulate_reference_exact},
    Model{"inertial", "with inertia, CVODE", simulate_inertial},
    Model{"viscous_contact", "viscous contact", simulate_viscous_contact, viscous_contact},
    Model{"viscous_contact_regular_drag", "viscous contact and regular drag",
          simulate_viscous_contact_regular_drag, viscous_contact_regular_drag},
    Model{"viscous_contact_threshold", "whole drag down to a threshold gap, viscous contact there",
          simulate_viscous_contact_threshold, viscous_contact_threshold},
};

}  // namespace

std::span<const Model> all_models() { return kModels; }

const Model& find_model(std::string_view name) { return require_named(kModels, name, "model"); }

Trajectory simulate(const Model& model, const Motion& motion, const LubricationForce& force) {
  const auto start = std::chrono::steady_clock::now();
  try {
    Trajectory trajectory = model.simulate(motion, force);
    trajectory.model = model.name;
    trajectory.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return trajectory;
  } catch (const Error& error) {
    throw Error(error.exit_code(), fmt::format("model {}: {}", model.name, error.what()));
  }
}

}  // namespace viscontact
