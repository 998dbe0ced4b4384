// The names of contact_solver that the parts about particles use.
#pragma once

#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/dense_constraints.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/contact_solver/problem/contact_conditions.hpp"
#include "viscontact/contact_solver/problem/dual_problem.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"
#include "viscontact/contact_solver/refinement.hpp"

namespace viscontact::particles {

using contact_solver::BlockResidual;
using contact_solver::ConstraintBlock;
using contact_solver::ConstraintProblem;
using contact_solver::ConstraintRow;
using contact_solver::ConstraintSolution;
using contact_solver::ConstraintStart;
using contact_solver::contact_residual;
using contact_solver::ContactBounds;
using contact_solver::DenseConstraints;
using contact_solver::DualProblem;
using contact_solver::FreeSetFactor;
using contact_solver::FrictionBound;
using contact_solver::GapRow;
using contact_solver::kMostOfGivenLoads;
using contact_solver::kTurns;
using contact_solver::load_of_solids;
using contact_solver::MassDualProblem;
using contact_solver::Motion;
using contact_solver::Refinement;
using contact_solver::RigidUnit;
using contact_solver::RowPart;
using contact_solver::SolvableDualProblem;
using contact_solver::SolverResult;
using contact_solver::Stage;
using contact_solver::StagesRun;

}  // namespace viscontact::particles
