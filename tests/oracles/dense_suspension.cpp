#include "tests/oracles/dense_suspension.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace viscontact::oracles {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Loads {
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  Matrix3d stresslet = Matrix3d::Zero();
};

struct Pair {
  Vector3d n;  // from 1 to 2
  double a1, a2, squeeze, log;
};

/// The fluid's loads on a turning sphere `a` and its neighbour `b`, in the direction m.
void add_turning(const Pair& pair, double a, double b, const Vector3d& m, const Vector3d& turn,
                 Loads& of_a, Loads& of_b) {
  const Vector3d w = turn - turn.dot(m) * m, q = w.cross(m);
  const double r = a * b / (a + b), l = pair.log / 6;
  const Matrix3d mq = m * q.transpose() + q * m.transpose();
  const Vector3d force = r * (12.0 / 5 * r - 16.0 / 5 * a) * l * q;
  of_a.force += force;
  of_b.force -= force;
  of_a.torque -= 16.0 / 5 * a * a * r * l * w;
  of_b.torque -= 4.0 / 5 * a * b * r * l * w;
  of_a.stresslet += a * r * (12.0 / 5 * r - 8.0 / 5 * a) * l * mq;
  of_b.stresslet -= a * r * (12.0 / 5 * r + 2.0 / 5 * b) * l * mq;
}

/// In units of 6 pi viscosity. `d` is the motion of the second surface relative to the first.
std::array<Loads, 2> loads_of(const Pair& pair, const Vector3d& d, const Vector3d& w1,
                              const Vector3d& w2) {
  std::array<Loads, 2> loads;
  const Vector3d force = pair.squeeze * pair.n.dot(d) * pair.n;
  loads[0].force += force;
  loads[1].force -= force;
  loads[0].stresslet += pair.a1 * pair.n * force.transpose();
  loads[1].stresslet += pair.a2 * pair.n * force.transpose();
  const Vector3d rotation = pair.n.cross(d) / (pair.a1 + pair.a2);
  add_turning(pair, pair.a1, pair.a2, pair.n, w1 - rotation, loads[0], loads[1]);
  add_turning(pair, pair.a2, pair.a1, -pair.n, w2 - rotation, loads[1], loads[0]);
  return loads;
}

}  // namespace

DenseSuspension::Solution DenseSuspension::solve() const {
  const auto count = static_cast<Eigen::Index>(radii.size());
  const double unit = 6 * std::numbers::pi * viscosity;
  const Matrix3d strain = (gradient + gradient.transpose()) / 2;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6 * count, 6 * count);
  Eigen::VectorXd right = forces.size() > 0 ? forces : Eigen::VectorXd::Zero(6 * count);
  std::vector<std::pair<std::array<Eigen::Index, 2>, Pair>> pairs;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double a = radii[static_cast<std::size_t>(i)];
    for (int d = 0; d < 3; ++d) {
      matrix(6 * i + d, 6 * i + d) = drag * unit * a;
      matrix(6 * i + 3 + d, 6 * i + 3 + d) = drag * unit * 4 / 3 * a * a * a;
    }
    for (Eigen::Index j = i + 1; j < count; ++j)
      for (int x = -2; x <= 2; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            if ((x != 0 && periods[0] == 0) || (y != 0 && periods[1] == 0) ||
                (z != 0 && periods[2] == 0))
              continue;
            const Vector3d apart =
                positions[static_cast<std::size_t>(j)] - positions[static_cast<std::size_t>(i)] +
                Vector3d(x * periods[0] + y * offset, y * periods[1], z * periods[2]);
            const double b = radii[static_cast<std::size_t>(j)], distance = apart.norm();
            const double h = 2 * distance / (a + b) - 2, r = a * b / (a + b);
            if (h >= range) continue;
            const double q = h + regularisation;
            pairs.push_back(
                {{i, j}, {apart / distance, a, b, 2 * r * r / ((a + b) * q), std::log(1 / q)}});
          }
  }
  const auto add = [&](const std::array<Eigen::Index, 2>& at, const std::array<Loads, 2>& loads,
                       auto&& target) {
    for (const std::size_t s : {0U, 1U}) {
      target.template segment<3>(6 * at[s]) -= unit * loads[s].force;
      target.template segment<3>(6 * at[s] + 3) -= unit * loads[s].torque;
    }
  };
  for (const auto& [at, pair] : pairs) {
    for (int d = 0; d < 3; ++d) {
      const Vector3d e = Vector3d::Unit(d), none = Vector3d::Zero();
      add(at, loads_of(pair, -e, none, none), matrix.col(6 * at[0] + d));
      add(at, loads_of(pair, e, none, none), matrix.col(6 * at[1] + d));
      add(at, loads_of(pair, none, e, none), matrix.col(6 * at[0] + 3 + d));
      add(at, loads_of(pair, none, none, e), matrix.col(6 * at[1] + 3 + d));
    }
    Eigen::VectorXd of_strain = Eigen::VectorXd::Zero(6 * count);
    add(at,
        loads_of(pair, (pair.a1 + pair.a2) * strain * pair.n, Vector3d::Zero(), Vector3d::Zero()),
        of_strain);
    right -= of_strain;
  }
  Solution solution{matrix.partialPivLu().solve(right), Matrix3d::Zero(),
                    static_cast<int>(pairs.size())};
  for (const auto& [at, pair] : pairs) {
    const auto part = [&](std::size_t s, int from) {
      return Vector3d(solution.motions.segment<3>(6 * at[s] + from));
    };
    const Vector3d d = part(1, 0) - part(0, 0) + (pair.a1 + pair.a2) * strain * pair.n;
    for (const auto& loads : loads_of(pair, d, part(0, 3), part(1, 3)))
      solution.stresslets += unit * loads.stresslet;
  }
  return solution;
}

}  // namespace viscontact::oracles
