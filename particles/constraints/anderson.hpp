// Anderson's acceleration of a fixed-point iteration (Anderson 1965; Walker & Ni 2011, "Anderson
// acceleration for fixed-point iterations").
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace viscontact::particles {

/// Accelerates x -> T(x). Where T is affine, it takes as many steps as conjugate residuals would,
/// up to the number of remembered steps.
class AndersonAcceleration {
 public:
  explicit AndersonAcceleration(std::size_t memory) : memory_(memory) {}

  /// Forgets all steps, because T has changed.
  void forget() {
    images_.clear();
    steps_.clear();
    last_image_.clear();
  }
  std::size_t size() const { return images_.size(); }

  /// Replaces `image` = T(x) by a better guess of the fixed point. Norms weigh the square of each
  /// number by `weights` > 0.
  void improve(std::span<const double> x, std::vector<double>& image,
               std::span<const double> weights) {
    std::vector<double> step(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) step[k] = image[k] - x[k];
    if (!last_image_.empty()) {
      if (images_.size() == memory_) {
        images_.erase(images_.begin());
        steps_.erase(steps_.begin());
      }
      images_.push_back(difference(image, last_image_));
      steps_.push_back(difference(step, last_step_));
    }
    last_image_ = image;
    last_step_ = step;
    // If successive steps are nearly equal, the fixed point is far away or does not exist.
    constexpr double kFarthest = 30;
    const double farthest = kFarthest * std::sqrt(dot(step, step, weights));
    // Least squares by Gram-Schmidt on the differences of the steps, the newest ones first.
    auto basis = steps_;
    auto along = images_;
    for (std::size_t i = basis.size(); i-- > 0;) {
      const double before = dot(basis[i], basis[i], weights);
      for (std::size_t j = basis.size(); j-- > i + 1;) {
        if (basis[j].empty()) continue;
        subtract(dot(basis[j], basis[i], weights), basis[j], basis[i], along[j], along[i]);
      }
      const double square = dot(basis[i], basis[i], weights);
      // A difference that depends on newer ones within rounding errors is left out.
      constexpr double kDependent = 1e-20;
      if (!(square > kDependent * before)) {
        basis[i].clear();
        continue;
      }
      const double factor = 1 / std::sqrt(square);
      for (auto& value : basis[i]) value *= factor;
      for (auto& value : along[i]) value *= factor;
      const double share = dot(basis[i], step, weights);
      for (std::size_t k = 0; k < step.size(); ++k) {
        step[k] -= share * basis[i][k];
        image[k] -= share * along[i][k];
      }
    }
    const auto moved = difference(image, last_image_);
    const double length = std::sqrt(dot(moved, moved, weights));
    if (!(length > farthest)) return;
    for (std::size_t k = 0; k < image.size(); ++k)
      image[k] = last_image_[k] + farthest / length * moved[k];
  }

 private:
  using Values = std::vector<double>;
  static Values difference(const Values& a, const Values& b) {
    Values result(a.size());
    for (std::size_t k = 0; k < a.size(); ++k) result[k] = a[k] - b[k];
    return result;
  }
  static double dot(const Values& a, const Values& b, std::span<const double> weights) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += weights[k] * a[k] * b[k];
    return sum;
  }
  static void subtract(double share, const Values& basis, Values& of, const Values& along,
                       Values& of_along) {
    for (std::size_t k = 0; k < of.size(); ++k) {
      of[k] -= share * basis[k];
      of_along[k] -= share * along[k];
    }
  }

  std::size_t memory_;
  std::vector<Values> images_, steps_;  // differences between successive T(x), T(x) - x
  Values last_image_, last_step_;
};

}  // namespace viscontact::particles
