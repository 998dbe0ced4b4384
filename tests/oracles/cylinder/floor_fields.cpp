#include "tests/oracles/cylinder/floor_fields.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace viscontact {
namespace {

using Real = long double;
using Complex = std::complex<Real>;

constexpr int kLastPolynomial = 12;
constexpr int kRingsPerCorner = 16;

/// A and its derivatives.
struct OddFunction {
  Complex value, d_rho, d_z, d_zz, d_z_rho;
};

/// psi = 1 + zeta/s, s^2 = rho^2 + zeta^2, zeta = z - ring_z - i ring_radius: the stream function
/// of a source on the axis, moved to a complex z, so that its real and imaginary part are singular
/// on the ring. The branch of s makes the cut the plane outside the ring, and psi = 0 on the axis.
OddFunction source(Real ring_radius, Real ring_z, Real rho, Real z) {
  const Real height = z - ring_z;
  const Complex zeta(height, -ring_radius);
  const Complex s =
      Complex(0, 1) * std::sqrt(Complex(ring_radius * ring_radius - rho * rho - height * height,
                                        2 * ring_radius * height));
  const Complex s3 = s * s * s;
  const Complex s5 = s3 * s * s;
  return {.value = zeta / s + Real(1),
          .d_rho = -zeta * rho / s3,
          .d_z = rho * rho / s3,
          .d_zz = Real(-3) * rho * rho * zeta / s5,
          .d_z_rho = 2 * rho / s3 - 3 * rho * rho * rho / s5};
}

/// source(z) - source(-z).
OddFunction odd_source(Real ring_radius, Real ring_z, Real rho, Real z) {
  const OddFunction above = source(ring_radius, ring_z, rho, z);
  const OddFunction below = source(ring_radius, ring_z, rho, -z);
  return {.value = above.value - below.value,
          .d_rho = above.d_rho - below.d_rho,
          .d_z = above.d_z + below.d_z,
          .d_zz = above.d_zz - below.d_zz,
          .d_z_rho = above.d_z_rho + below.d_z_rho};
}

/// From A = r^n G_n(cos theta), n odd, and its integral for n even, G_n the Gegenbauer function of
/// degree -1/2 (Happel & Brenner 1983, section 4-23): all polynomials that there are.
void append_polynomials(Real rho, Real z, std::vector<StreamFunction>& fields) {
  const Real r2 = rho * rho + z * z;
  std::array<Real, kLastPolynomial + 2> p{};  // r^n P_n(cos theta)
  p[0] = 1;
  p[1] = z;
  for (std::size_t n = 2; n < p.size(); ++n) {
    const Real k = static_cast<Real>(n);
    p[n] = ((2 * k - 1) * z * p[n - 1] - (k - 1) * r2 * p[n - 2]) / k;
  }
  const auto g = [&](std::size_t n) {  // r^n G_n, with d_rho = rho p[n-2] and d_z = (n-2) g(n-1)
    return (r2 * p[n - 2] - p[n]) / static_cast<Real>(2 * n - 1);
  };
  for (std::size_t n = 3; n <= kLastPolynomial; ++n) {
    const Real k = static_cast<Real>(n);
    if (n % 2 == 1) {
      fields.push_back({z * g(n), z * rho * p[n - 2], g(n) + z * (k - 2) * g(n - 1)});
    } else {
      fields.push_back({z * g(n) - g(n + 1) / (k - 1),
                        z * rho * p[n - 2] - rho * p[n - 1] / (k - 1), z * (k - 2) * g(n - 1)});
    }
  }
}

}  // namespace

FloorFields::FloorFields(long double radius, long double height)
    : length_(std::hypot(radius, height)), count_(kLastPolynomial - 2) {
  // Distances to the corners from 2 to 0.01 radii, each a constant part of the one before. With the
  // mirror image that the floor makes, the lower corner is a point of a straight wall; there only
  // the imaginary part of a source is odd.
  for (int i = 0; i < kRingsPerCorner; ++i) {
    const Real distance = 2 * radius * std::pow(0.005L, Real(i) / (kRingsPerCorner - 1));
    rings_.push_back({radius + distance, 0});
    rings_.push_back({radius + distance, height + distance});
    count_ += 2 + 4;
  }
}

std::vector<StreamFunction> FloorFields::at(long double rho, long double z) const {
  std::vector<StreamFunction> fields;
  fields.reserve(static_cast<std::size_t>(count_));
  append_polynomials(rho / length_, z / length_, fields);
  for (StreamFunction& field : fields) {  // derivatives by lengths, not by multiples of length_
    field.d_rho /= length_;
    field.d_z /= length_;
  }
  for (const Ring& ring : rings_) {
    const OddFunction a = odd_source(ring.radius, ring.z, rho, z);
    const std::array<Complex, 3> first{z * a.value, z * a.d_rho, a.value + z * a.d_z};
    const std::array<Complex, 3> second{z * a.d_z - a.value, z * a.d_z_rho - a.d_rho, z * a.d_zz};
    for (const auto& [value, d_rho, d_z] : {first, second}) {
      fields.push_back({value.imag(), d_rho.imag(), d_z.imag()});
      if (ring.z > 0) fields.push_back({value.real(), d_rho.real(), d_z.real()});
    }
  }
  return fields;
}

}  // namespace viscontact
