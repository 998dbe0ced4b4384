// The contact solver without particles, docs/physics.md (5.6) and (5.7): a block of mass m on a
// floor, pushed along it with the force F.
#include <cstdio>
#include <exception>
#include <vector>

#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

// Exact: p_n = m g h, p_t = -min(mu m g, F) h, and the block slides by h^2 (F/m - mu g) in its
// first step if F > mu m g. It prints
//   push      normal  friction     slip
//      2       0.981      -0.2        0
//      4       0.981      -0.4        0
//      8       0.981   -0.4905  0.03095
int main() try {
  using namespace viscontact::contact_solver;
  constexpr double h = 0.1, m = 1, inertia = 1, g = 9.81, mu = 0.5;
  std::printf("push      normal  friction     slip\n");
  for (const double push : {2.0, 4.0, 8.0}) {
    RigidUnit<2> block;
    block.free = {h * h * push / m, -h * h * g, 0};  // the motion without the floor
    block.mobility = h / m;
    block.inverse_mobility = m / h;
    block.turn_mobility = {h / inertia};
    block.inverse_turn_mobility = {inertia / h};

    ConstraintProblem<2> problem;
    problem.units = {block};
    ConstraintBlock contact;  // dry, with one row for the gap and one for the slip
    contact.rows = 2;
    contact.friction = mu;
    contact.allowed = contact.allowed_slip = 1e-12;
    problem.blocks = {contact};
    problem.add_row(0, std::vector<RowPart<2>>{{0, {0, 1, 0}}}, 0);
    problem.add_row(0, std::vector<RowPart<2>>{{0, {1, 0, 0}}}, 0);

    const auto solution = solve_constraints(problem, 1000);
    if (!(solution.result.residual <= 1)) return 1;
    std::printf("%4g  %10.4g  %8.4g  %7.4g\n", push, problem.impulses[0], problem.impulses[1],
                solution.motions[0][0]);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
