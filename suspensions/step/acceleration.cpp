#include "viscontact/suspensions/step/acceleration.hpp"

#include <Eigen/Dense>
#include <cassert>
#include <cmath>
#include <utility>

namespace viscontact::suspensions {
namespace {

struct AccelerationTuning {
  // Steps of 5 to 20 iterates need the same number of solutions within a tenth.
  static constexpr std::size_t kMostIterates = 10;
  // Changes that grow by this factor are those of other contacts.
  static constexpr double kLargestRise = 2;
  // Differences of changes, each over its length, whose part across the others is less than this
  // are no new directions but errors of the linear problems.
  static constexpr double kLeastPivot = 1e-3;
};

}  // namespace

void Acceleration::forget() {
  iterates_.clear();
  last_change_ = std::numeric_limits<double>::infinity();
}

void Acceleration::add(const std::vector<double>& before, const std::vector<double>& after,
                       const std::vector<Motion>& motions, double rate) {
  assert(before.size() == after.size());
  if (!iterates_.empty() && iterates_.back().loads.size() != after.size()) forget();
  if (iterates_.size() == AccelerationTuning::kMostIterates) iterates_.pop_front();
  std::vector<double> change(after.size());
  double sum = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    change[k] = after[k] - before[k];
    sum += change[k] * change[k];
  }
  if (std::sqrt(sum) > AccelerationTuning::kLargestRise * last_change_) {
    forget();
    return;
  }
  last_change_ = std::sqrt(sum);
  iterates_.push_back({after, std::move(change), motions, rate});
}

std::vector<double> Acceleration::weights() const {
  const auto rows = static_cast<Eigen::Index>(iterates_.back().change.size());
  const auto columns = static_cast<Eigen::Index>(iterates_.size()) - 1;
  const auto change = [&](Eigen::Index k) {
    return Eigen::Map<const Eigen::VectorXd>(iterates_[static_cast<std::size_t>(k)].change.data(),
                                             rows);
  };
  Eigen::MatrixXd differences(rows, columns);
  Eigen::VectorXd lengths(columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    differences.col(k) = change(k + 1) - change(k);
    lengths[k] = differences.col(k).norm();
    if (lengths[k] > 0) differences.col(k) /= lengths[k];
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(differences);
  factors.setThreshold(AccelerationTuning::kLeastPivot);
  const Eigen::VectorXd steps = factors.solve(change(columns));
  std::vector<double> weights(iterates_.size(), 0.0);
  weights.back() = 1;
  for (Eigen::Index k = 0; k < columns; ++k) {
    if (!(lengths[k] > 0)) continue;
    weights[static_cast<std::size_t>(k)] += steps[k] / lengths[k];
    weights[static_cast<std::size_t>(k) + 1] -= steps[k] / lengths[k];
  }
  return weights;
}

void Acceleration::combine(std::vector<double>& loads, std::vector<Motion>& motions,
                           double& rate) const {
  assert(!is_empty());
  const auto weight = weights();
  loads.assign(loads.size(), 0.0);
  motions.assign(motions.size(), Motion{});
  rate = 0;
  for (std::size_t j = 0; j < weight.size(); ++j) {
    const auto& iterate = iterates_[j];
    rate += weight[j] * iterate.rate;
    for (std::size_t k = 0; k < loads.size(); ++k) loads[k] += weight[j] * iterate.loads[k];
    for (std::size_t k = 0; k < motions.size(); ++k) {
      motions[k].along += weight[j] * iterate.motions[k].along;
      motions[k].turn += weight[j] * iterate.motions[k].turn;
    }
  }
}

}  // namespace viscontact::suspensions
