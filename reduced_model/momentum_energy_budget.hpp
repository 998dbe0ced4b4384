// Momentum and energy books of a motion: who gave the sphere what.
#pragma once

#include <array>
#include <string_view>

namespace viscontact {

/// Impulses on the sphere along the outward normal [M L/T] and work done on it [M L^2/T^2], from the motion's start to its end:
///
///     m u(end) - m v0                  = sum of the impulses,
///     m u(end)^2 / 2 - m v0^2 / 2      = sum of the works
///
/// (the left sides are 0 for a model without inertia). What the film absorbed is -film_work, what drag dissipated -drag_work, what was lost on the
/// solid -solid_work. The contact models book each step as it is made. For the models with the whole drag the film's impulse is what the force does not explain, and its
/// work is summed over the rows, with an error of second order in their spacing; the force's work closes the balance.
struct MomentumEnergyBudget {
  double external_impulse = 0, film_impulse = 0, drag_impulse = 0, solid_impulse = 0;
  double external_work = 0, film_work = 0, drag_work = 0, solid_work = 0;
};

/// The entries by name, for files.
struct BudgetEntry {
  std::string_view name;
  double MomentumEnergyBudget::*value;
};
inline constexpr std::array kBudgetEntries = {
    BudgetEntry{"external_impulse", &MomentumEnergyBudget::external_impulse},
    BudgetEntry{"film_impulse", &MomentumEnergyBudget::film_impulse},
    BudgetEntry{"drag_impulse", &MomentumEnergyBudget::drag_impulse},
    BudgetEntry{"solid_impulse", &MomentumEnergyBudget::solid_impulse},
    BudgetEntry{"external_work", &MomentumEnergyBudget::external_work},
    BudgetEntry{"film_work", &MomentumEnergyBudget::film_work},
    BudgetEntry{"drag_work", &MomentumEnergyBudget::drag_work},
    BudgetEntry{"solid_work", &MomentumEnergyBudget::solid_work}};

}  // namespace viscontact
