// Intervals of the gap from random draws of the coefficients of the fit, and from its misfit.
#include "viscontact/reduced_model/fit_uncertainty.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <random>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/common/text/json_fields.hpp"

namespace viscontact::reduced_model {
namespace {

/// A matrix L with L L^T = covariance, which is symmetric. It may be singular; eigenvalues < 0
/// count as 0. L is computed from the eigenvectors of the matrix of correlations, because the
/// coefficients differ in size by many powers of ten.
Eigen::MatrixXd root_of(const std::vector<std::vector<double>>& covariance) {
  assert(std::ranges::all_of(covariance,
                             [&](const auto& row) { return row.size() == covariance.size(); }));
  const auto size = static_cast<Eigen::Index>(covariance.size());
  Eigen::MatrixXd matrix(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      matrix(i, j) = covariance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Eigen::VectorXd deviation = matrix.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd over = (deviation.array() > 0).select(deviation.cwiseInverse(), 0);
  const Eigen::MatrixXd correlations = over.asDiagonal() * matrix * over.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlations);
  return deviation.asDiagonal() * eigen.eigenvectors() *
         eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// The ends of the interval that contains the middle 95 % of the values, whose order changes.
/// Throws Error(kNotConverged) if there are none.
std::array<double, 2> middle_of(std::vector<double>& values) {
  if (values.empty())
    throw Error(ErrorKind::kNotConverged,
                "no random draw of the fit's coefficients gives a positive drag");
  const auto at = [&](double share) {
    const auto place = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, place);
    return *place;
  };
  return {at(0.025), at(0.975)};
}

/// The time of the smallest gap, at which the impulse of the external force is least (0, a jump or
/// change of sign of the force, or the end), and then `times` equidistant times from 0 to the end.
std::vector<double> instants_of(const Motion& motion, std::size_t times) {
  auto ends = motion.external_force.jumps();
  std::erase_if(ends, [&](double t) { return t > motion.end_time; });
  ends.insert(ends.end(), {0, motion.end_time});
  try {
    std::ranges::copy(motion.external_force.sign_changes(motion.end_time),
                      std::back_inserter(ends));
  } catch (const Error&) {
    // The force has too many periods to find all its changes of sign.
  }
  std::vector<double> instants = {*std::ranges::min_element(
      ends, {}, [&](double t) { return motion.external_force.impulse(t); })};
  for (std::size_t i = 0; i < times; ++i)
    instants.push_back(motion.end_time * static_cast<double>(i) /
                       static_cast<double>(std::max<std::size_t>(1, times - 1)));
  return instants;
}

}  // namespace

FitUncertainty propagate_fit(const Motion& motion, const lubrication::Fit& fit, std::size_t times,
                             const lubrication::OutsideInterval& outside, std::size_t draws) {
  assert(fit.covariance.size() == fit.terms.size());
  const auto limits = outside.with_limits();
  const auto instants = instants_of(motion, times);
  std::vector<double> impulses;  // of the external force
  for (const double time : instants) impulses.push_back(motion.external_force.impulse(time));
  // Replaces `gaps` by the gaps with this drag at `instants`, if the external force acts by `share`
  // of its impulse. The search for each gap begins at the gap that it replaces.
  const auto gaps_with = [&](const lubrication::LubricationForce& force, double share,
                             std::vector<double>& gaps) {
    const double start = force.impulse(motion.initial_gap);
    for (std::size_t i = 0; i < instants.size(); ++i)
      gaps[i] = force.gap_of_impulse(start + share * impulses[i], gaps[i]);
  };
  FitUncertainty result;
  result.draws = draws;
  const double residual =
      fit.diagnostics ? fit.diagnostics->largest_inlier_residual : fit.largest_relative_residual;
  const double estimate = fit.diagnostics ? fit.diagnostics->largest_error_estimate : 0;
  result.misfit = std::min(1.0, residual + estimate + residual * estimate);
  const lubrication::LubricationForce force(fit, limits);
  std::vector<double> gaps(instants.size(), motion.initial_gap);
  gaps_with(force, 1, gaps);
  auto less = gaps, more = gaps;
  gaps_with(force, 1 - result.misfit, less);
  gaps_with(force, 1 + result.misfit, more);

  const Eigen::MatrixXd root = root_of(fit.covariance);
  std::mt19937_64 random(1);  // a fixed seed, so that the draws are always the same
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> drawn(instants.size());
  lubrication::Fit one = fit;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd z(root.cols());
    for (auto& component : z) component = normal(random);
    const Eigen::VectorXd shift = root * z;
    for (std::size_t i = 0; i < one.terms.size(); ++i)
      one.terms[i].coefficient = fit.terms[i].coefficient + shift(static_cast<Eigen::Index>(i));
    auto of_draw = gaps;
    try {
      gaps_with(lubrication::LubricationForce(one, limits), 1, of_draw);
    } catch (const Error&) {
      ++result.refused;
      continue;
    }
    for (std::size_t i = 0; i < instants.size(); ++i) drawn[i].push_back(of_draw[i]);
  }
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const UncertainGap uncertain = {instants[i],
                                    gaps[i],
                                    middle_of(drawn[i]),
                                    {std::min(less[i], more[i]), std::max(less[i], more[i])}};
    if (i == 0)
      result.smallest = uncertain;
    else
      result.gaps.push_back(uncertain);
  }
  return result;
}

void fields_of(JsonFields& json, UncertainGap& gap) {
  // The functions fields_of() state the keys of the file in their order, for reading and writing.
  json("time", gap.time);
  json("gap", gap.gap);
  json("random_interval", gap.random);
  json("misfit_interval", gap.misfit);
}

void fields_of(JsonFields& json, FitUncertainty& uncertainty) {
  double level = 0.95;
  // The share of draws between the ends of middle_of().
  json("level", level);
  json("draws", uncertainty.draws);
  json("refused_draws", uncertainty.refused);
  json("misfit", uncertainty.misfit);
  json("minimal_gap", uncertainty.smallest);
  json("gaps", uncertainty.gaps);
  json.foreign_object("provenance");
}

std::string write_uncertainty(const FitUncertainty& uncertainty) {
  return JsonFields::text_of(uncertainty);
}

FitUncertainty read_uncertainty(const std::filesystem::path& path) {
  return JsonFields::read<FitUncertainty>(read_file(path), path.string(),
                                          "; 'viscontact simulate' writes such a file");
}

}  // namespace viscontact::reduced_model
