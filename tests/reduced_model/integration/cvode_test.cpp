// The CVODE wrapper on systems whose solution is known.
#include "viscontact/reduced_model/integration/cvode.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr double kTolerance = 1e-10;
// Errors of steps add up; a hundred of them in the motions here, of random sign or not.
constexpr double kReached = 100 * kTolerance;

void tolerance(double, std::span<const double> y, std::span<double> allowed) {
  for (std::size_t i = 0; i < y.size(); ++i) allowed[i] = kTolerance * (1 + std::abs(y[i]));
}

/// x'' = -x.
StiffSystem oscillator() {
  StiffSystem system;
  system.dimension = 2;
  system.tolerance = tolerance;
  system.derivative = [](double, std::span<const double> y, std::span<double> derivative) {
    derivative[0] = y[1];
    derivative[1] = -y[0];
  };
  system.jacobian = [](double, std::span<const double>, std::span<double> jacobian) {
    jacobian[0] = 0;
    jacobian[1] = -1;
    jacobian[2] = 1;
    jacobian[3] = 0;
  };
  return system;
}

/// Decay towards cos t at a rate of a million, from its slow solution y0 = cos t; y1 = sin t beside
/// it.
StiffSystem stiff_decay() {
  constexpr double kRate = 1e6;
  StiffSystem system;
  system.dimension = 2;
  system.tolerance = tolerance;
  system.derivative = [](double t, std::span<const double> y, std::span<double> derivative) {
    derivative[0] = -kRate * (y[0] - std::cos(t)) - y[1];
    derivative[1] = std::cos(t);
  };
  system.jacobian = [](double, std::span<const double>, std::span<double> jacobian) {
    jacobian[0] = -kRate;
    jacobian[1] = 0;
    jacobian[2] = -1;
    jacobian[3] = 0;
  };
  return system;
}

/// Steps to the stop time.
void finish(Cvode& cvode, double stop_time) {
  while (cvode.time() < stop_time) cvode.step();
}

TEST(Cvode, SolvesAnOscillatorAlsoBetweenItsSteps) {
  Cvode cvode(oscillator(), std::array{1.0, 0.0});
  cvode.restart(0, 3);
  double begin = 0;
  while (begin < 3) {
    cvode.step();
    ASSERT_GT(cvode.time(), begin);
    for (const double share : {0.0, 0.3, 1.0}) {
      const double t = std::lerp(begin, cvode.time(), share);
      EXPECT_NEAR(cvode.at(t, 0), std::cos(t), kReached);
      EXPECT_NEAR(cvode.at(t, 1), -std::sin(t), kReached);
    }
    // The same polynomial in powers, each of its terms at most of size 1: a few roundings.
    const auto expansion = cvode.expansion(0);
    double value = 0;
    for (std::size_t k = expansion.size(); k-- > 0;)
      value = value * (begin - cvode.time()) / 2 + expansion[k];
    EXPECT_NEAR(value, cvode.at(begin + (cvode.time() - begin) / 2, 0), 1e-14);
    begin = cvode.time();
  }
  EXPECT_EQ(cvode.time(), 3);
  EXPECT_NEAR(cvode.state()[0], std::cos(3.0), kReached);
  EXPECT_GT(cvode.steps(), 10);
}

TEST(Cvode, SolvesAStiffSystemInLargeSteps) {
  Cvode cvode(stiff_decay(), std::array{1.0, 0.0});
  cvode.restart(0, 10);
  finish(cvode, 10);
  EXPECT_NEAR(cvode.state()[0], std::cos(10.0), kReached);
  EXPECT_NEAR(cvode.state()[1], std::sin(10.0), kReached);
  EXPECT_LT(cvode.steps(), 10'000);  // an explicit method would need ten million
}

TEST(Cvode, NeverLooksPastTheStopTimeAndGoesOnFromThereWithAnotherSystem) {
  // x' = v, v' = f with f = 1 until t = 1, then -3: x(1) = 1/2, v(1) = 1; x(2) = 0, v(2) = -2.
  double f = 1;
  double latest = 0;
  StiffSystem system = oscillator();
  system.derivative = [&](double t, std::span<const double> y, std::span<double> derivative) {
    latest = std::max(latest, t);
    derivative[0] = y[1];
    derivative[1] = f;
  };
  system.jacobian = [](double, std::span<const double>, std::span<double> jacobian) {
    std::ranges::fill(jacobian, 0);
    jacobian[2] = 1;
  };
  Cvode cvode(system, std::array{0.0, 0.0});
  cvode.restart(0, 1);
  finish(cvode, 1);
  EXPECT_EQ(cvode.time(), 1);
  EXPECT_LE(latest, 1);
  EXPECT_NEAR(cvode.state()[0], 0.5, kReached);
  EXPECT_NEAR(cvode.state()[1], 1, kReached);

  const long steps = cvode.steps();
  f = -3;
  cvode.restart(1, 2);
  finish(cvode, 2);
  EXPECT_EQ(cvode.time(), 2);
  EXPECT_LE(latest, 2);
  EXPECT_NEAR(cvode.state()[0], 0, kReached);
  EXPECT_NEAR(cvode.state()[1], -2, kReached);
  EXPECT_GT(cvode.steps(), steps);  // counted since construction
}

TEST(Cvode, PassesOnAnErrorThatTheSystemThrows) {
  // The system cannot judge x < 1/2, which the oscillator reaches at t = pi/3.
  StiffSystem system = oscillator();
  const auto derivative = system.derivative;
  system.derivative = [derivative](double t, std::span<const double> y, std::span<double> result) {
    if (y[0] < 0.5) throw Error(ErrorKind::kBadInput, "x is too small for us");
    derivative(t, y, result);
  };
  Cvode cvode(system, std::array{1.0, 0.0});
  cvode.restart(0, 3);
  EXPECT_THAT(bad_input([&] { finish(cvode, 3); }), Names("x is too small for us"));
}

TEST(Cvode, PassesOnAnErrorOfTheJacobian) {
  StiffSystem system = oscillator();
  system.jacobian = [](double, std::span<const double>, std::span<double>) {
    throw Error(ErrorKind::kBadInput, "no slope here");
  };
  Cvode cvode(system, std::array{1.0, 0.0});
  cvode.restart(0, 3);
  EXPECT_THAT(bad_input([&] { finish(cvode, 3); }), Names("no slope here"));
}

TEST(Cvode, GetsAroundAnErrorThatASmallerStepAvoids) {
  // Refused once, far ahead of the solution; CVODE comes back with a smaller step.
  bool refused = false;
  StiffSystem system = oscillator();
  const auto derivative = system.derivative;
  system.derivative = [&refused, derivative](double t, std::span<const double> y,
                                             std::span<double> result) {
    if (!refused && t > 0.5) {
      refused = true;
      throw Error(ErrorKind::kBadInput, "not there");
    }
    derivative(t, y, result);
  };
  Cvode cvode(system, std::array{1.0, 0.0});
  cvode.restart(0, 1);
  finish(cvode, 1);
  EXPECT_TRUE(refused);
  EXPECT_NEAR(cvode.state()[0], std::cos(1.0), kReached);
}

/// y' = y^2, which from y(0) = 1 is infinite at t = 1.
StiffSystem blow_up() {
  StiffSystem system;
  system.dimension = 1;
  system.tolerance = tolerance;
  system.derivative = [](double, std::span<const double> y, std::span<double> derivative) {
    derivative[0] = y[0] * y[0];
  };
  system.jacobian = [](double, std::span<const double> y, std::span<double> jacobian) {
    jacobian[0] = 2 * y[0];
  };
  return system;
}

TEST(Cvode, SaysWhenItGivesUp) {
  Cvode cvode(blow_up(), std::array{1.0});
  cvode.restart(0, 2);
  failure(ErrorKind::kNotConverged, [&] { finish(cvode, 2); });
}

TEST(Cvode, PrintsNothing) {
  // Close to the pole CVODE has both a warning (a step is below the rounding of t) and an error to
  // report. SUNDIALS 7 prints warnings on standard output, where they would spoil JSON and tables.
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Cvode cvode(blow_up(), std::array{1.0});
  cvode.restart(0, 2);
  failure(ErrorKind::kNotConverged, [&] { finish(cvode, 2); });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace viscontact::reduced_model
