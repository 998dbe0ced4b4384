// Budget of momentum and energy of a motion: which impulse and which work each force gave the
// sphere. Masses, lengths and times are in the units of the case. Every trajectory and comparison
// has one. A change must keep both balances below.
#pragma once

#include <array>
#include <string_view>

namespace viscontact::reduced_model {

/// Impulses on the sphere along the outward normal [M L/T] and works done on it [M L^2/T^2], from
/// the start of the motion to its end:
///
///     m u(end) - m v0              = sum of the impulses,
///     m u(end)^2/2 - m v0^2/2      = sum of the works,
///
/// with the mass m, the velocity u and its value v0 at the start. The left sides are 0 for a model
/// without inertia. The film absorbed the energy -film_work, the
/// resolved drag dissipated -drag_work, and the impact on the solid dissipated -solid_work.
///
/// The contact models add up each step. In the other models the film is the whole drag. Its impulse
/// then is the change of momentum minus the impulse of the external force. Its work is a sum over
/// the rows, with an error of second order in their spacing, and external_work is set so that the
/// works are balanced.
struct MomentumEnergyBudget {
  double external_impulse = 0;  ///< of the external force [M L/T]
  double film_impulse = 0;   ///< of the film: of gamma in contact models, else of the drag [M L/T]
  double drag_impulse = 0;   ///< of the drag that contact models resolve outside contact [M L/T]
  double solid_impulse = 0;  ///< of the solid contact [M L/T], >= 0
  double external_work = 0;  ///< of the external force [M L^2/T^2]
  double film_work = 0;      ///< of the film [M L^2/T^2]
  double drag_work = 0;      ///< of the resolved drag [M L^2/T^2], <= 0
  double solid_work = 0;     ///< of the solid contact [M L^2/T^2], <= 0
};

/// An entry of the budget with its name in files.
struct BudgetEntry {
  std::string_view name;                ///< column or key
  double MomentumEnergyBudget::*value;  ///< the member with this name
};
/// All entries, in the order in which files list them.
inline constexpr std::array kBudgetEntries = {
    BudgetEntry{"external_impulse", &MomentumEnergyBudget::external_impulse},
    BudgetEntry{"film_impulse", &MomentumEnergyBudget::film_impulse},
    BudgetEntry{"drag_impulse", &MomentumEnergyBudget::drag_impulse},
    BudgetEntry{"solid_impulse", &MomentumEnergyBudget::solid_impulse},
    BudgetEntry{"external_work", &MomentumEnergyBudget::external_work},
    BudgetEntry{"film_work", &MomentumEnergyBudget::film_work},
    BudgetEntry{"drag_work", &MomentumEnergyBudget::drag_work},
    BudgetEntry{"solid_work", &MomentumEnergyBudget::solid_work}};

}  // namespace viscontact::reduced_model
