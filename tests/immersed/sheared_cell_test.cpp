// Rigid bodies, links and contacts across the sides of a sheared or strained cell, in a fluid with
// a given resistance: relative to the mean flow, it does not matter where the cell begins.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

constexpr std::array<double, 2> kPeriods = {8, 6};
constexpr double kRadius = 0.5;

/// Drag of each particle, and of each pair against the motion of its nearest images along the line
/// between them, as lubrication has it.
Eigen::MatrixXd resistance_in_cell(const Particles& p) {
  constexpr double kDrag = 3, kTurning = 2, kOfPair = 1.5;
  const auto size = static_cast<Eigen::Index>(3 * p.count());
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) r(i, i) = i % 3 == 2 ? kTurning : kDrag;
  for (std::size_t j = 0; j < p.count(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Vector apart = nearest_image(p.cell, p.position(j) - p.position(i));
      const double distance = norm(apart);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
      for (std::size_t d = 0; d < 2; ++d) {
        row[static_cast<Eigen::Index>(3 * j + d)] = apart[d] / distance;
        row[static_cast<Eigen::Index>(3 * i + d)] = -apart[d] / distance;
      }
      r += kOfPair / (distance * distance) * row * row.transpose();
    }
  return r;
}

/// What a case has besides discs that are pushed.
enum class Kind { kBody, kTorsion, kArm, kSpring, kArmOfBodies, kSpringOfBody, kContact, kSliding };
constexpr std::array kKinds = {Kind::kBody,    Kind::kTorsion,     Kind::kArm,
                               Kind::kSpring,  Kind::kArmOfBodies, Kind::kSpringOfBody,
                               Kind::kContact, Kind::kSliding};

struct CellCase {
  Kind kind = Kind::kBody;
  std::array<double, 4> gradient{};
  double mass = 0, h = 0.1;
  Vector origin{};      ///< lowest corner of the cell
  bool is_held = true;  ///< false: a hinge is left out, and its force is among those of the case
  Vector hinge_force{};
  double hinge_torque = 0;
};

/// Pushed discs: 0 and 1 are close to each other, 2 and 3, too, and 4 is alone.
InFluid system_of(const CellCase& c) {
  auto system = in_fluid(2, 1, c.h, 0.01);
  system.setting.domain = BoxDomain{{c.origin[0], c.origin[1]},
                                    {c.origin[0] + kPeriods[0], c.origin[1] + kPeriods[1]},
                                    {true, true}};
  system.setting.fluid->boundary = LinearFlow{c.gradient};
  const auto cell = cell_of(system.setting);
  const std::array<Vector, 5> places = {Vector{1.0, 1.0, 0}, Vector{1.7, 1.8, 0},
                                        Vector{4.1, 3.3, 0}, Vector{3.2, 3.9, 0},
                                        Vector{6.0, 0.7, 0}};
  auto& p = system.state.particles;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double n = static_cast<double>(k);
    Vector x = places[k];
    for (std::size_t d = 0; d < 2; ++d) x[d] -= periods_beyond(cell, d, x[d]) * kPeriods[d];
    add_pushed(system, x, kRadius, c.mass, {0.7 - 0.5 * n, 0.3 * n - 1, 0});
    // The same velocity relative to the mean flow wherever the cell begins.
    const Vector v = Vector{0.2 * n, 0.4 - 0.1 * n, 0} + mean_velocity(cell, x);
    p.velocities[2 * k] = v[0];
    p.velocities[2 * k + 1] = v[1];
  }
  p.angles.assign(places.size(), 0);
  p.angular_velocities.assign(places.size(), 0.3);
  p.cell = cell;
  auto& links = system.setting.links;
  const PiecewiseLinearLength longer{{{0, norm(places[1] - places[0])}, {1, 2.5}}};
  if (c.kind == Kind::kBody || c.kind == Kind::kTorsion || c.kind == Kind::kArmOfBodies ||
      c.kind == Kind::kSpringOfBody)
    add_rigid_body(p, {{0, 1}});
  if (c.kind == Kind::kArmOfBodies) add_rigid_body(p, {{2, 3}});
  if (c.kind == Kind::kArm)
    links.arms = {{0, 1, longer}, {2, 4, PiecewiseLinearLength{{{0, 3.3}}}}};
  if (c.kind == Kind::kArmOfBodies) {
    const double length = norm(places[2] - places[1]);
    links.arms = {{1, 2, PiecewiseLinearLength{{{0, length}, {1, length + 1}}}}};
  }
  if (c.kind == Kind::kSpring) links.springs = {{0, 1, 2, 1.5}, {4, 0, 5, 2}};
  if (c.kind == Kind::kSpringOfBody) links.springs = {{1, 2, 4, 2.5}};
  if (c.kind == Kind::kTorsion) {
    const Vector on_disc{0.2, -0.1, 0}, at = p.position(1) + on_disc;
    Hinge hinge;
    hinge.body = 0;
    hinge.at = at;
    hinge.point = {1, nearest_image(cell, at - p.bodies.bodies[0].centre)};
    hinge.stiffness = 3;
    hinge.rest_angle = 0.7;
    if (c.is_held) {
      links.hinges = {hinge};
    } else {
      system.setting.forces[1] = constant(Vector{0.7 - 0.5, 0.3 - 1, 0} + c.hinge_force);
      system.setting.torques[1] =
          constant({0, 0, c.hinge_torque + cross(on_disc, c.hinge_force)[2]});
    }
  }
  // Discs 0 and 1 overlap the threshold gap at once.
  if (c.kind == Kind::kContact || c.kind == Kind::kSliding)
    system.setting.forces[0] = constant({20, 20, 0});
  if (c.kind == Kind::kSliding) {
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.friction = FrictionLaw{0.4};
  }
  return system;
}

/// Numbers after one step that may not depend on where the cell begins.
std::vector<double> result_of(const CellCase& c) {
  auto system = system_of(c);
  auto simulation = system.simulation(resistance_in_cell);
  const auto before = simulation.state().particles;
  run(simulation, c.h);
  const auto& state = simulation.state();
  const auto& p = state.particles;
  auto numbers = c.is_held ? state.link_forces : std::vector<double>{};
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector flow = mean_velocity(before.cell, before.position(k));
    const Vector v = p.velocity(k) - flow;
    const Vector moved = p.position(k) - before.position(k) - c.h * flow;
    numbers.insert(numbers.end(), {v[0], v[1], moved[0] / c.h, moved[1] / c.h,
                                   p.angular_velocities[k], p.angles[k] / c.h});
  }
  for (std::size_t b = 0; b < p.bodies.count(); ++b) {
    const auto& body = p.bodies.bodies[b];
    const Vector flow = mean_velocity(before.cell, before.bodies.bodies[b].centre);
    const Vector v = body.velocity - flow;
    numbers.insert(numbers.end(), {v[0], v[1], body.angular_velocity[2], body.angular_momentum[2]});
  }
  for (const auto& contact : contacts_of(simulation.setting(), state))
    numbers.insert(numbers.end(), {contact.gap / c.h, contact.gamma / c.h, contact.normal_force,
                                   norm(contact.tangential_force)});
  if (c.kind == Kind::kSliding) {
    const auto contacts = contacts_of(simulation.setting(), state);
    EXPECT_GT(norm(contacts.at(0).tangential_force), 0.1);
  }
  numbers.push_back(simulation.fluid_forces()[0]);
  return numbers;
}

void expect_same(const std::vector<double>& numbers, const std::vector<double>& expected) {
  ASSERT_EQ(numbers.size(), expected.size());
  double largest = 0;
  for (const double x : expected) largest = std::max(largest, std::abs(x));
  // Rounding errors of positions over the length of the step are about 1e-14.
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(numbers[i], expected[i], 1e-9 * largest) << i;
}

constexpr std::array kGradients = {std::array<double, 4>{0, 1.3, 0, 0},
                                   std::array<double, 4>{0.8, 0, 0, -0.8}};

TEST(ShearedCell, IsTheSameWhereverItBegins) {
  Random random(5);
  for (const auto kind : kKinds)
    for (const auto& gradient : kGradients)
      for (const double mass : {0.0, 1.7}) {
        if (kind == Kind::kTorsion) continue;  // a hinge is at rest, and not relative to the flow
        CellCase c{kind, gradient, mass};
        const auto expected = result_of(c);
        for (int n = 0; n < 12; ++n) {
          c.origin = {random.uniform(-8, 8), random.uniform(-6, 6), 0};
          SCOPED_TRACE(testing::Message()
                       << int(kind) << " mass " << mass << " gradient " << gradient[0] << " origin "
                       << c.origin[0] << ", " << c.origin[1]);
          expect_same(result_of(c), expected);
          if (HasFailure()) return;
        }
      }
}

/// Where the shift of the cell does not change the mean flow at the hinge, nothing changes.
TEST(ShearedCell, HoldsAHingeWhereverItBeginsAlongTheFlow) {
  Random random(6);
  for (const double mass : {0.0, 1.7}) {
    CellCase c{Kind::kTorsion, kGradients[0], mass};
    for (const double y : {0.0, 1.4}) {
      c.origin = {0, y, 0};
      const auto expected = result_of(c);
      for (int n = 0; n < 12; ++n) {
        c.origin[0] = random.uniform(-8, 8);
        expect_same(result_of(c), expected);
      }
    }
  }
}

/// A shift of the cell changes the mean flow at a hinge, which is at rest. With its force and
/// torque in place of the hinge, the point moves with minus the mean flow that it had.
TEST(ShearedCell, HoldsAHingeWithTheForceThatABodyInsideNeeds) {
  for (const auto& gradient : kGradients)
    for (const Vector& origin : {Vector{1.3, 1.4, 0}, Vector{0, 1.4, 0}, Vector{1.3, 0, 0}}) {
      // The hinge holds after the finite turn of the step, and its force acts at the beginning: the
      // difference is in proportion to h.
      constexpr double kShortStep = 1e-7;
      CellCase c{Kind::kTorsion, gradient, 0, kShortStep};
      c.origin = origin;  // cuts the body
      auto system = system_of(c);
      auto simulation = system.simulation(resistance_in_cell);
      const auto before = simulation.state().particles;
      run(simulation, c.h);
      const auto forces = simulation.state().link_forces;
      CellCase inside{Kind::kTorsion, gradient, 0, kShortStep};
      inside.is_held = false;
      inside.hinge_force = {forces[0], forces[1], 0};
      inside.hinge_torque = forces[2];
      auto free = system_of(inside);
      auto moving = free.simulation(resistance_in_cell);
      const auto free_before = moving.state().particles;
      run(moving, c.h);
      const auto& held = simulation.state().particles;
      const auto& freed = moving.state().particles;
      for (std::size_t k = 0; k < held.count(); ++k) {
        const Vector v = held.velocity(k) - mean_velocity(before.cell, before.position(k));
        const Vector w =
            freed.velocity(k) - mean_velocity(free_before.cell, free_before.position(k));
        EXPECT_NEAR(norm(v - w), 0, 1e-9 * norm(w)) << k << " " << origin[0] << " " << origin[1];
        EXPECT_NEAR(held.angular_velocities[k], freed.angular_velocities[k], 1e-9) << k;
      }
    }
}

/// Two discs that are pressed on each other within the cell, and across its side, where the image
/// moves by h G P = 0.39 in the step.
TEST(ShearedCell, HasTheGapOfAContactWithTheImageThatMoves) {
  const double h = 0.05;
  std::vector<double> gaps;
  for (const double shift : {0.0, 2.0}) {
    auto system = in_fluid(2, 1, h, 0.01);
    system.setting.domain = BoxDomain{{0, shift}, {8, shift + 6}, {true, true}};
    system.setting.fluid->boundary = LinearFlow{{0, 1.3, 0, 0}};
    const Vector first{4, 5.6, 0}, apart{0.5, 0.87, 0};
    for (Vector x : {first, first + apart}) {
      if (x[1] >= shift + 6) x[1] -= 6;
      add_pushed(system, x, kRadius, 0, {});
    }
    system.setting.forces[0] = constant({0, 9, 0});
    system.setting.forces[1] = constant({0, -9, 0});
    auto simulation = system.simulation(resistance_in_cell);
    run(simulation, h);
    const auto contacts = contacts_of(simulation.setting(), simulation.state());
    ASSERT_EQ(contacts.size(), 1U);
    gaps.push_back(contacts[0].gap);
    EXPECT_LT(largest_overlap(simulation.setting(), simulation.state()), 1e-12);
  }
  // Rounding errors of positions.
  EXPECT_NEAR(gaps[0], gaps[1], 1e-13);
}

/// Two flat ellipses above each other, whose circles overlap, within the cell and across its side.
/// After the time 1 the image below has moved by -1 along x.
TEST(ShearedCell, HasTheOverlapsOfEllipsesAndNotOfTheirCircles) {
  auto system = in_fluid(2, 1, 0.1, 0.01);
  system.setting.domain = BoxDomain{{0, 0}, {8, 6}, {true, true}};
  system.setting.fluid->boundary = LinearFlow{{0, 1.0 / 6, 0, 0}};
  for (const Vector& at :
       {Vector{4, 3, 0}, Vector{4, 3.7, 0}, Vector{4, 0.2, 0}, Vector{5, 5.5, 0}})
    add_pushed(system, at, 1, 0, {});
  auto& p = system.state.particles;
  p.shapes.assign(4, Shape::ellipse(1, 0.25));
  p.angles.assign(4, 0);
  p.cell = cell_of(system.setting);
  p.cell.moved_for = system.state.time = 1;
  EXPECT_EQ(largest_overlap(system.setting, system.state), 0);
  p.positions[7] = 5.8;  // the image of the last ellipse at (4, -0.2) overlaps the third by 0.1
  EXPECT_NEAR(largest_overlap(system.setting, system.state), 0.1, 1e-9);
}

}  // namespace
}  // namespace viscontact::particles
