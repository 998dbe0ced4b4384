// Terms near contact of the resistance to squeezing, and the variables of squeeze_rest.hpp.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

namespace viscontact::lubrication {

/// Of two spheres, with the smaller radius over the larger one as ratio, or of a sphere in a round
/// wall, with minus the sphere's radius over the wall's. With eps = gap/r_eff and w the ratio,
///
///     R/(6 pi mu r_eff) = 1/eps - c ln eps - d eps ln eps + O(1),
///     c = (1 + 7 w + w^2)/(5 (1 + w)^2),
///     d = (5 + 90 w - 145 w^2 + 90 w^3 + 5 w^4)/(105 (1 + w)^4)       (Jeffrey & Onishi 1984).
///
/// The `width` of a film is eps, in a round wall eps/(1 + w)^2, which is at most 1/|w|; the
/// resistances in a round wall are (1 + w)^2 R.
class SqueezeTerms {
 public:
  explicit SqueezeTerms(double ratio) : ratio_(ratio) {
    assert(ratio > -1 && ratio <= 1 && ratio != 0);
    const double w = ratio, square = (1 + w) * (1 + w);
    log_ = (1 + 7 * w + w * w) / 5;
    width_log_ = (5 + w * (90 + w * (-145 + w * (90 + w * 5)))) / 105;
    if (w > 0) {
      log_ /= square;
      width_log_ /= square * square;
    }
  }

  /// In a pair, the largest one of the table.
  double largest_width() const { return ratio_ < 0 ? -1 / ratio_ : 300; }

  /// The variable in which the rest is smooth: like the square root of the width near contact,
  /// because the rest has terms like width^2 ln(width) there, and of two spheres like the logarithm
  /// of the width far away.
  double coordinate(double width) const {
    return ratio_ < 0 ? std::sqrt(width / (2 + width)) : std::asinh(std::sqrt(width));
  }
  double width_at(double coordinate) const {
    if (ratio_ < 0) return 2 * coordinate * coordinate / (1 - coordinate * coordinate);
    const double root = std::sinh(coordinate);
    return root * root;
  }

  /// The terms ln and eps ln at a width, bounded far away, and their mean between contact and there.
  double terms(double width) const {
    const double y = width / (1 + width);
    return -(log_ + width_log_ * y) * std::log(y);
  }
  double mean_of_terms(double width) const {
    const double y = width / (1 + width);
    return -(log_ + width_log_ / 2 * y) * std::log(y);
  }

  /// The distance of the centres of two spheres that touch, over r_eff.
  double touching_distance() const { return (1 + ratio_) * (1 + ratio_) / ratio_; }

 private:
  double ratio_, log_ = 0, width_log_ = 0;
};

}  // namespace viscontact::lubrication
