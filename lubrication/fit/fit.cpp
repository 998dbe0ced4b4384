// The names of weights, losses and misfits in fit files, the fit object that stands for the exact
// drag of a plane, and the fit for another viscosity. Lengths, masses and times are in the units of
// the table. A change must keep the names, because fit files contain them.
#include "viscontact/lubrication/fit/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"

namespace viscontact::lubrication {
namespace {

template <class Value>
struct Named {
  std::string_view name;
  Value value;
};
template <class Value>
Named(std::string_view, Value) -> Named<Value>;

constexpr std::array kLosses = {Named{"none", Loss::kSquared}, Named{"huber", Loss::kHuber},
                                Named{"cauchy", Loss::kCauchy}};
constexpr std::array kMisfits = {Named{"basis", Misfit::kBasis}, Named{"data", Misfit::kData},
                                 Named{"unknown", Misfit::kUnknown}};

}  // namespace

std::string_view to_string(Weights weights) {
  return weights == Weights::kRelative ? "relative" : "absolute";
}

Weights parse_weights(std::string_view word) {
  if (word == "relative") return Weights::kRelative;
  if (word == "absolute") return Weights::kAbsolute;
  throw Error(ErrorKind::kBadInput,
              fmt::format("the weights are '{}'; they must be relative or absolute", word));
}

std::string_view to_string(Loss loss) {
  return std::ranges::find(kLosses, loss, &Named<Loss>::value)->name;
}

Loss parse_loss(std::string_view word) { return require_named(kLosses, word, "loss").value; }

std::string_view to_string(Misfit misfit) {
  return std::ranges::find(kMisfits, misfit, &Named<Misfit>::value)->name;
}

Misfit parse_misfit(std::string_view word) { return require_named(kMisfits, word, "misfit").value; }

Fit exact_plane_fit(double viscosity, double radius) {
  Fit fit;
  fit.basis = kExactPlane;
  fit.reference_velocity = -1;
  fit.viscosity = viscosity;
  fit.radius = radius;
  // These numbers only have to be valid in a fit file. The gaps at which the drag can be computed
  // are LubricationForce::interval(), which depends on the radius.
  fit.gap_interval = {1e-300, 1e300};
  fit.geometry = "plane, unbounded";
  fit.leading_coefficient = stokes_resistance(viscosity, radius) * radius;
  return fit;
}

bool is_exact_plane(const Fit& fit) { return fit.basis == kExactPlane; }

Fit with_viscosity(Fit fit, double viscosity) {
  const double scale = viscosity / fit.viscosity;
  fit.viscosity = viscosity;
  for (auto& term : fit.terms) {
    term.coefficient *= scale;
    term.standard_error *= scale;
  }
  for (auto& row : fit.covariance)
    for (auto& entry : row) entry *= scale * scale;
  if (fit.leading_coefficient) *fit.leading_coefficient *= scale;
  return fit;
}

}  // namespace viscontact::lubrication
