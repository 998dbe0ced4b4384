// Flows that change in time.
#include "viscontact/particles/setting/pair_lubrication.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::particles {
namespace {

constexpr double kRoundedGradient = 1e-12;  // of numbers that users round

/// At all times, without the factor of a wave.
std::vector<Gradient> gradients_of(const PairLubrication& lubrication) {
  if (lubrication.pieces.empty()) return {lubrication.gradient};
  std::vector<Gradient> all;
  for (const auto& piece : lubrication.pieces) all.push_back(piece.gradient);
  return all;
}

/// Whether `gradient` is a multiple, perhaps by 0, of `direction`, which is not 0.
bool are_parallel(const Gradient& direction, const Gradient& gradient) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    product += dot(direction[i], gradient[i]);
    square += dot(direction[i], direction[i]);
  }
  const double multiple = product / square;
  for (std::size_t i = 0; i < 3; ++i)
    if (norm(gradient[i] - multiple * direction[i]) >
        kRoundedGradient * std::abs(multiple) * std::sqrt(square))
      return false;
  return true;
}

}  // namespace

FlowPiece PairLubrication::flow_at(double time) const {
  if (pieces.empty()) return {std::numeric_limits<double>::max(), gradient, stress};
  const auto piece = std::ranges::upper_bound(pieces, time, {}, &FlowPiece::until);
  return piece == pieces.end() ? pieces.back() : *piece;
}

double PairLubrication::factor(double from, double to) const {
  if (!wave) return 1;
  return to > from ? wave->mean_over(from, to) : wave->value(from);
}

bool strains_cell(const PairLubrication& lubrication, const Domain& domain) {
  for (const double period : periods_of(domain))
    if (!(period > 0)) return false;
  const auto is_other = [](Gradient gradient) {
    gradient[0][1] = 0;
    return gradient != Gradient{};
  };
  return is_other(lubrication.gradient) ||
         std::ranges::any_of(lubrication.pieces, is_other, &FlowPiece::gradient);
}

bool accelerates_images_alike(const PairLubrication& lubrication, const Domain& domain) {
  const auto periods = periods_of(domain);
  const auto all = gradients_of(lubrication);
  const bool changes =
      lubrication.wave || std::ranges::any_of(all, [&](const Gradient& g) { return g != all[0]; });
  for (const auto& g : all)
    for (std::size_t j = 0; j < 3; ++j) {
      const Vector column{g[0][j], g[1][j], g[2][j]};
      if (!(periods[j] > 0) || column == Vector{}) continue;
      const Vector square{dot(g[0], column), dot(g[1], column), dot(g[2], column)};
      const double largest = norm(g[0]) + norm(g[1]) + norm(g[2]);
      if (changes || norm(square) > kRoundedGradient * largest * norm(column)) return false;
    }
  return true;
}

double rate_of_strain(const Gradient& gradient) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double strain = (gradient[i][j] + gradient[j][i]) / 2;
      sum += 2 * strain * strain;
    }
  return std::sqrt(sum);
}

double signed_rate_of_strain(const Gradient& gradient) {
  const double rate = rate_of_strain(gradient);
  for (const auto& row : gradient)
    for (const double entry : row)
      if (entry != 0) return entry < 0 ? -rate : rate;
  return rate;
}

FlowPath path_of(const PairLubrication& lubrication) {
  assert(!lubrication.stress);
  FlowPath path;
  const auto all = gradients_of(lubrication);
  const auto first = std::ranges::find_if(all, [](const Gradient& g) { return g != Gradient{}; });
  if (first == all.end() || rate_of_strain(*first) == 0) return path;
  for (const auto& gradient : all)
    if (!are_parallel(*first, gradient)) return path;
  double lowest = 0, highest = 0;
  const double rate = signed_rate_of_strain(lubrication.gradient);
  if (lubrication.wave) {
    const auto [least, largest] = lubrication.wave->integrals();
    lowest = rate * (rate < 0 ? largest : least);
    highest = rate * (rate < 0 ? least : largest);
  } else if (lubrication.pieces.empty()) {
    (rate < 0 ? lowest : highest) = std::copysign(std::numeric_limits<double>::infinity(), rate);
  }
  double begin = 0, strain = 0;
  for (const auto& piece : lubrication.pieces) {
    strain += signed_rate_of_strain(piece.gradient) * (piece.until - begin);
    begin = piece.until;
    lowest = std::min(lowest, strain);
    highest = std::max(highest, strain);
  }
  path.sign = -lowest > highest ? -1 : 1;
  path.lowest = path.sign < 0 ? -highest : lowest;
  path.direction = *first;
  for (auto& row : path.direction) row = (path.sign / signed_rate_of_strain(*first)) * row;
  return path;
}

double largest_rate_of_strain(const PairLubrication& lubrication) {
  if (lubrication.stress) return 0;
  double largest = rate_of_strain(lubrication.gradient);
  if (lubrication.wave) largest *= lubrication.wave->largest();
  for (const auto& piece : lubrication.pieces)
    largest = std::max(largest, rate_of_strain(piece.gradient));
  return largest;
}

double time_of_strain(const PairLubrication& lubrication, double strain) {
  assert(!lubrication.stress && strain >= 0);
  const auto time_at = [](double rest, double rate) {
    return rest == 0 ? 0 : rate > 0 ? rest / rate : std::numeric_limits<double>::infinity();
  };
  const double rate = rate_of_strain(lubrication.gradient);
  if (lubrication.wave && rate > 0 && lubrication.wave->largest() > 0)
    return lubrication.wave->time_of_path(strain / rate);
  double begin = 0, rest = strain;
  for (std::size_t k = 0; k + 1 < lubrication.pieces.size(); ++k) {
    const auto& piece = lubrication.pieces[k];
    const double of_piece = rate_of_strain(piece.gradient) * (piece.until - begin);
    if (of_piece >= rest) return begin + time_at(rest, rate_of_strain(piece.gradient));
    rest -= of_piece;
    begin = piece.until;
  }
  return begin + time_at(rest, lubrication.pieces.empty()
                                   ? rate
                                   : rate_of_strain(lubrication.pieces.back().gradient));
}

}  // namespace viscontact::particles
