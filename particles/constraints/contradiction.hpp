// Finds the constraints of a step that contradict each other (constraint_problem.hpp). Lengths are
// in the units of the case. constraint_system.hpp uses it for an error message; nothing is thrown.
#pragma once

#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// By how much each block is violated [L], >= 0, in the motion that violates the constraints least:
/// the one with the smallest sum of v^2/w over the rows of bilateral constraints without compliance
/// and the negative gaps. If some motion satisfies all of them, these are 0 but for rounding.
/// Otherwise the values v/w of the rows, as impulses, move nothing and so prove the contradiction
/// (Farkas' lemma), and a block that has no part in it is not violated.
template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
