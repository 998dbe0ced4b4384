// Piecewise polynomials (polynomial.hpp) and sinusoids, and the times at which their sum changes
// its sign.
#include "viscontact/reduced_model/external_force/external_force.hpp"

#include <array>
#include <cassert>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/reduced_model/external_force/polynomial.hpp"

namespace viscontact::reduced_model {
namespace {

/// Free choices of the search for changes of sign.
struct SignChangeTuning {
  // In a period of the fastest sinusoid. Two changes between two neighbouring samples are missed;
  // more samples take longer.
  static constexpr int kSamplesPerPeriod = 32;
  // Each sample takes about 50 ns.
  static constexpr double kMostSamples = 1e6;
};

double sine(const ExternalForce::Sinusoid& s, double time) {
  return s.amplitude * std::sin(s.angular_frequency * time + s.phase);
}

/// sin(x)/x. For |x| < 1e-4 the first term of the series that is left out, x^4/120, is smaller than
/// the rounding error of 1.
double sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

/// x - sin(x) without cancellation of digits for small x, by the series if |x| <= 1.
double argument_minus_sine(double x) {
  if (std::abs(x) > 1) return x - std::sin(x);
  double term = x, sum = 0;
  for (int k = 1; k < 10; ++k) {  // the first term that is left out is below 1/21! < 1e-19
    term *= -x * x / ((2 * k) * (2 * k + 1));
    sum -= term;
  }
  return sum;
}

/// The mean of a sinusoid over the times from a to b >= a.
double sine_mean(const ExternalForce::Sinusoid& s, double a, double b) {
  return sine(s, a + (b - a) / 2) * sinc(s.angular_frequency * (b - a) / 2);
}

}  // namespace

ExternalForce::ExternalForce(const std::vector<Piece>& pieces) {
  if (pieces.empty())
    throw Error(ErrorKind::kBadInput, "external_force has no piece; it needs at least one");
  double from = 0;
  for (const auto& piece : pieces) {
    if (!(piece.until > from))
      throw Error(ErrorKind::kBadInput,
                  "until is {}; it must be greater than {}, where the piece begins", piece.until,
                  from);
    Polynomial polynomial{from, {piece.value}};
    polynomial.coefficients.insert(polynomial.coefficients.end(), piece.higher.begin(),
                                   piece.higher.end());
    pieces_.push_back(std::move(polynomial));
    from = piece.until;
  }
  sum_up();
}

ExternalForce ExternalForce::sinusoidal(const Sinusoid& sinusoid) {
  if (!(sinusoid.angular_frequency > 0))
    throw Error(ErrorKind::kBadInput, "angular_frequency is {}; it must be > 0",
                sinusoid.angular_frequency);
  ExternalForce force({{1, 0}});
  force.sinusoids_.push_back(sinusoid);
  return force;
}

ExternalForce& ExternalForce::operator+=(const ExternalForce& other) {
  // The pieces of the sum begin wherever a piece of one of the two forces begins.
  std::vector<double> starts;
  for (const auto* pieces : {&std::as_const(pieces_), &other.pieces_})
    for (const auto& piece : *pieces) starts.push_back(piece.from);
  std::ranges::sort(starts);
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  std::vector<Polynomial> sum;
  for (const double from : starts) {
    const auto& a = piece_at(from);
    const auto& b = other.piece_at(from);
    auto coefficients = polynomial::shifted(a.coefficients, from - a.from);
    const auto more = polynomial::shifted(b.coefficients, from - b.from);
    coefficients.resize(std::max(coefficients.size(), more.size()));
    for (std::size_t k = 0; k < more.size(); ++k) coefficients[k] += more[k];
    sum.push_back({from, std::move(coefficients)});
  }
  pieces_ = std::move(sum);
  sinusoids_.insert(sinusoids_.end(), other.sinusoids_.begin(), other.sinusoids_.end());
  sum_up();
  return *this;
}

ExternalForce ExternalForce::stretched(double factor) const {
  assert(factor > 0);
  ExternalForce force = *this;
  for (auto& piece : force.pieces_) {
    piece.from *= factor;
    double power = 1;
    for (auto& coefficient : piece.coefficients) {
      coefficient /= power;
      power *= factor;
    }
  }
  for (auto& s : force.sinusoids_) s.angular_frequency /= factor;
  force.sum_up();
  return force;
}

void ExternalForce::sum_up() {
  // A piece as short as the rounding error of its time is left out. The piece before it then lasts
  // until the next piece begins.
  for (std::size_t i = 1; i + 1 < pieces_.size();)
    if (are_one_time(pieces_[i].from, pieces_[i + 1].from))
      pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const auto& before = pieces_[i - 1];
    const double length = pieces_[i].from - before.from;
    pieces_[i].impulse = before.impulse + polynomial::integral(before.coefficients, length);
    pieces_[i].impulse_integral = before.impulse_integral + before.impulse * length +
                                  polynomial::double_integral(before.coefficients, length);
  }
}

const ExternalForce::Polynomial& ExternalForce::piece_at(double time) const {
  const auto next = std::ranges::upper_bound(pieces_, time, {}, &Polynomial::from);
  return next == pieces_.begin() ? pieces_.front() : *std::prev(next);
}

double ExternalForce::value(double time) const {
  const auto& piece = piece_at(time);
  double value = polynomial::value(piece.coefficients, time - piece.from);
  for (const auto& s : sinusoids_) value += sine(s, time);
  return value;
}

double ExternalForce::slope(double time) const {
  const auto& piece = piece_at(time);
  double slope = polynomial::slope(piece.coefficients, time - piece.from);
  for (const auto& s : sinusoids_)
    slope += s.amplitude * s.angular_frequency * std::cos(s.angular_frequency * time + s.phase);
  return slope;
}

double ExternalForce::impulse(double time) const {
  const auto& piece = piece_at(time);
  double impulse = piece.impulse + polynomial::integral(piece.coefficients, time - piece.from);
  for (const auto& s : sinusoids_) impulse += time * sine_mean(s, 0, time);
  return impulse;
}

double ExternalForce::impulse_integral(double time) const {
  const auto& piece = piece_at(time);
  const double tau = time - piece.from;
  double total = piece.impulse_integral + piece.impulse * tau +
                 polynomial::double_integral(piece.coefficients, tau);
  for (const auto& s : sinusoids_) {
    const double x = s.angular_frequency * time;
    const double half = std::sin(x / 2);
    total += s.amplitude / (s.angular_frequency * s.angular_frequency) *
             (std::cos(s.phase) * argument_minus_sine(x) + std::sin(s.phase) * 2 * half * half);
  }
  return total;
}

double ExternalForce::mean(double from, double to) const {
  assert(!(from > to));
  const auto* piece = &piece_at(from);
  const auto* last = &pieces_.back();
  double mean = 0;
  if (piece == last || to <= piece[1].from) {
    mean = polynomial::mean(piece->coefficients, from - piece->from, to - piece->from);
  } else {
    for (double begin = from; begin < to; ++piece) {
      const double end = piece == last ? to : std::min(to, piece[1].from);
      mean += (end - begin) / (to - from) *
              polynomial::mean(piece->coefficients, begin - piece->from, end - piece->from);
      begin = end;
    }
  }
  for (const auto& s : sinusoids_) mean += sine_mean(s, from, to);
  return mean;
}

std::vector<double> ExternalForce::jumps() const {
  std::vector<double> times;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const auto& before = pieces_[i - 1].coefficients;
    const auto& after = pieces_[i].coefficients;
    const double length = pieces_[i].from - pieces_[i - 1].from;
    if (polynomial::value(before, length) != after[0] ||
        polynomial::slope(before, length) != polynomial::slope(after, 0))
      times.push_back(pieces_[i].from);
  }
  return times;
}

std::vector<double> ExternalForce::sign_changes(double end) const {
  std::vector<double> changes;
  double fastest = 0;
  for (const auto& s : sinusoids_) fastest = std::max(fastest, s.angular_frequency);
  double last_sign = 0;
  const auto add_extremum_of = [&](double time, double value) {
    const double sign = value > 0 ? 1 : value < 0 ? -1 : 0;
    if (sign != 0 && last_sign != 0 && sign != last_sign) changes.push_back(time);
    if (sign != 0) last_sign = sign;
  };
  if (fastest * end / (2 * std::numbers::pi) * SignChangeTuning::kSamplesPerPeriod >
      SignChangeTuning::kMostSamples)
    throw Error(ErrorKind::kNotConverged,
                "the external force has an angular frequency of {}, which makes more periods until "
                "time {} than can be followed; at most {:.0e} are allowed",
                fastest, end, SignChangeTuning::kMostSamples / SignChangeTuning::kSamplesPerPeriod);
  for (std::size_t i = 0; i < pieces_.size() && pieces_[i].from < end; ++i) {
    const double from = pieces_[i].from;
    const double to = i + 1 < pieces_.size() ? std::min(end, pieces_[i + 1].from) : end;
    const auto& coefficients = pieces_[i].coefficients;
    // The force of this piece. At the end of the piece, value() would give the force of the next
    // piece.
    const auto value_at = [&](double t) {
      double value = polynomial::value(coefficients, t - from);
      for (const auto& s : sinusoids_) value += sine(s, t);
      return value;
    };
    // The force is monotone between two of these times, or nearly so if it has sinusoids.
    std::vector<double> stops = {from};
    if (sinusoids_.empty()) {
      for (const double tau : polynomial::turning_points(coefficients, to - from))
        stops.push_back(from + tau);
    } else {
      const int samples = SignChangeTuning::kSamplesPerPeriod +
                          static_cast<int>(SignChangeTuning::kSamplesPerPeriod * (to - from) *
                                           fastest / (2 * std::numbers::pi));
      for (int n = 1; n < samples; ++n) stops.push_back(from + (to - from) * n / samples);
    }
    stops.push_back(to);
    add_extremum_of(from, value_at(from));
    for (std::size_t n = 1; n < stops.size(); ++n) {
      const double before = value_at(stops[n - 1]), after = value_at(stops[n]);
      if (before * after < 0) {
        const bool rises = after > 0;
        add_extremum_of(bisect_first_true(stops[n - 1], stops[n],
                                          [&](double t) { return (value_at(t) > 0) == rises; }),
                        after);
      } else if (before == 0) {
        add_extremum_of(stops[n - 1], after);
      }
      add_extremum_of(stops[n], after);
    }
  }
  std::erase_if(changes, [&](double t) { return t >= end; });
  return changes;
}

void ForceWalk::enter(std::size_t piece) {
  assert(piece < force_.pieces_.size());
  const auto& pieces = force_.pieces_;
  piece_ = piece;
  end_ =
      piece + 1 < pieces.size() ? pieces[piece + 1].from : std::numeric_limits<double>::infinity();
  constant_ = pieces[piece].coefficients.size() == 1 && force_.sinusoids_.empty();
  level_ = pieces[piece].coefficients.front();
}

ExternalForce read_external_force(const std::filesystem::path& path, double end) {
  const std::array<std::string, 2> columns = {"time", "force"};
  const std::string file = path.string();
  const auto csv = read_csv(path, columns, columns.size());
  std::vector<ExternalForce::Piece> pieces;
  double from = 0, value = 0;
  bool jumped = false;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto& row = csv.rows[i];
    const FilePosition here{file, row.line, "time"};
    const double time = required_field(row, columns, 0, file);
    const double force = required_field(row, columns, 1, file);
    if (i == 0 && time != 0) throw_bad_input(here, "the first time is {}; it must be 0", time);
    if (time < from) throw_bad_input(here, "time is {} after {}; it must not decrease", time, from);
    if (i > 0 && time == from) {
      if (jumped)
        throw_bad_input(
            here, "time {} stands in more than two rows; two rows of one time make a jump", time);
      jumped = true;
    } else if (i > 0) {
      pieces.push_back({time, value, {(force - value) / (time - from)}});
      jumped = false;
    }
    from = time;
    value = force;
  }
  if (csv.rows.empty() || from < end)
    throw_bad_input({file}, "ends at time {}; it must reach motion.end_time, {}", from, end);
  return ExternalForce(pieces);
}

}  // namespace viscontact::reduced_model
