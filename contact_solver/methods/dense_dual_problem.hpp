// A dual problem with a given matrix W, and solutions of dual problems without a sparse factor.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/contact_solver/methods/mprgp.hpp"
#include "viscontact/contact_solver/problem/dual_problem.hpp"

namespace viscontact::contact_solver {

/// The dual problem (5.4) with a given matrix W [T/M]. A vector y = B z holds the product of
/// scaled_matrix and z, and then z.
class DenseDualProblem : public DualProblem {
 public:
  /// `gaps` are those without impulses [L]. The matrix of the problem is the symmetric part of W.
  /// If W is not symmetric, the product of its skew part and the guesses is added to the gaps.
  DenseDualProblem(std::span<const ContactBounds> contacts, std::span<const double> gaps,
                   const Eigen::MatrixXd& w, bool is_symmetric)
      : DualProblem(contacts.size()) {
    assert(w.rows() == std::ssize(contacts) && w.cols() == w.rows());
    assert(gaps.size() == contacts.size());
    Eigen::VectorXd further = Eigen::VectorXd::Zero(w.rows());
    if (!is_symmetric)
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto i = static_cast<Eigen::Index>(c);
        further += contacts[c].impulse / 2 * (w.col(i) - w.row(i).transpose());
      }
    for (std::size_t c = 0; c < contacts.size(); ++c)
      set(c, contacts[c], gaps[c] + further[static_cast<Eigen::Index>(c)]);
    const Eigen::Map<const Eigen::VectorXd> scales(scale.data(), std::ssize(scale));
    scaled_matrix = w.cwiseQuotient(scales * scales.transpose());
    scaled_matrix = (scaled_matrix + scaled_matrix.transpose().eval()) / 2;
  }

  std::size_t displacement_count() const { return 2 * count(); }
  ThreadPool& pool() const { return pool_; }

  double to_bodies(std::span<const double> values, std::span<double> y) const {
    const auto n = static_cast<Eigen::Index>(count());
    const Eigen::Map<const Eigen::VectorXd> z_of(values.data(), n);
    Eigen::Map<Eigen::VectorXd> product(y.data(), n);
    product = scaled_matrix * z_of;
    std::ranges::copy(values, y.begin() + n);
    return product.dot(z_of);
  }
  double combine(std::span<const double> y, double factor, std::span<double> into) const {
    double form = 0;
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = y[i] + factor * into[i];
    for (std::size_t c = 0; c < count(); ++c) form += into[c] * into[count() + c];
    return form;
  }
  double to_contact(std::size_t c, const double* y) const { return y[c]; }

  Eigen::MatrixXd scaled_matrix;  ///< [1], symmetric, with the diagonal 1

 private:
  mutable ThreadPool pool_{1};
};

/// For active_set_newton().
class DenseFactor {
 public:
  explicit DenseFactor(double error_of_w) : error_of_w_(error_of_w) { assert(error_of_w >= 0); }

  bool exists() const { return !free_.empty(); }  ///< true after the first factorise()
  /// Of the contacts c with free[c] != 0. Returns true in any case.
  bool factorise(const DenseDualProblem& problem, const std::vector<char>& free) {
    free_ = free;
    chosen_.clear();
    for (std::size_t c = 0; c < free.size(); ++c)
      if (free[c] != 0) chosen_.push_back(static_cast<Eigen::Index>(c));
    matrix_ = problem.scaled_matrix(chosen_, chosen_);
    // Redundant contacts make W singular, up to its errors. The term, which is as large as these
    // errors, bounds the impulses of redundant contacts. The refinement in solve() removes the
    // error that the term causes in all other impulses.
    Eigen::MatrixXd regular = matrix_;
    regular.diagonal() *= 1 + error_of_w_;
    factor_.compute(regular);
    return true;
  }
  /// Sets `solved` to the inverse of the scaled W between the chosen contacts times `gradient`.
  void solve(std::span<const double> gradient, std::span<double> solved) const {
    const Eigen::VectorXd right =
        Eigen::Map<const Eigen::VectorXd>(gradient.data(), std::ssize(gradient))(chosen_);
    Eigen::VectorXd values = factor_.solve(right);
    constexpr int kRefinements = 2;
    for (int i = 0; i < kRefinements; ++i) values += factor_.solve(right - matrix_ * values);
    std::ranges::fill(solved, 0.0);
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      solved[static_cast<std::size_t>(chosen_[i])] = values[static_cast<Eigen::Index>(i)];
  }

 private:
  double error_of_w_;
  std::vector<char> free_;
  std::vector<Eigen::Index> chosen_;
  Eigen::MatrixXd matrix_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

/// The identity, as the preconditioner of Mprgp: the diagonal of the scaled W is about 1.
template <SolvableDualProblem Problem>
class IdentityPreconditioner {
 public:
  /// Tells Mprgp to use apply() alone.
  static constexpr bool kMaySweep = false;
  explicit IdentityPreconditioner(Problem& problem) : problem_(&problem) {}

  /// Sets `swept` to the gradient of free contacts, 0 for all others, and `y` to B swept. Returns
  /// the inner product of both.
  double apply(std::span<const double> gradient, std::vector<double>& swept,
               std::vector<double>& y) const {
    double product = 0;
    for (std::size_t c = 0; c < gradient.size(); ++c) {
      swept[c] = problem_->is_free(c) ? gradient[c] : 0.0;
      product += swept[c] * gradient[c];
    }
    problem_->to_bodies(swept, y);
    return product;
  }

 private:
  Problem* problem_;
};

/// Improves problem.z by MPRGP until all residuals are allowed, or until `most` products with W are
/// done. Returns their number.
template <SolvableDualProblem Problem>
int solve_by_gradients(Problem& problem, int most) {
  Mprgp mprgp(problem, IdentityPreconditioner<Problem>(problem));
  bool is_fresh = true;
  for (int products = 1;;) {
    if (!(mprgp.residual() > 1) || products >= most) {
      if (is_fresh) return products;
      mprgp.refresh();  // the updated gradient has accumulated rounding errors
      ++products;
      is_fresh = true;
    } else {
      products += mprgp.step();
      is_fresh = false;
    }
  }
}

}  // namespace viscontact::contact_solver
