// Conjugate gradients until the error is small against the dissipation; a given stress by a second
// solution, that of the flow alone.
#include "viscontact/suspensions/instant.hpp"

#include <cmath>
#include <utility>

namespace viscontact::suspensions {
namespace {

struct InstantTuning {
  // Rounding errors may keep conjugate gradients from the tolerance.
  static constexpr int kMostIterations = 20000;
  // Solutions after each of which the dissipation is computed anew.
  static constexpr int kMostRounds = 20;
  static constexpr double kFirstReduction = 1e-4;
};

double power(const std::vector<Motion>& loads, const std::vector<Motion>& motions) {
  double sum = 0;
  for (std::size_t k = 0; k < loads.size(); ++k)
    sum += dot(loads[k].along, motions[k].along) + dot(loads[k].turn, motions[k].turn);
  return sum;
}

class Solver {
 public:
  Solver(const InstantProblem& problem, double tolerance)
      : problem_(problem), tolerance_(tolerance), gradients_(*problem.pool) {
    preconditioner_.set(problem.system->resistance(), *problem.pool);
  }

  /// Solves for the forces `loads` and `rate` times the flow.
  std::vector<Motion> solve(const std::vector<Motion>& loads, double rate,
                            std::vector<Motion> motions) {
    const auto& system = *problem_.system;
    SymmetricTensor strain;
    strain.add(rate, problem_.strain);
    auto right = loads;
    system.subtract_strain_loads(strain, right);
    double allowed = allowed_residual(motions, strain);
    for (int round = 0; round < InstantTuning::kMostRounds; ++round) {
      // Motions that are 0 have no dissipation if there is no strain.
      const double reduction = allowed > 0 ? 0 : InstantTuning::kFirstReduction;
      const auto result =
          gradients_.solve(system.resistance(), preconditioner_, right, motions,
                           {allowed, reduction}, InstantTuning::kMostIterations - iterations);
      iterations += result.iterations;
      if (!result.converged) break;
      // Far from the solution the dissipation was much too large.
      const double at_end = allowed_residual(motions, strain);
      if (result.stagnates || (reduction == 0 && at_end >= allowed / 2) || at_end == 0) {
        balance(loads, motions);
        return motions;
      }
      allowed = at_end;
    }
    converged = false;
    return motions;
  }

  int iterations = 0;
  bool converged = true;

 private:
  /// Translates all spheres so that their drag balances the given forces, which pairs do not
  /// change. With little drag the residual has too few digits for it.
  void balance(const std::vector<Motion>& loads, std::vector<Motion>& motions) const {
    const auto& resistance = problem_.system->resistance();
    if (!resistance.drags.empty() || resistance.fixed > 0) return;
    Lanes force{};
    double drag = 0;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      force += loads[k].along - resistance.spheres[k].move * motions[k].along;
      drag += resistance.spheres[k].move;
    }
    for (auto& motion : motions) motion.along += (1 / drag) * force;
  }
  double allowed_residual(const std::vector<Motion>& motions, const SymmetricTensor& strain) {
    const auto& system = *problem_.system;
    std::vector<Motion> loads(motions.size()), of_strain(motions.size());
    system.resistance().multiply(motions, loads);
    system.subtract_strain_loads(strain, of_strain);
    const double dissipation = power(loads, motions) - power(of_strain, motions) +
                               system.stresslets(motions, strain).contracted(strain);
    return tolerance_ * tolerance_ * problem_.least_resistance * dissipation;
  }

  const InstantProblem& problem_;
  double tolerance_;
  BlockPreconditioner preconditioner_;
  ConjugateGradients gradients_;
};

}  // namespace

InstantSolution solve_instant(const InstantProblem& problem, std::vector<Motion> start,
                              double tolerance) {
  Solver solver(problem, tolerance);
  InstantSolution solution;
  if (!problem.stress) {
    solution.motions = solver.solve(problem.loads, 1, std::move(start));
  } else {
    // Motions and stress are linear in the rate.
    const std::vector<Motion> at_rest(start.size());
    const auto by_loads = solver.solve(problem.loads, 0, at_rest);
    auto motions = solver.solve(at_rest, 1, std::move(start));
    auto stress = problem.load_stress;
    stress.add(1, problem.system->stresslets(by_loads, {}));
    auto per_rate = problem.system->stresslets(motions, problem.strain);
    per_rate.add(2 * problem.viscosity * problem.volume, problem.strain);
    solution.rate = (*problem.stress * problem.volume - stress(0, 1)) / per_rate(0, 1);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      motions[k].along = by_loads[k].along + solution.rate * motions[k].along;
      motions[k].turn = by_loads[k].turn + solution.rate * motions[k].turn;
    }
    solution.motions = std::move(motions);
  }
  solution.iterations = solver.iterations;
  solution.converged = solver.converged;
  return solution;
}

}  // namespace viscontact::suspensions
