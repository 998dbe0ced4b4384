// The methods that solve contact problems, the form of the tables that say when each of them runs,
// and the loop that runs such a table.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace viscontact::contact_solver {

/// A method of solution. What counts as an iteration of it is said here; the tables that name the
/// stages say when each is entered and left.
enum class Stage : unsigned char {
  // Contacts without friction, (5.4): dual_solver.cpp, and in a fluid contact_problem.cpp.
  kNewton,     ///< steps of Newton's method on the free contacts
  kFactors,    ///< factors of W between the free contacts, as preconditioners
  kGradients,  ///< products with W in conjugate gradients with projection
  // Coulomb's law and convex problems: coulomb_ladder.cpp, convex_ladder.cpp. Iterations of steps
  // (5.8) are factorisations and solutions with factors.
  kAcceleratedSweeps,  ///< Gauss-Seidel sweeps with momentum
  kSweeps,             ///< Gauss-Seidel sweeps
  kProximalSteps,      ///< steps (5.8) with Coulomb's law
  kBranchPath,         ///< changes of branches on the path within such a step
  kClosedGaps,         ///< steps that close gaps while slips hardly change
  kCoulombPath,        ///< the path (5.20); four for each point
  kStepsFromPath,      ///< steps (5.8) from the end of a path
  kFirstLoads,         ///< interior points that find loads to bound friction, (5.17)
  kStepsNearGuess,     ///< steps (5.8) of a convex problem from a guess that is nearly a solution
  kInteriorPoints,     ///< factorisations of interior points
  kStepsFromInside,    ///< steps (5.8) of a convex problem from the end of interior points
  // The equations of an island of particles: island_ladder.cpp. Each beginning counts.
  kCorrections,  ///< solutions with offsets corrected for finite turns
  kDistances,    ///< new beginnings with gaps that are distances
  kGivenLoads,   ///< new beginnings with given loads, because there was no solution
  kRefinements,  ///< refinements of the impulses
};
inline constexpr std::size_t kStages = static_cast<std::size_t>(Stage::kRefinements) + 1;

/// Such as "proximal_steps".
std::string_view name_of(Stage stage);

/// How many iterations each stage took.
class StagesRun {
 public:
  int& operator[](Stage stage) { return iterations_[static_cast<std::size_t>(stage)]; }
  int operator[](Stage stage) const { return iterations_[static_cast<std::size_t>(stage)]; }
  bool has(Stage stage) const { return (*this)[stage] > 0; }
  bool empty() const { return iterations_ == decltype(iterations_){}; }
  StagesRun& operator+=(const StagesRun& other) {
    for (std::size_t s = 0; s < kStages; ++s) iterations_[s] += other.iterations_[s];
    return *this;
  }
  bool operator==(const StagesRun&) const = default;

 private:
  std::array<int, kStages> iterations_{};
};

/// The stages that ran and their iterations, in the order of Stage, such as
/// "sweeps:60+proximal_steps:12"; empty if none did.
std::string text_of(const StagesRun& stages);

/// A row of a table of strategies. `Solver` has the state of the solution. A null pointer stands
/// for nothing to do, or, of is_left, for one step.
template <class Solver>
struct StageRow {
  Stage stage;
  bool (Solver::*is_entered)() const;  ///< asked while no stage runs
  void (Solver::*begin)();
  void (Solver::*step)(Stage);      ///< counts its iterations
  bool (Solver::*is_left)() const;  ///< asked before each further step
  void (Solver::*end)();            ///< is not called if the solution is done before
};

/// Enters the first row of `table` whose stage can be entered, takes its steps until it is left,
/// and begins again at the top, until solver.is_done() or no stage can be entered.
template <class Solver, std::size_t kRows>
void run_stages(const std::array<StageRow<Solver>, kRows>& table, Solver& solver) {
  const StageRow<Solver>* row = nullptr;
  while (!solver.is_done()) {
    if (row != nullptr && (row->is_left == nullptr || (solver.*row->is_left)())) {
      if (row->end != nullptr) (solver.*row->end)();
      row = nullptr;
    }
    if (row == nullptr) {
      row = std::ranges::find_if(table, [&](const auto& r) { return (solver.*r.is_entered)(); });
      if (row == table.end()) return;
      if (row->begin != nullptr) (solver.*row->begin)();
    }
    (solver.*row->step)(row->stage);
  }
}

}  // namespace viscontact::contact_solver
