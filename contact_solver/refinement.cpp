// Newton's matrix is E_p + E_v W: derivatives by impulses p and by values v = b + W p.
#include "viscontact/contact_solver/refinement.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace viscontact::contact_solver {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct RefinementTuning {
  // Most entries of W in parts, which bounds time and memory where a unit has many rows.
  static constexpr std::size_t kMostProducts = 1'000'000;
  // Rows up to which the matrix is dense.
  static constexpr Eigen::Index kDense = 64;
  // Where the matrix is singular but for rounding errors, the solution is not the one that made the
  // right side. This difference is far above the errors that masses of the ratio 1e12 cause.
  static constexpr double kUnique = 1e-3;
  // Steps end when one of them is not below kGain times the one before. Then the error must be
  // below kSmall times the largest impulse. Each change of a branch takes a step of its own.
  static constexpr int kMostSteps = 20;
  static constexpr double kGain = 0.1, kSmall = 1e-10;
};

}  // namespace

/// A part of an entry of W, by one unit.
template <int D>
struct Refinement<D>::Product {
  std::size_t row = 0, other = 0;
  double value = 0;
};

/// The conditions of a block in its branch: `left` = 0, with the derivatives by its impulses and
/// values.
template <int D>
struct Refinement<D>::Law {
  using Matrix = std::array<std::array<double, kMostRows>, kMostRows>;
  enum class Branch : unsigned char { kLink, kOpen, kClosed, kSticks, kSlides, kNone };
  Branch branch = Branch::kNone;
  std::array<Real, kMostRows> left{};
  Matrix by_impulse{}, by_value{};
  std::array<bool, kMostRows> is_value{};  // the unit of `left` is that of values
  bool is_linear = true;

  void set_impulse(std::size_t k, Real impulse) {
    left[k] = impulse;
    by_impulse[k][k] = 1;
  }
  void set_value(std::size_t k, Real value) {
    left[k] = value;
    by_value[k][k] = 1;
    is_value[k] = true;
  }
};

/// Factors of the scaled matrix, dense if it is small.
template <int D>
class Refinement<D>::Factor {
 public:
  using Entries = std::vector<Eigen::Triplet<double>>;
  /// Returns false if the matrix is singular.
  bool compute(Eigen::Index size, const Entries& entries) {
    is_dense_ = size <= RefinementTuning::kDense;
    Eigen::VectorXd probe(size);
    for (Eigen::Index r = 0; r < size; ++r) probe[r] = (r * 7 / 3) % 2 == 0 ? 1 : -1;
    Eigen::VectorXd right;
    if (is_dense_) {
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
      for (const auto& entry : entries) matrix(entry.row(), entry.col()) += entry.value();
      right = matrix * probe;
      dense_.compute(matrix);
    } else {
      Eigen::SparseMatrix<double> matrix(size, size);
      matrix.setFromTriplets(entries.begin(), entries.end());
      right = matrix * probe;
      sparse_.compute(matrix);
      if (sparse_.info() != Eigen::Success) return false;
    }
    return (solve(right) - probe).cwiseAbs().maxCoeff() <= RefinementTuning::kUnique;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const {
    if (is_dense_) return dense_.solve(right);
    return sparse_.solve(right);
  }

 private:
  bool is_dense_ = true;
  Eigen::PartialPivLU<Eigen::MatrixXd> dense_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> sparse_;
};

template <int D>
Refinement<D>::~Refinement() = default;

template <int D>
Refinement<D>::Refinement(ConstraintProblem<D>& problem, ConstraintSolution<D>& solution)
    : problem_(problem) {
  if (problem.rows.empty() || !is_worth_it()) return;
  w_ = row_mobilities(problem);
  for (auto& w : w_) {
    if (!std::isfinite(w)) return;
    // A row whose units cannot move keeps its impulse.
    if (!(w > 0)) w = 0;
    roots_.push_back(w > 0 ? std::sqrt(w) : 1);
  }
  find_products();
  impulses_.assign(problem.impulses.begin(), problem.impulses.end());
  is_done_ = iterate() && take_over(solution);
}

template <int D>
bool Refinement<D>::is_worth_it() const {
  // Rows of geometric stiffness join no units that their links do not join.
  std::size_t rows = 0;
  for (const auto& block : problem_.blocks) rows += block.is_geometric ? 0 : block.rows;
  if (rows <= kFew) return true;
  std::vector<std::size_t> rows_of(problem_.units.size());
  std::vector<double> mobility(problem_.units.size());
  std::size_t joints = 0, products = 0;
  for (const auto& block : problem_.blocks) {
    const std::size_t joined = problem_.rows[block.row].parts;
    if (!block.is_geometric && joined > 0) joints += joined - 1;
    for (std::size_t r = block.row; r < block.row + block.rows; ++r)
      for (const auto& part : problem_.parts_of(r)) {
        const auto u = static_cast<std::size_t>(part.unit);
        const auto moved = problem_.units[u].moved_by(part.coefficients);
        double share = 0;
        for (std::size_t k = 0; k < moved.size(); ++k) share += part.coefficients[k] * moved[k];
        mobility[u] = std::max(mobility[u], share);
        ++rows_of[u];
      }
  }
  for (const auto n : rows_of) products += n * n;
  const bool is_tree = joints < problem_.units.size();
  const auto [least, largest] = std::ranges::minmax_element(mobility);
  const bool are_different = *largest > kDifferent * *least;
  if (products > RefinementTuning::kMostProducts) return false;
  if (are_different) return is_tree || rows <= kMost;
  return is_tree && rows <= kMany;
}

template <int D>
void Refinement<D>::find_products() {
  struct Share {
    std::size_t row;
    const Motion<D>* coefficients;
    Motion<D> moved;
  };
  std::vector<std::vector<Share>> shares(problem_.units.size());
  for (std::size_t r = 0; r < problem_.rows.size(); ++r)
    for (const auto& part : problem_.parts_of(r)) {
      const auto u = static_cast<std::size_t>(part.unit);
      shares[u].push_back({r, &part.coefficients, problem_.units[u].moved_by(part.coefficients)});
    }
  for (const auto& of_unit : shares)
    for (const auto& row : of_unit)
      for (const auto& other : of_unit) {
        double sum = 0;
        for (std::size_t k = 0; k < other.moved.size(); ++k)
          sum += (*row.coefficients)[k] * other.moved[k];
        if (sum != 0) products_.push_back({row.row, other.row, sum});
      }
}

template <int D>
void Refinement<D>::move(const std::vector<Real>& impulses) {
  constexpr auto d = static_cast<std::size_t>(D), turns = static_cast<std::size_t>(kTurns<D>);
  std::vector<RealMotion> sums(problem_.units.size(), RealMotion{});
  for (std::size_t r = 0; r < impulses.size(); ++r)
    for (const auto& [unit, coefficients] : problem_.parts_of(r))
      for (std::size_t k = 0; k < coefficients.size(); ++k)
        sums[static_cast<std::size_t>(unit)][k] += coefficients[k] * impulses[r];
  for (std::size_t u = 0; u < sums.size(); ++u) {
    const auto& unit = problem_.units[u];
    for (std::size_t k = 0; k < d; ++k) motions_[u][k] += unit.mobility * sums[u][k];
    for (std::size_t i = 0; i < turns; ++i)
      for (std::size_t k = 0; k < turns; ++k)
        motions_[u][d + i] += unit.turn_mobility[i * turns + k] * sums[u][d + k];
  }
}

template <int D>
void Refinement<D>::find_values() {
  values_.resize(problem_.rows.size());
  for (std::size_t r = 0; r < values_.size(); ++r) {
    values_[r] = problem_.rows[r].offset;
    for (const auto& [unit, coefficients] : problem_.parts_of(r))
      for (std::size_t k = 0; k < coefficients.size(); ++k)
        values_[r] += coefficients[k] * motions_[static_cast<std::size_t>(unit)][k];
  }
}

template <int D>
void Refinement<D>::evaluate() {
  motions_.assign(problem_.units.size(), RealMotion{});
  for (std::size_t u = 0; u < motions_.size(); ++u)
    std::ranges::copy(problem_.units[u].free, motions_[u].begin());
  move(impulses_);
  find_values();
}

template <int D>
void Refinement<D>::move_by_rest() {
  std::vector<double> right(impulses_.size());
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    const auto& law = laws_[b];
    const std::size_t n = problem_.blocks[b].row, rows = problem_.blocks[b].rows;
    for (std::size_t k = 0; k < rows; ++k) {
      Real left = 0;
      for (std::size_t l = 0; l < rows && law.is_value[k]; ++l)
        left += law.by_value[k][l] * values_[n + l] + law.by_impulse[k][l] * impulses_[n + l];
      right[n + k] = static_cast<double>(-left);
    }
  }
  const auto rest = solved(std::move(right));
  move({rest.begin(), rest.end()});
  find_values();
}

template <int D>
bool Refinement<D>::find_laws() {
  using Branch = typename Law::Branch;
  bool is_same = laws_.size() == problem_.blocks.size();
  laws_.resize(problem_.blocks.size());
  Real largest = 0;
  for (std::size_t r = 0; r < impulses_.size(); ++r)
    largest = std::max(largest, std::abs(roots_[r] * impulses_[r]));
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    const auto& block = problem_.blocks[b];
    const std::size_t n = block.row;
    Law law;
    // The size of rounding errors of scaled impulses decides about contacts without load.
    const Real slack = kEpsilon * largest / roots_[n];
    Real square = 0;
    std::array<Real, kMostRows> wanted{};  // impulses minus values over mobilities
    for (std::size_t k = 0; k < block.rows; ++k) {
      wanted[k] = impulses_[n + k] - (w_[n + k] > 0 ? values_[n + k] / w_[n + k] : Real{0});
      if (k > 0) square += wanted[k] * wanted[k];
    }
    const Real beside = std::sqrt(square);
    // The friction has the size mu of_load along wanted[1], wanted[2]; `slope` is its derivative by
    // the normal impulse.
    const auto slide = [&](Real size, double slope) {
      law.is_linear = block.rows == 2;
      for (std::size_t k = 1; k < block.rows; ++k) {
        const Real along = wanted[k] / beside;
        law.left[k] = impulses_[n + k] - size * along;
        law.by_impulse[k][k] = 1;
        law.by_impulse[k][0] = static_cast<double>(-slope * along);
        for (std::size_t l = 1; block.rows == 3 && l < 3; ++l) {
          const auto turns =
              static_cast<double>(size / beside * ((k == l ? 1 : 0) - along * wanted[l] / beside));
          law.by_impulse[k][l] -= turns;
          law.by_value[k][l] += turns / w_[n + l];
        }
      }
    };
    if (std::ranges::any_of(std::span(w_).subspan(n, block.rows),
                            [](double w) { return w == 0; })) {
      for (std::size_t k = 0; k < block.rows; ++k) law.set_impulse(k, 0);
    } else if (!block.is_contact) {
      law.branch = Branch::kLink;
      for (std::size_t k = 0; k < block.rows; ++k) {
        law.set_value(k, values_[n + k] + block.compliance * impulses_[n + k]);
        law.by_impulse[k][k] = block.compliance;
      }
    } else if (block.is_in_cone()) {
      const auto cone =
          FrictionCone::nearest(block.friction, static_cast<double>(wanted[0] + slack),
                                static_cast<double>(beside), w_[n], w_[n + 1]);
      switch (cone.part) {
        case FrictionCone::Part::kApex:
          law.branch = Branch::kOpen;
          for (std::size_t k = 0; k < block.rows; ++k) law.set_impulse(k, impulses_[n + k]);
          break;
        case FrictionCone::Part::kInside:
          law.branch = Branch::kSticks;
          for (std::size_t k = 0; k < block.rows; ++k) law.set_value(k, values_[n + k]);
          break;
        case FrictionCone::Part::kSurface:
          law.branch = Branch::kSlides;
          law.set_value(0, values_[n]);
          for (std::size_t k = 1; k < block.rows; ++k) {
            const Real along = wanted[k] / beside;
            law.left[0] += block.friction * along * values_[n + k];
            law.by_value[0][k] = static_cast<double>(block.friction * along);
          }
          slide(block.friction * impulses_[n], block.friction);
      }
    } else {
      const bool is_closed = wanted[0] + slack > block.lowest;
      law.branch = is_closed ? Branch::kClosed : Branch::kOpen;
      if (is_closed)
        law.set_value(0, values_[n]);
      else
        law.set_impulse(0, impulses_[n] - block.lowest);
      if (block.rows > 1) {
        const bool is_given = block.friction_bound == FrictionBound::kGiven;
        const Real load = is_given
                              ? Real{block.given_load}
                              : (is_closed ? impulses_[n] : Real{block.lowest}) - block.capacity;
        const Real bound = block.friction * load;
        if (!(bound > slack)) {
          for (std::size_t k = 1; k < block.rows; ++k) law.set_impulse(k, impulses_[n + k]);
        } else if (beside <= bound + slack) {
          law.branch = is_closed ? Branch::kSticks : Branch::kNone;
          for (std::size_t k = 1; k < block.rows; ++k) law.set_value(k, values_[n + k]);
        } else {
          law.branch = Branch::kSlides;
          slide(bound, is_given ? 0 : block.friction);
        }
      }
    }
    // The direction of sliding is a part of the branch.
    is_same = is_same && law.is_linear && laws_[b].branch == law.branch &&
              laws_[b].by_impulse == law.by_impulse && laws_[b].is_value == law.is_value;
    laws_[b] = law;
  }
  return is_same;
}

template <int D>
bool Refinement<D>::factorise() {
  std::size_t equations = 0;
  std::vector<const Law*> law_of(problem_.rows.size());
  std::vector<std::size_t> first(problem_.rows.size());
  std::vector<double> scale(problem_.rows.size());
  for (std::size_t b = 0; b < laws_.size(); ++b)
    for (std::size_t k = 0; k < problem_.blocks[b].rows; ++k) {
      const std::size_t r = problem_.blocks[b].row + k;
      law_of[r] = &laws_[b];
      first[r] = problem_.blocks[b].row;
      scale[r] = laws_[b].is_value[k] ? 1 / roots_[r] : roots_[r];
      if (laws_[b].is_value[k] && problem_.blocks[b].compliance == 0) ++equations;
    }
  // More equations than motions cannot determine their impulses.
  if (equations > problem_.units.size() * std::tuple_size_v<Motion<D>>) return false;
  typename Factor::Entries entries;
  entries.reserve(products_.size());
  const auto add = [&](std::size_t row, std::size_t other, double value) {
    entries.emplace_back(static_cast<int>(row), static_cast<int>(other),
                         scale[row] * value / roots_[other]);
  };
  for (const auto& product : products_) {
    const auto& law = *law_of[product.row];
    const std::size_t l = product.row - first[product.row];
    for (std::size_t k = 0; k < kMostRows; ++k)
      if (law.by_value[k][l] != 0)
        add(first[product.row] + k, product.other, law.by_value[k][l] * product.value);
  }
  for (std::size_t r = 0; r < law_of.size(); ++r)
    for (std::size_t l = 0; l < kMostRows; ++l)
      if (const double value = law_of[r]->by_impulse[r - first[r]][l]; value != 0)
        add(r, first[r] + l, value);
  factor_ = std::make_unique<Factor>();
  return factor_->compute(std::ssize(law_of), entries);
}

template <int D>
std::vector<double> Refinement<D>::solved(std::vector<double> right) const {
  for (std::size_t b = 0; b < laws_.size(); ++b)
    for (std::size_t k = 0; k < problem_.blocks[b].rows; ++k) {
      const std::size_t r = problem_.blocks[b].row + k;
      right[r] *= laws_[b].is_value[k] ? 1 / roots_[r] : roots_[r];
    }
  const auto size = std::ssize(right);
  const Eigen::VectorXd changes =
      factor_->solve(Eigen::Map<const Eigen::VectorXd>(right.data(), size));
  for (std::size_t r = 0; r < right.size(); ++r)
    right[r] = changes[static_cast<Eigen::Index>(r)] / roots_[r];
  return right;
}

template <int D>
bool Refinement<D>::iterate() {
  using Tuning = RefinementTuning;
  double before = std::numeric_limits<double>::infinity();
  last_.assign(impulses_.size(), 0.0);
  for (int n = 0; n < Tuning::kMostSteps; ++n) {
    evaluate();
    const bool is_same = find_laws();
    if (!is_same && !factorise()) return false;
    std::vector<double> right(impulses_.size());
    for (std::size_t b = 0; b < laws_.size(); ++b)
      for (std::size_t k = 0; k < problem_.blocks[b].rows; ++k)
        right[problem_.blocks[b].row + k] = static_cast<double>(laws_[b].left[k]);
    const auto change = solved(std::move(right));
    bool is_exact = true;
    double largest = 0, largest_change = 0;
    for (std::size_t r = 0; r < change.size(); ++r) {
      impulses_[r] -= change[r];
      last_[r] = std::abs(change[r]);
      const auto size = static_cast<double>(std::abs(impulses_[r]));
      is_exact = is_exact && last_[r] <= kEpsilon / 4 * size;
      largest = std::max(largest, roots_[r] * size);
      largest_change = std::max(largest_change, roots_[r] * last_[r]);
    }
    if (!std::isfinite(largest)) return false;
    if (is_exact) return true;
    const bool is_linear = std::ranges::all_of(laws_, &Law::is_linear);
    if ((is_same || (n > 0 && !is_linear)) && !(largest_change < Tuning::kGain * before))
      return largest_change <= Tuning::kSmall * largest;
    before = largest_change;
  }
  return false;
}

template <int D>
bool Refinement<D>::take_over(ConstraintSolution<D>& solution) {
  evaluate();
  std::vector<double> impulses(impulses_.size());
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    const auto& block = problem_.blocks[b];
    for (std::size_t k = 0; k < block.rows; ++k) {
      const std::size_t r = block.row + k;
      auto& impulse = impulses_[r];
      const Real refined = impulse;
      if (block.is_contact && k == 0) impulse = std::max(impulse, Real{block.lowest});
      if (laws_[b].by_value[k] == std::array<double, kMostRows>{} &&
          laws_[b].branch == Law::Branch::kOpen)
        impulse = k == 0 ? Real{block.lowest} : Real{0};
      last_[r] += static_cast<double>(std::abs(impulse - refined));
      impulses[r] = static_cast<double>(impulse);
    }
  }
  evaluate();
  move_by_rest();
  double before = 0;
  for (std::size_t b = 0; b < laws_.size(); ++b)
    before = std::max(before, solution.residuals[b].share(problem_.blocks[b]));
  ConstraintSolution<D> refined{solution.result, {}, {}};
  refined.result.residual = 0;
  for (std::size_t b = 0; b < laws_.size(); ++b) {
    const auto& block = problem_.blocks[b];
    std::array<double, kMostRows> v{};
    for (std::size_t k = 0; k < block.rows; ++k) v[k] = static_cast<double>(values_[block.row + k]);
    refined.residuals.push_back(
        residual_of(block, v.data(), &impulses[block.row], &w_[block.row], 0));
    const double share = refined.residuals.back().share(block);
    if (!(share <= std::max(1.0, before))) return false;
    refined.result.residual = std::max(refined.result.residual, share);
  }
  for (const auto& motion : motions_) {
    auto& rounded = refined.motions.emplace_back();
    for (std::size_t k = 0; k < rounded.size(); ++k) rounded[k] = static_cast<double>(motion[k]);
  }
  // The errors of the data: free motions are sums that were rounded twice, and impulses are
  // rounded.
  std::vector<double> right(impulses.size());
  for (std::size_t b = 0; b < laws_.size(); ++b)
    for (std::size_t k = 0; k < problem_.blocks[b].rows; ++k) {
      if (!laws_[b].is_value[k]) continue;
      const std::size_t r = problem_.blocks[b].row + k;
      double size = std::abs(problem_.rows[r].offset);
      for (const auto& [unit, coefficients] : problem_.parts_of(r)) {
        const auto u = static_cast<std::size_t>(unit);
        for (std::size_t m = 0; m < coefficients.size(); ++m)
          size += 2 * std::abs(coefficients[m]) *
                  (std::abs(problem_.units[u].free[m]) + std::abs(refined.motions[u][m]));
      }
      right[r] = kEpsilon * size;
    }
  errors_ = solved(std::move(right));
  for (std::size_t r = 0; r < errors_.size(); ++r)
    errors_[r] = std::abs(errors_[r]) + last_[r] + kEpsilon * std::abs(impulses[r]);
  problem_.impulses = std::move(impulses);
  solution = std::move(refined);
  return true;
}

template <int D>
std::vector<double> Refinement<D>::largest_of_blocks(const std::vector<double>& of_rows) const {
  std::vector<double> largest;
  for (const auto& block : problem_.blocks) {
    double square = 0;
    for (std::size_t r = block.row; r < block.row + block.rows; ++r)
      square = std::max(square, std::abs(of_rows[r]));
    largest.push_back(square);
  }
  return largest;
}

template <int D>
double Refinement<D>::error(std::size_t b) const {
  assert(is_done());
  assert(b < problem_.blocks.size());
  const auto& block = problem_.blocks[b];
  return *std::max_element(&errors_[block.row], &errors_[block.row] + block.rows);
}

template <int D>
std::vector<double> Refinement<D>::changes_by(const std::vector<double>& shifts) const {
  assert(is_done() && shifts.size() <= laws_.size());
  std::vector<double> right(problem_.rows.size());
  for (std::size_t b = 0; b < shifts.size(); ++b)
    for (std::size_t k = 0; k < (problem_.blocks[b].is_contact ? 1 : problem_.blocks[b].rows); ++k)
      if (laws_[b].is_value[k]) right[problem_.blocks[b].row + k] = shifts[b];
  return largest_of_blocks(solved(std::move(right)));
}

template class Refinement<2>;
template class Refinement<3>;

}  // namespace viscontact::contact_solver
