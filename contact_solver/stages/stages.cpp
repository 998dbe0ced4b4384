// Names of the stages.
#include "viscontact/contact_solver/stages/stages.hpp"

namespace viscontact::contact_solver {

std::string_view name_of(Stage stage) {
  switch (stage) {
    case Stage::kNewton:
      return "newton";
    case Stage::kFactors:
      return "factors";
    case Stage::kGradients:
      return "gradients";
    case Stage::kAcceleratedSweeps:
      return "accelerated_sweeps";
    case Stage::kSweeps:
      return "sweeps";
    case Stage::kProximalSteps:
      return "proximal_steps";
    case Stage::kBranchPath:
      return "branch_path";
    case Stage::kClosedGaps:
      return "closed_gaps";
    case Stage::kCoulombPath:
      return "coulomb_path";
    case Stage::kStepsFromPath:
      return "steps_from_path";
    case Stage::kFirstLoads:
      return "first_loads";
    case Stage::kStepsNearGuess:
      return "steps_near_guess";
    case Stage::kInteriorPoints:
      return "interior_points";
    case Stage::kStepsFromInside:
      return "steps_from_inside";
    case Stage::kCorrections:
      return "corrections";
    case Stage::kDistances:
      return "distances";
    case Stage::kGivenLoads:
      return "given_loads";
    case Stage::kRefinements:
      return "refinements";
  }
  return {};
}

std::string text_of(const StagesRun& stages) {
  std::string text;
  for (std::size_t s = 0; s < kStages; ++s) {
    const auto stage = static_cast<Stage>(s);
    if (!stages.has(stage)) continue;
    if (!text.empty()) text += '+';
    text += name_of(stage);
    text += ':';
    text += std::to_string(stages[stage]);
  }
  return text;
}

}  // namespace viscontact::contact_solver
