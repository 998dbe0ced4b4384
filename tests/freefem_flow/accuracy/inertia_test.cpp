// Flows with inertia, solved by FreeFEM, against exact solutions of the Navier-Stokes equations,
// and invariances that they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::CylinderDomain;
using particles::FlowField;
using particles::FlowStart;
using particles::FluidMesh;
using particles::FluidSimulation;
using particles::RigidConstraint;
using particles::SideVelocities;
using particles::WallVelocity;
using std::numbers::pi;

particles::Fluid inertial(double viscosity, double density, int edges) {
  auto fluid = fluid_with(edges, RigidConstraint::kRigid);
  fluid.viscosity = viscosity;
  fluid.density = density;
  return fluid;
}

// --- Flows without particles, which the solver is asked for directly ---

/// Advances a flow without particles by `steps` steps of length h from time 0, where it is at rest
/// or `start`, the text of a saved flow. The first step is of first order. Returns the last flow.
FlowField advanced(const particles::Fluid& fluid, const BoxDomain& box, double h, int steps,
                   const std::function<std::string(std::string)>& start = {}) {
  const auto solver = start_fluid_solver(fluid, box, {}, 2);
  particles::Particles none;
  none.dimension = 2;
  solver->place({&none, {}, {}, {}, {0, h, h, 0, 0, 0, {}}});
  solver->velocities({}, true);
  solver->keep_flow(fluid.start == FlowStart::kRest, {});
  if (start) solver->load_flow(start(solver->saved_flow()));
  for (int n = 1; n <= steps; ++n) {
    const double t = n * h;
    solver->place({&none, {}, {}, {}, {n > 1 ? 2 : 1, h, h, t, t - h / 2, t + h / 2, {}}});
    solver->velocities({}, true);
    solver->keep_flow(false, {});
  }
  return solver->flow();
}

using Velocity = std::function<std::array<double, 2>(double x, double y)>;

/// The largest difference of the velocities at the nodes from exact ones.
double largest_error(const FlowField& flow, const Velocity& exact) {
  double largest = 0;
  for (std::size_t i = 0; i < flow.x.size(); ++i) {
    const auto u = exact(flow.x[i], flow.y[i]);
    largest = std::max(
        {largest, std::abs(flow.velocity_x[i] - u[0]), std::abs(flow.velocity_y[i] - u[1])});
  }
  return largest;
}

/// A saved flow with these velocities at both of its times. The file has the mesh, and then arrays,
/// each after its size: x, y, two ways, and the velocities u, v at t^{n-1} and t^{n-2}.
std::string with_velocities(const std::string& saved, const Velocity& velocity) {
  std::istringstream in(saved);
  std::ostringstream out;
  out.precision(17);
  std::string line;
  std::getline(in, line);
  std::istringstream sizes(line);
  std::size_t lines = 0;
  for (std::size_t count = 0; sizes >> count;) lines += count;
  out << line << '\n';
  for (; lines > 0; --lines) {
    std::getline(in, line);
    out << line << '\n';
  }
  std::vector<std::vector<double>> arrays(8);
  for (auto& array : arrays) {
    std::size_t count = 0;
    in >> count;
    array.resize(count);
    for (auto& number : array) in >> number;
  }
  for (std::size_t i = 0; i < arrays[0].size(); ++i) {
    const auto u = velocity(arrays[0][i], arrays[1][i]);
    arrays[4][i] = arrays[6][i] = u[0];
    arrays[5][i] = arrays[7][i] = u[1];
  }
  for (const auto& array : arrays) {
    out << array.size() << '\n';
    for (const double number : array) out << number << '\n';
  }
  std::getline(in, line);
  out << in.rdbuf();
  return out.str();
}

/// Vortices of Taylor and Green in a cell of width 1 that move with the velocity (U, V) and decay.
Velocity vortices(double time, double viscosity, std::array<double, 2> moving) {
  const double k = 2 * pi, decay = std::exp(-2 * k * k * viscosity * time);
  return [=](double x, double y) -> std::array<double, 2> {
    const double a = k * (x - moving[0] * time), b = k * (y - moving[1] * time);
    return {moving[0] + decay * std::sin(a) * std::cos(b),
            moving[1] - decay * std::cos(a) * std::sin(b)};
  };
}

FlowField advanced_vortices(int steps, double end, double viscosity, std::array<double, 2> moving) {
  return advanced(inertial(viscosity, 1, 24), {{0, 0}, {1, 1}, {true, true}}, end / steps, steps,
                  [&](const std::string& saved) {
                    return with_velocities(saved, vortices(0, viscosity, moving));
                  });
}

TEST(DecayingVortices, AreThoseOfTaylorAndGreenAtRestAndMoving) {
  // The mesh is coarse, with 6 edges along a side. The viscosity makes the Reynolds number 20.
  constexpr double kViscosity = 0.05, kEnd = 0.25;
  for (const auto& moving : {std::array{0.0, 0.0}, std::array{0.7, -0.4}}) {
    const auto flow = advanced_vortices(25, kEnd, kViscosity, moving);
    const auto error = largest_error(flow, vortices(kEnd, kViscosity, moving));
    EXPECT_LT(error, 0.02);
  }
}

TEST(DecayingVortices, HaveErrorsOfSecondOrderInTime) {
  // The differences of steps that are halved, on one mesh.
  for (const auto& moving : {std::array{0.0, 0.0}, std::array{0.7, -0.4}}) {
    std::vector<FlowField> flows;
    for (const int steps : {10, 20, 40})
      flows.push_back(advanced_vortices(steps, 0.5, 0.01, moving));
    const auto difference = [&](std::size_t a, std::size_t b) {
      double largest = 0;
      for (std::size_t i = 0; i < flows[a].x.size(); ++i)
        largest = std::max({largest, std::abs(flows[a].velocity_x[i] - flows[b].velocity_x[i]),
                            std::abs(flows[a].velocity_y[i] - flows[b].velocity_y[i])});
      return largest;
    };
    EXPECT_GT(difference(0, 1) / difference(1, 2), 3.2);
  }
}

TEST(WallThatOscillates, MovesTheFluidByItsVelocityAtEachTime) {
  // Stokes' second problem between two walls: after two periods hardly anything is left of the
  // start, exp(-pi^2 nu t) = 1e-4.
  constexpr double kViscosity = 0.2, kPeriod = 2;
  auto fluid = inertial(kViscosity, 1, 12);
  fluid.start = FlowStart::kStokes;
  WallVelocity wall{WallVelocity::Kind::kConstant, {1, 0}};
  wall.period = kPeriod;
  wall.amplitude = 0.5;
  fluid.boundary = SideVelocities{WallVelocity{}, {}, wall, {}};
  const BoxDomain box{{0, 0}, {0.5, 1}, {true, false}};
  const double omega = 2 * pi / kPeriod, end = 2.3 * kPeriod;
  const std::complex<double> k = std::sqrt(std::complex<double>(0, omega / kViscosity));
  const auto exact = [&](double, double y) -> std::array<double, 2> {
    const auto wave = std::sinh(k * (1 - y)) / std::sinh(k) * std::polar(1.0, omega * end);
    return {1 - y + 0.5 * wave.imag(), 0};
  };
  const auto error = [&](int steps) {
    return largest_error(advanced(fluid, box, end / steps, steps), exact);
  };
  const double coarse = error(46), fine = error(92);
  EXPECT_GT(coarse / fine, 3.2);
  EXPECT_LT(fine, 0.002);
}

TEST(WallThatStarts, MovesTheFluidByDiffusion) {
  // The bottom moves from time 0 on; u = 1 - y - sum 2/(n pi) exp(-n^2 pi^2 nu t) sin(n pi y).
  constexpr double kNu = 0.5, kEnd = 0.1;
  auto fluid = inertial(1, 1 / kNu, 16);
  fluid.boundary = SideVelocities{WallVelocity{}, {}, {WallVelocity::Kind::kConstant, {1, 0}}, {}};
  const auto exact = [&](double, double y) -> std::array<double, 2> {
    double u = 1 - y;
    for (int n = 1; n < 60; ++n)
      u -= 2 / (n * pi) * std::exp(-n * n * pi * pi * kNu * kEnd) * std::sin(n * pi * y);
    return {u, 0};
  };
  const auto flow = advanced(fluid, {{0, 0}, {0.5, 1}, {true, false}}, kEnd / 40, 40);
  EXPECT_LT(largest_error(flow, exact), 0.004);
}

// --- With particles ---

struct Run {
  particles::Setting setting;
  particles::State state;

  /// The simulation after steps until `end`.
  std::unique_ptr<FluidSimulation> at(double end) const {
    const auto& p = state.particles;
    auto simulation = std::make_unique<FluidSimulation>(
        setting, state,
        start_fluid_solver(*setting.fluid, setting.domain, shapes_of(p), p.dimension));
    while (simulation->state().time < end * (1 - 1e-9)) simulation->step(end);
    return simulation;
  }
  std::array<double, 3> motion_at(double end) const {
    const auto simulation = at(end);
    const auto& p = simulation->state().particles;
    if (p.dimension == 1) return {p.velocities[0], 0, 0};
    return {p.velocities[0], p.velocities[1], p.angular_velocities[0]};
  }
};

/// One disc of radius 0.5 in the middle of a box of width 3, or a sphere in a cylinder.
Run one_particle(const particles::Fluid& fluid, double density, double h, int dimension = 2,
                 bool periodic_y = true) {
  Run run;
  run.setting.time_step = h;
  run.setting.fluid = fluid;
  run.setting.fluid->threshold_gap = 0.01;
  run.setting.domain = BoxDomain{{0, 0}, {3, 3}, {true, periodic_y}};
  if (dimension == 1) run.setting.domain = CylinderDomain{1.5, 3};
  auto& p = run.state.particles;
  p.dimension = dimension;
  p.positions.assign(static_cast<std::size_t>(dimension), 1.5);
  p.velocities.assign(static_cast<std::size_t>(dimension), 0);
  p.radii = {0.5};
  p.masses = {density * particles::round_shape(dimension, 0.5).measure()};
  p.ids = {0};
  return run;
}

struct Method {
  RigidConstraint constraint;
  FluidMesh mesh;
};
constexpr std::array kMethods = {Method{RigidConstraint::kRigid, FluidMesh::kFitted},
                                 Method{RigidConstraint::kPenalty, FluidMesh::kFitted},
                                 Method{RigidConstraint::kPenalty, FluidMesh::kFixed}};

particles::Fluid by(const Method& method, double viscosity, double density) {
  auto fluid = inertial(viscosity, density, 8);
  fluid.constraint = method.constraint;
  fluid.mesh = method.mesh;
  return fluid;
}

TEST(PressureGradient, AcceleratesACellWithAParticleEvenly) {
  for (const auto& method : kMethods) {
    auto fluid = by(method, 0.5, 2);
    fluid.pressure_gradient = {-0.6, 0.4};
    const auto simulation = one_particle(fluid, 2, 0.1).at(0.5);
    const auto& p = simulation->state().particles;
    EXPECT_NEAR(p.positions[0], 1.5 + 0.3 * 0.125, 1e-7);
    EXPECT_NEAR(p.positions[1], 1.5 - 0.2 * 0.125, 1e-7);
    EXPECT_NEAR(p.velocities[0], 0.15, 1e-7);
    EXPECT_NEAR(p.velocities[1], -0.1, 1e-7);
  }
}

TEST(Gravity, LeavesAParticleOfTheDensityOfTheFluidAtRest) {
  for (const auto& method : kMethods)
    for (const int dimension : {1, 2}) {
      auto run = one_particle(by(method, 0.5, 2), 2, 0.1, dimension, false);
      run.setting.gravity = dimension == 1 ? particles::Vector{-10} : particles::Vector{3, -10};
      for (const double component : run.motion_at(0.2)) EXPECT_NEAR(component, 0, 1e-12);
    }
}

TEST(StartAsStokesFlow, StaysWhereNothingChanges) {
  // A flow along a channel, and a heavy disc that falls in a cell whose mean velocity is 0.
  for (const auto& method : {kMethods[0], kMethods[1]}) {
    auto fluid = by(method, 0.5, 2);
    fluid.start = FlowStart::kStokes;
    fluid.pressure_gradient = {-1, 0};
    const auto solid_load = one_particle(fluid, 2, 0.02, 2, false);
    const double u = solid_load.motion_at(0.02)[0], later = solid_load.motion_at(0.1)[0];
    // Without the disc it would be 9/8/0.5 in the middle.
    EXPECT_GT(u, 2);
    EXPECT_LT(u, 2.25);
    EXPECT_NEAR(later, u, 1e-3 * u);
    fluid.pressure_gradient = {};
    auto falling = one_particle(fluid, 5, 0.02);
    falling.setting.gravity = {0, -1};
    const double v = falling.motion_at(0.02)[1];
    EXPECT_LT(v, -0.15);
    EXPECT_NEAR(falling.motion_at(0.1)[1], v, 1e-3 * std::abs(v));
  }
}

TEST(StartAtRest, GivesTheFluidNoneOfTheMomentumOfAParticle) {
  // Momentum is kept: the disc has what it gave to the fluid less at once.
  auto run = one_particle(by(kMethods[0], 0.5, 2), 4, 0.01);
  run.state.particles.velocities = {1, 0};
  const double rigid = run.motion_at(0.03)[0];
  run.setting.fluid = by(kMethods[1], 0.5, 2);
  run.setting.fluid->threshold_gap = 0.01;
  EXPECT_NEAR(run.motion_at(0.03)[0], rigid, 0.01 * rigid);
  // With 8 edges the fixed mesh makes the disc seem larger.
  run.setting.fluid->mesh = FluidMesh::kFixed;
  const double fixed = run.motion_at(0.03)[0];
  EXPECT_GT(fixed, 0.65 * rigid);
  EXPECT_LT(fixed, rigid);
}

TEST(DrivenParticle, ThatStartsAtOnceFeelsTheForceOfUnsteadyStokesFlow) {
  // A step of first order from rest solves the equations of an oscillating sphere with the
  // frequency 1/(i h): F = 6 pi mu r U (1 + z + z^2/9), z = r sqrt(rho/(mu h)) (Stokes 1851); z^2/9
  // is the added mass. The first step is computed again in the second one. The layer around the
  // sphere has the thickness r/z, two edges; a cylinder 8 times as wide adds half a percent.
  constexpr double kZ = 2, kSpeed = 1e-3;
  for (const auto& method : {kMethods[0], kMethods[1]}) {
    auto run = one_particle(by(method, 1, 1), 1, 1 / (kZ * kZ), 1);
    run.setting.fluid->edges_per_particle = 24;
    run.setting.domain = CylinderDomain{8, 16};
    run.state.particles.positions = {8};
    run.state.particles.radii = {1};
    run.setting.given_motions[0].velocity.pieces = {{1e300, {kSpeed, 0, 0}}};
    const double force = run.at(2 / (kZ * kZ))->fluid_forces().at(0);
    EXPECT_NEAR(force / (-6 * pi * kSpeed * (1 + kZ + kZ * kZ / 9)), 1, 0.01);
  }
}

TEST(DrivenParticle, FeelsTheForceOfTheFluidAndNotItsOwnInertia) {
  // Its velocity jumps. The density of the driven particle must not matter.
  for (const int dimension : {1, 2})
    for (const auto& method : {kMethods[0], kMethods[1]}) {
      std::vector<double> forces;
      for (const double density : {2.0, 20.0}) {
        auto run = one_particle(by(method, 0.5, 2), density, 0.05, dimension, false);
        auto& given = run.setting.given_motions[0];
        given.velocity.pieces = {{0.12, {}}, {1e300, {0.5, 0, 0}}};
        given.angular_velocity.pieces = {{0.12, {}}, {1e300, {0, 0, 2}}};
        const auto of_fluid = run.at(0.2)->fluid_forces();
        forces.insert(forces.end(), of_fluid.begin(), of_fluid.end());
      }
      const auto half = forces.size() / 2;
      for (std::size_t i = 0; i < half; ++i)
        EXPECT_NEAR(forces[half + i], forces[i], 1e-5 * std::abs(forces[0]));
      EXPECT_LT(forces[0], 0);
    }
}

/// Two discs that fall in a channel: the velocities of the first one, then of the second one, as
/// the frame sees them that is turned by a right angle if `turned`.
std::vector<double> velocities_of_two(bool turned, double shift, bool swapped) {
  auto run = one_particle(by(kMethods[0], 0.2, 1), 3, 0.05);
  const auto along = [&](double x, double y) {
    return turned ? particles::Vector{-y, x} : particles::Vector{x, y};
  };
  auto& box = std::get<BoxDomain>(run.setting.domain);
  box = turned ? BoxDomain{{-3, shift}, {0, 3 + shift}, {false, true}}
               : BoxDomain{{shift, 0}, {3 + shift, 3}, {true, false}};
  run.setting.gravity = along(0.3, -1);
  const auto gradient = along(-0.5, 0);
  run.setting.fluid->pressure_gradient = {gradient[0], gradient[1]};
  auto& p = run.state.particles;
  p.positions.clear();
  p.velocities = {0, 0, 0, 0};
  p.masses.clear();
  p.radii.clear();
  p.ids = {0, 1};
  for (const int k : {swapped ? 1 : 0, swapped ? 0 : 1}) {
    // Places in the box that begins at the shift, which is less than 1.4.
    const double x = (k == 0 ? 1.0 : 1.7) + (k == 0 && shift > 1 ? 3 : 0);
    const auto place = along(x, k == 0 ? 1.0 : 2.2);
    p.positions.insert(p.positions.end(), {place[0], place[1]});
    p.radii.push_back(k == 0 ? 0.4 : 0.5);
    p.masses.push_back((k == 0 ? 3 : 2) * particles::round_shape(2, p.radii.back()).measure());
  }
  const auto simulation = run.at(0.4);
  const auto& after = simulation->state().particles;
  std::vector<double> velocities;
  for (const std::size_t k : {swapped ? 1U : 0U, swapped ? 0U : 1U}) {
    const auto v = std::array{after.velocities[2 * k], after.velocities[2 * k + 1]};
    velocities.push_back(turned ? v[1] : v[0]);
    velocities.push_back(turned ? -v[0] : v[1]);
    velocities.push_back(after.angular_velocities[k]);
  }
  return velocities;
}

TEST(Inertia, KnowsNoDirectionNoOriginAndNoOrder) {
  const auto plain = velocities_of_two(false, 0, false);
  const auto expect_same = [&](const std::vector<double>& other) {
    // Meshes with 8 edges around a disc differ by this much.
    for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(other[i], plain[i], 0.004);
  };
  EXPECT_GT(plain[0], 0.1);
  expect_same(velocities_of_two(true, 0, false));
  expect_same(velocities_of_two(false, 1.3, false));
  expect_same(velocities_of_two(false, 0, true));
}

TEST(Units, ChangeNoFlow) {
  // Lengths, times and masses in units over ten decades each.
  const auto velocity_in = [](double length, double time, double mass) {
    // In the plane masses are per length.
    auto fluid =
        by(kMethods[0], 0.5 * mass / (length * time) * length, 2 * mass / (length * length));
    auto run = one_particle(fluid, 5 * mass / (length * length), 0.05 * time, 2, false);
    auto& box = std::get<BoxDomain>(run.setting.domain);
    for (auto* corner : {&box.from, &box.to})
      for (auto& x : *corner) x *= length;
    run.setting.fluid->threshold_gap *= length;
    run.state.particles.positions = {1.5 * length, 1.3 * length};
    run.state.particles.radii = {0.5 * length};
    run.state.particles.masses = {5 * mass * pi / 4};
    run.setting.gravity = {length / (time * time), -2 * length / (time * time)};
    const auto motion = run.motion_at(0.25 * time);
    return std::array{motion[0] * time / length, motion[1] * time / length, motion[2] * time};
  };
  const auto one = velocity_in(1, 1, 1);
  for (const auto& [length, time, mass] :
       {std::array{1e5, 1e-4, 1e3}, std::array{1e-5, 1e5, 1e-5}, std::array{3e2, 7e-5, 1e5}}) {
    const auto other = velocity_in(length, time, mass);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(other[c], one[c], 1e-3 * std::abs(one[1]))
          << length << " " << time << " " << mass;
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
