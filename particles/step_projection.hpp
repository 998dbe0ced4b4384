// The projection of a step, on the contacts and particles that take part in it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "particles/film_geometry.hpp"
#include "particles/projection.hpp"
#include "particles/state.hpp"
#include "particles/team.hpp"

namespace viscontact::particles {

/// What the projection of a step found.
struct Projected {
  int iterations = 0;
  double violation = 0;              ///< largest of a contact's conditions, over all films [L]
  double smallest_gap = 0;           ///< linearised [L], at most 0
  std::vector<Film*> films;          ///< in the projection; their impulses are its solution
  std::vector<std::int32_t> bodies;  ///< whose displacements it changed
};

/// Chooses the films that hold (gamma < 0), that had an impulse in the last step, or whose gap the free displacements h u* would close, and solves
/// contact_graph.hpp's problem on them and their particles; where that closes further gaps, on those too, until none is below -tolerance. First roughly:
/// which others are closed is then known before much is spent.
template <int D>
class StepProjection {
 public:
  /// The references outlive the object; `displacements` are h u* on entry, h v after solve().
  StepProjection(State& state, std::span<const PlanePlace> planes, std::span<double> displacements,
                 std::span<const double> mobilities, Team& team);
  Projected solve(const SolverSettings& settings, double mean_radius);

 private:
  Film& film(std::size_t f) {
    return f < state_.pairs.size() ? state_.pairs[f] : state_.walls[f - state_.pairs.size()];
  }
  std::size_t films() const { return state_.pairs.size() + state_.walls.size(); }
  void choose(const std::vector<std::size_t>& films);
  Solved solve(const SolverSettings& settings, double goal,
               int iterations);  // on the chosen, into displacements
  std::vector<std::size_t> closed_by_free_motion();
  std::vector<std::size_t> closed(double tolerance, Projected& result);

  State& state_;
  std::span<const PlanePlace> planes_;
  std::span<double> displacements_;
  std::span<const double> mobilities_;
  Team& team_;
  // What takes part; bodies are numbered as they come.
  std::vector<std::size_t> chosen_;
  std::vector<char> is_chosen_;       // of all films
  std::vector<Contact<D>> contacts_;  // between numbered bodies
  std::vector<std::int32_t> bodies_;
  std::vector<std::int32_t> number_;  // of all particles; -1: does not take part
  std::vector<double> free_, body_mobilities_;
  FaceFactor<D> factor_;  // of the solves so far
};

extern template class StepProjection<2>;
extern template class StepProjection<3>;

}  // namespace viscontact::particles
