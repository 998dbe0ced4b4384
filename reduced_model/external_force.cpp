#include "reduced_model/external_force.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/error.hpp"

namespace viscontact {

ExternalForce::ExternalForce(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  if (pieces_.empty())
    throw Error(ExitCode::kBadInput, "external_force has no piece; needs at least one");
  double from = 0;
  for (const auto& piece : pieces_) {
    if (!(piece.until > from))
      throw Error(
          ExitCode::kBadInput,
          fmt::format("external_force: until = {} must be greater than {}, where the piece begins",
                      piece.until, from));
    from = piece.until;
  }
}

double ExternalForce::value(double time) const {
  const auto piece = std::ranges::upper_bound(pieces_, time, {}, &Piece::until);
  return piece == pieces_.end() ? pieces_.back().value : piece->value;
}

double ExternalForce::impulse(double time) const {
  double total = 0;
  double from = 0;
  for (const auto& piece : pieces_) {
    if (time <= piece.until) return total + piece.value * (time - from);
    total += piece.value * (piece.until - from);
    from = piece.until;
  }
  return total + pieces_.back().value * (time - from);
}

std::vector<double> ExternalForce::jumps() const {
  std::vector<double> times;
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
    if (pieces_[i].value != pieces_[i + 1].value) times.push_back(pieces_[i].until);
  return times;
}

}  // namespace viscontact
