// Computes how the errors of a fit of the drag change the gap between the sphere and the wall
// during its motion without inertia, and writes and reads uncertainty.json (fit_uncertainty.hpp).
// Gaps [L], > 0, and times [T], >= 0, are in the units of the case; the misfit is relative, 0 to 1.
// The covariance of the fit must have a row and a column for each term (not checked). The
// coefficients of the fit are drawn at random many times; a set of drawn coefficients is called a
// draw, and is left out if its drag is not positive or makes the motion impossible. If all are left
// out, an Error(kNotConverged) is thrown. A fit that LubricationForce refuses throws its error, a
// wrong file an Error(kBadInput). A change must keep that `level` is the share between the ends in
// middle_of(). It must also keep the seed and the order of the random numbers, so that the same
// case gives the same file. pipeline/simulate, results/ and report/ use this file.
#include "viscontact/reduced_model/fit_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/common/text/json_fields.hpp"

namespace viscontact::reduced_model {
namespace {

/// A matrix L with L L^T = covariance. The covariance must be square and symmetric (not checked);
/// it may be singular, and eigenvalues < 0 count as 0. L is computed from the eigenvectors of the
/// matrix of correlations, because the coefficients differ in size by many powers of ten.
Eigen::MatrixXd root_of(const std::vector<std::vector<double>>& covariance) {
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

/// The ends of the interval that contains the middle 95 % of the values. Changes the order of
/// `values`. Throws Error(kNotConverged) if there are none.
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

/// The times at which gaps are computed [T]. The first of them is the time of the smallest gap, at
/// which the impulse of the external force is least. This time is 0, a time at which the force
/// jumps or changes its sign, or the end. Then follow `times` equidistant times from 0 to the end;
/// if `times` is 1, only the time 0 follows.
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

/// Computes the gap at `times` + 1 times with the fit, with the impulse of the external force
/// multiplied by 1 - misfit and by 1 + misfit (which bounds the effect of a relative error `misfit`
/// of the drag), and with `draws` random draws of its coefficients. Outside the interval of gaps of
/// the fit, the drag follows the formulas of outside.with_limits().
FitUncertainty propagate_fit(const Motion& motion, const lubrication::Fit& fit, std::size_t times,
                             const lubrication::OutsideInterval& outside, std::size_t draws) {
  const auto limits = outside.with_limits();
  const auto instants = instants_of(motion, times);
  std::vector<double> impulses;  // of the external force
  for (const double time : instants) impulses.push_back(motion.external_force.impulse(time));
  // Replaces `gaps` by the gaps with this drag at `instants`, if the external force acts by `share`
  // [1] of its impulse. The search for each gap begins at the gap that it replaces.
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

// The functions fields_of() state the keys of the file in their order, for reading and for writing:
// times [T], gaps [L], and pairs of gaps with the lower one first [L].
void fields_of(JsonFields& json, UncertainGap& gap) {
  json("time", gap.time);
  json("gap", gap.gap);
  json("random_interval", gap.random);
  json("misfit_interval", gap.misfit);
}

void fields_of(JsonFields& json, FitUncertainty& uncertainty) {
  double level = 0.95;
  json("level", level);
  json("draws", uncertainty.draws);
  json("refused_draws", uncertainty.refused);
  json("misfit", uncertainty.misfit);
  json("minimal_gap", uncertainty.smallest);
  json("gaps", uncertainty.gaps);
  json.foreign_object("provenance");
}

/// The text of uncertainty.json.
std::string write_uncertainty(const FitUncertainty& uncertainty) {
  return JsonFields::text_of(uncertainty);
}

/// Throws Error(kBadInput) if the file at `path` is missing or of another form.
FitUncertainty read_uncertainty(const std::filesystem::path& path) {
  return JsonFields::read<FitUncertainty>(read_file(path), path.string(),
                                          "; 'viscontact simulate' writes such a file");
}

}  // namespace viscontact::reduced_model
