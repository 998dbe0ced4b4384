// The loop that runs a table of stages, and which stages run for problems with known solutions.
#include "viscontact/contact_solver/stages/stages.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/contact_solver/random_constraints.hpp"
#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/dense_constraints.hpp"

namespace viscontact::contact_solver {
namespace {

TEST(Stages, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (std::size_t s = 0; s < kStages; ++s) names.insert(name_of(static_cast<Stage>(s)));
  EXPECT_EQ(names.size(), kStages);
  EXPECT_FALSE(names.contains(""));
}

TEST(Stages, AreListedWithTheirIterations) {
  StagesRun stages;
  EXPECT_TRUE(stages.empty());
  EXPECT_EQ(text_of(stages), "");
  stages[Stage::kProximalSteps] = 12;
  StagesRun others;
  others[Stage::kSweeps] = 60;
  others[Stage::kProximalSteps] = 1;
  stages += others;
  EXPECT_FALSE(stages.has(Stage::kNewton));
  EXPECT_EQ(text_of(stages), "sweeps:60+proximal_steps:13");
}

/// Writes down what happens. The first stage can be entered once and takes two steps, the second
/// one takes single steps until the third step in all.
struct Witness {
  bool is_done() const { return steps == 3; }
  bool can_begin() const { return !has_begun; }
  bool always() const { return true; }
  void begin() {
    has_begun = true;
    log += "begin ";
  }
  void step(Stage stage) {
    ++steps;
    log += std::string(name_of(stage)) + " ";
  }
  bool has_two_steps() const { return steps == 2; }
  void end() { log += "end "; }

  bool has_begun = false;
  int steps = 0;
  std::string log;
};

TEST(Stages, AreEnteredAndLeftAsTheTableSays) {
  Witness witness;
  const std::array<StageRow<Witness>, 2> table{{
      {Stage::kSweeps, &Witness::can_begin, &Witness::begin, &Witness::step,
       &Witness::has_two_steps, &Witness::end},
      {Stage::kNewton, &Witness::always, nullptr, &Witness::step, nullptr, nullptr},
  }};
  run_stages(table, witness);
  EXPECT_EQ(witness.log, "begin sweeps sweeps end newton ");
}

TEST(Stages, EndIfNoneCanBeEntered) {
  Witness witness;
  const std::array<StageRow<Witness>, 1> table{{
      {Stage::kSweeps, &Witness::can_begin, nullptr, &Witness::step, nullptr, nullptr},
  }};
  witness.has_begun = true;
  run_stages(table, witness);
  EXPECT_EQ(witness.log, "");
}

/// A disc of radius and mass 1 with h = 1 on a floor, which moves into it at 1 and along it at 3.
ConstraintProblem<2> disc_on_a_floor() {
  ConstraintProblem<2> problem;
  const std::array<double, 2> moves{3, -1};
  const double turn = 0;
  problem.units = {unit_of_particle<2>(1, 2, moves.data(), &turn)};
  ConstraintBlock block;
  block.rows = 2;
  block.friction = 0.3;
  block.allowed = block.allowed_slip = 1e-9;
  problem.blocks = {block};
  for (const Vector& direction : {Vector{0, 1, 0}, Vector{1, 0, 0}}) {
    const std::vector<RowPart<2>> parts{{0, displacement_row<2>(direction, {0, -1, 0})}};
    problem.add_row(0, parts, 0);
  }
  return problem;
}

TEST(Stages, OfASingleContactAreSweeps) {
  auto problem = disc_on_a_floor();
  const auto solved = solve_constraints(problem, 1000).result;
  EXPECT_LE(solved.residual, 1);
  EXPECT_EQ(text_of(solved.stages), "sweeps:30");
  EXPECT_EQ(solved.iterations, 30);
}

TEST(Stages, OfLeastImpulsesHaveNoSweeps) {
  auto problem = disc_on_a_floor();
  const auto solved = solve_constraints(problem, 1000, ConstraintStart::kLeastImpulses).result;
  EXPECT_LE(solved.residual, 1);
  EXPECT_FALSE(solved.stages.has(Stage::kSweeps));
  EXPECT_TRUE(solved.stages.has(Stage::kProximalSteps));
}

TEST(Stages, OfASolvedGuessAreNone) {
  auto problem = disc_on_a_floor();
  problem.impulses = {1, -0.3};
  EXPECT_TRUE(solve_constraints(problem, 1000).result.stages.empty());
}

TEST(Stages, OfAConvexProblemAreInteriorPoints) {
  auto problem = disc_on_a_floor();
  problem.is_convex = true;
  problem.blocks[0].friction_bound = FrictionBound::kCone;
  const auto solved = solve_constraints(problem, 1000).result;
  EXPECT_LE(solved.residual, 1);
  EXPECT_TRUE(solved.stages.has(Stage::kInteriorPoints));
  EXPECT_FALSE(solved.stages.has(Stage::kFirstLoads));
  EXPECT_FALSE(solved.stages.has(Stage::kSweeps));
}

TEST(Stages, OfGivenLoadsBeginWithLoadsUnlessTheseAreKept) {
  for (const bool keeps : {false, true}) {
    auto problem = disc_on_a_floor();
    problem.is_convex = true;
    problem.keeps_loads = keeps;
    problem.blocks[0].friction_bound = FrictionBound::kGiven;
    problem.blocks[0].given_load = 1;
    const auto solved = solve_constraints(problem, 1000).result;
    EXPECT_LE(solved.residual, 1);
    EXPECT_EQ(solved.stages.has(Stage::kFirstLoads), !keeps);
  }
}

TEST(Stages, OfANearConvexSolutionAreStepsFromIt) {
  auto problem = disc_on_a_floor();
  problem.is_convex = problem.keeps_loads = problem.is_near = true;
  problem.blocks[0].friction_bound = FrictionBound::kGiven;
  problem.blocks[0].given_load = 1;
  problem.impulses = {1 + 1e-6, -0.3};
  const auto solved = solve_constraints(problem, 1000).result;
  EXPECT_LE(solved.residual, 1);
  EXPECT_TRUE(solved.stages.has(Stage::kStepsNearGuess));
  EXPECT_FALSE(solved.stages.has(Stage::kInteriorPoints));
}

/// Two rows that no motion satisfies, beside contacts with friction: everything is tried.
TEST(Stages, OfAProblemWithoutASolutionReachPaths) {
  RandomConstraints what;
  what.has_links = true;
  auto problem = random_constraints<2>(what, {}, 1);
  add_contradicting_links(problem);
  for (auto& block : problem.blocks) block.allowed = block.allowed_slip = 1e-9;
  const auto solved = solve_constraints(problem, 1000000).result;
  EXPECT_GT(solved.residual, 1);
  EXPECT_TRUE(solved.stages.has(Stage::kSweeps));
  EXPECT_TRUE(solved.stages.has(Stage::kProximalSteps));
  EXPECT_TRUE(solved.stages.has(Stage::kCoulombPath));
  int sum = 0;
  for (std::size_t s = 0; s < kStages; ++s) sum += solved.stages[static_cast<Stage>(s)];
  EXPECT_EQ(sum, solved.iterations);
}

/// The same disc by its matrix W = diag(1, 3), with a skew part `a`: sliding at the full friction
/// p_t = -mu_s p_n, the gap -1 + p_n + a p_t is 0.
TEST(DenseConstraints, AreSolvedAlsoWithASkewMatrix) {
  for (const double a : {0.0, 0.2}) {
    DenseConstraints problem;
    problem.w = {1, a, -a, 3};
    problem.error = 1e-15;
    problem.offsets = {-1, 3};
    problem.impulses = {0, 0};
    problem.blocks = disc_on_a_floor().blocks;
    const auto solved = solve_dense_constraints(problem, 1000, false);
    EXPECT_LE(solved.residual, 1);
    EXPECT_TRUE(solved.stages.has(Stage::kProximalSteps));
    // Residuals are at most 1e-9, and rounds end with changes of that size.
    EXPECT_NEAR(problem.impulses[0], 1 / (1 - 0.3 * a), 1e-8);
    EXPECT_NEAR(problem.impulses[1], -0.3 / (1 - 0.3 * a), 1e-8);
  }
}

/// Two equal contacts, whose W is singular: they share the load, and offsets that differ by a
/// rounding error do not let the impulses grow.
TEST(DenseConstraints, OfEqualContactsShareTheLoad) {
  DenseConstraints problem;
  problem.w = {1, 1, 1, 1};
  problem.error = 1e-12;
  problem.rounding = 1e-12;
  problem.offsets = {-1, -1 + 1e-13};
  problem.impulses = {0, 0};
  for (std::size_t row : {0, 1}) {
    ConstraintBlock block;
    block.row = row;
    block.allowed = 1e-9;
    problem.blocks.push_back(block);
  }
  EXPECT_LE(solve_dense_constraints(problem, 1000, false).residual, 1);
  EXPECT_NEAR(problem.impulses[0], 0.5, 1e-8);
  EXPECT_NEAR(problem.impulses[1], 0.5, 1e-8);
}

}  // namespace
}  // namespace viscontact::contact_solver
