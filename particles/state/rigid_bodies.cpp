// Motion of rigid bodies, docs/physics.md (5.11).
#include "viscontact/particles/state/rigid_bodies.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

struct RigidBodyTuning {
  // Distances that differ by less than this share of the period count as equal. It is far more than
  // the rounding errors of positions, and far less than a user would distinguish.
  static constexpr double kEqual = 1e-9;
  // Each iteration for a turn multiplies the error by about the turn in radians, so that 50
  // iterations are enough for turns up to 0.5. A step in which a body turns by a radian does not
  // resolve the motion, so that its iteration need not converge.
  static constexpr int kMost = 50;
  // The last change of a turn over the turn: some rounding errors.
  static constexpr double kExact = 4 * std::numeric_limits<double>::epsilon();
};

/// Adds m times |r|^2 times the unit matrix, minus m r r^T, for the mass m [M] at r [L] from the
/// centre.
void add_point_mass(Matrix3& inertia, double mass, const Vector& r) {
  const double square = dot(r, r);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      inertia[3 * i + j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
}

/// Vector `k` of an array that has one number for each disc, component 2, or three for each sphere.
Vector turn_of(const std::vector<double>& values, std::size_t k, int dimension) {
  if (dimension == 3) return {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
  return {0, 0, values[k]};
}

void set_turn(std::vector<double>& values, std::size_t k, int dimension, const Vector& to) {
  if (dimension != 3) {
    values[k] = to[2];
    return;
  }
  for (std::size_t d = 0; d < 3; ++d) values[3 * k + d] = to[d];
}

/// Which images of its members make a body, along one axis of a periodic cell.
struct Cut {
  std::vector<double> periods;  ///< from each member's image in the body to it
  double widest = 0;  ///< largest distance of two neighbours, which is outside the body [L]
  int count = 0;      ///< of distances equal to `widest`; if it is 1, the images are determined
};

/// Along an axis with a period the members and their images lie on a circle, which is cut at the
/// largest distance between neighbours. The body is then as short as it can be, whatever the order
/// of the members and the place of the cell.
Cut cut_of(const Particles& p, const std::vector<std::int32_t>& members, std::size_t axis) {
  const double period = p.cell.lengths[axis];
  const auto first = p.position(index_of(members[0]));
  Cut cut;
  std::vector<double> places;  // coordinates relative to the first member, in [0, period)
  for (const auto member : members) {
    const double x = before_the_motion(p.cell, p.position(index_of(member)) - first)[axis];
    cut.periods.push_back(std::floor(x / period));
    places.push_back(x - period * cut.periods.back());
  }
  auto sorted = places;
  std::ranges::sort(sorted);
  // From each member to the next one, and from the last one to an image of the first.
  std::vector<double> distances;
  for (std::size_t m = 0; m < sorted.size(); ++m)
    distances.push_back(m + 1 < sorted.size() ? sorted[m + 1] - sorted[m]
                                              : sorted[0] + period - sorted[m]);
  const auto widest = std::ranges::max_element(distances);
  cut.widest = *widest;
  cut.count = static_cast<int>(std::ranges::count_if(distances, [&](double distance) {
    return distance >= cut.widest - RigidBodyTuning::kEqual * period;
  }));
  const auto begin = static_cast<std::size_t>(widest - distances.begin()) + 1;
  const double from = begin < sorted.size() ? sorted[begin] : 0;
  for (std::size_t m = 0; m < places.size(); ++m)
    if (places[m] < from) cut.periods[m] -= 1;
  // The image of the first member shall be the member itself. If a body crosses no side of the
  // cell, all periods are then 0 and its positions keep their bits.
  const double shift = cut.periods[0];
  for (auto& periods : cut.periods) periods -= shift;
  return cut;
}

struct MemberImage {
  Vector position{}, velocity{};
};

std::vector<MemberImage> images_of(const Particles& p, const std::vector<std::int32_t>& members) {
  std::vector<Periods> periods(members.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(p.cell.lengths[axis] > 0)) continue;
    const auto cut = cut_of(p, members, axis);
    for (std::size_t m = 0; m < members.size(); ++m) periods[m][axis] = cut.periods[m];
  }
  std::vector<MemberImage> images;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const auto k = index_of(members[m]);
    images.push_back({p.position(k) - shift_of(p.cell, periods[m]),
                      p.velocity(k) - velocity_of_image(p.cell, periods[m])});
  }
  return images;
}

void sum_members(const Particles& p, const RigidBodyRequest& request, RigidBody& body) {
  for (const auto member : body.members) body.mass += p.masses[index_of(member)];
  if (request.mass >= 0) body.mass = request.mass;
  const auto masses = member_masses(body, p);
  const auto images = images_of(p, body.members);
  for (std::size_t m = 0; m < masses.size(); ++m) {
    const double weight =
        body.mass > 0 ? masses[m] / body.mass : 1 / static_cast<double>(masses.size());
    body.centre = body.centre + weight * images[m].position;
    body.velocity = body.velocity + weight * images[m].velocity;
  }
  Vector turning{};  // angular momentum of the members about the centre [M L^2/T]
  for (std::size_t m = 0; m < masses.size(); ++m) {
    const auto k = index_of(body.members[m]);
    const auto& image = images[m];
    const Vector offset = image.position - body.centre;
    body.offsets.push_back(offset);
    body.member_angles.push_back(p.angles.empty() ? 0 : p.angles[k]);
    add_point_mass(body.inertia, masses[m], offset);
    const double own = p.masses[k] > 0 && !p.inertias.empty()
                           ? p.inertias[k] * (masses[m] / p.masses[k])
                           : p.shape(k).inertia(masses[m]);
    for (const std::size_t i : {0U, 4U, 8U}) body.inertia[i] += own;
    turning = turning + masses[m] * cross(offset, image.velocity - body.velocity) +
              own * turn_of(p.angular_velocities, k, p.dimension);
  }
  if (request.moment_of_inertia >= 0) {
    // The angular momentum is scaled with the inertia, so that the angular velocity stays.
    const double before = body.inertia[8];
    body.inertia[8] = request.moment_of_inertia;
    if (before > 0) turning = (body.inertia[8] / before) * turning;
  }
  body.angular_momentum = p.dimension == 3 ? turning : Vector{0, 0, turning[2]};
  update_angular_velocity(body, p.dimension);
}

void wrap_centre(RigidBody& body, const PeriodicCell& cell) {
  Periods beyond{};
  for (std::size_t d = 0; d < 3; ++d) beyond[d] = periods_beyond(cell, d, body.centre[d]);
  body.centre = body.centre - shift_of(cell, beyond);
  body.velocity = body.velocity - velocity_of_image(cell, beyond);
}

}  // namespace

Matrix3 inverse_of(const Matrix3& a) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
    return a[3 * i1 + j1] * a[3 * i2 + j2] - a[3 * i1 + j2] * a[3 * i2 + j1];
  };
  const double determinant = a[0] * minor(0, 0) + a[1] * minor(0, 1) + a[2] * minor(0, 2);
  Matrix3 inverse;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) inverse[3 * i + j] = minor(j, i) / determinant;
  return inverse;
}

std::optional<AmbiguousImages> ambiguous_images(const Particles& particles,
                                                const std::vector<std::int32_t>& members) {
  assert(!members.empty());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(particles.cell.lengths[axis] > 0)) continue;
    const auto cut = cut_of(particles, members, axis);
    if (cut.count > 1) return AmbiguousImages{axis, cut.widest};
  }
  return std::nullopt;
}

void add_rigid_body(Particles& particles, const RigidBodyRequest& request) {
  assert(!request.members.empty() && (particles.dimension == 2 || particles.dimension == 3));
  assert(!particles.angular_velocities.empty());
  assert(std::ranges::all_of(request.members,
                             [&](std::int32_t k) { return particles.bodies.body_of(k) < 0; }));
  RigidBody body;
  body.members = request.members;
  std::ranges::sort(body.members);
  sum_members(particles, request, body);
  wrap_centre(body, particles.cell);
  auto& bodies = particles.bodies;
  bodies.of_particle.resize(particles.count(), -1);
  for (const auto member : body.members)
    bodies.of_particle[index_of(member)] = static_cast<std::int32_t>(bodies.count());
  bodies.bodies.push_back(std::move(body));
  place_members(particles);
}

double diameter(const RigidBody& body, const Particles& particles) {
  double radius = 0;
  for (std::size_t m = 0; m < body.members.size(); ++m)
    radius = std::max(radius, norm(body.offsets[m]) + particles.radii[index_of(body.members[m])]);
  return 2 * radius;
}

Vector turned_with(const RigidBody& body, const Vector& at_start, int dimension) {
  if (dimension == 3) return rotated(body.orientation, at_start);
  if (body.angle[2] == 0) return at_start;
  const double c = std::cos(body.angle[2]), s = std::sin(body.angle[2]);
  return {c * at_start[0] - s * at_start[1], s * at_start[0] + c * at_start[1], 0};
}

Vector present_offset(const RigidBody& body, std::size_t m, int dimension) {
  assert(m < body.offsets.size());
  return turned_with(body, body.offsets[m], dimension);
}

Matrix3 present_inertia(const RigidBody& body, int dimension) {
  if (dimension != 3) return body.inertia;
  // R I R^T, where column j of R is the present direction of axis j of the body.
  std::array<Vector, 3> axes;
  for (std::size_t j = 0; j < 3; ++j) {
    Vector axis{};
    axis[j] = 1;
    axes[j] = rotated(body.orientation, axis);
  }
  Matrix3 inertia{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          inertia[3 * i + j] += axes[k][i] * body.inertia[3 * k + l] * axes[l][j];
  return inertia;
}

void update_angular_velocity(RigidBody& body, int dimension) {
  if (!(body.inertia[8] > 0)) return;
  if (dimension == 3)
    body.angular_velocity = inverse_of(present_inertia(body, dimension)) * body.angular_momentum;
  else
    body.angular_velocity[2] = body.angular_momentum[2] / body.inertia[8];
}

std::vector<double> member_masses(const RigidBody& body, const Particles& particles) {
  double sum = 0;
  for (const auto member : body.members) sum += particles.masses[index_of(member)];
  std::vector<double> masses;
  for (const auto member : body.members)
    masses.push_back(sum > 0 ? particles.masses[index_of(member)] * (body.mass / sum)
                             : body.mass / static_cast<double>(body.members.size()));
  return masses;
}

Periods periods_of_member(const RigidBody& body, std::size_t m, const Particles& p) {
  assert(m < body.members.size());
  return periods_towards(p.cell, body.centre + present_offset(body, m, p.dimension) -
                                     p.position(index_of(body.members[m])));
}

void place_members(Particles& p) {
  for (auto& body : p.bodies.bodies) {
    if (!p.cell.is_sheared()) wrap_centre(body, p.cell);
    const Vector& w = body.angular_velocity;
    for (std::size_t m = 0; m < body.members.size(); ++m) {
      const auto k = index_of(body.members[m]);
      const Vector offset = present_offset(body, m, p.dimension);
      // Of all images of the new place, the member gets the one nearest to its last position. A
      // jump by a period would make the numbers of images in the neighbour list wrong.
      const auto periods = periods_of_member(body, m, p);
      const Vector x = body.centre + offset - shift_of(p.cell, periods);
      const Vector v = body.velocity + cross(w, offset) - velocity_of_image(p.cell, periods);
      const auto d = static_cast<std::size_t>(p.dimension);
      for (std::size_t i = 0; i < d; ++i) {
        p.positions[k * d + i] = x[i];
        p.velocities[k * d + i] = v[i];
      }
      set_turn(p.angular_velocities, k, p.dimension, w);
      if (p.dimension == 3)
        std::ranges::copy(body.orientation, p.orientations.begin() + 4 * std::ptrdiff_t(k));
      else
        p.angles[k] = body.member_angles[m] + body.angle[2];
    }
  }
}

std::size_t member_number(const RigidBody& body, std::int32_t particle) {
  return static_cast<std::size_t>(std::ranges::find(body.members, particle) - body.members.begin());
}

Vector offset_in_body(const Particles& particles, std::int32_t particle) {
  const auto number = particles.bodies.body_of(particle);
  if (number < 0) return {};
  const auto& body = particles.bodies.bodies[index_of(number)];
  return present_offset(body, member_number(body, particle), particles.dimension);
}

Matrix3 scaled(double factor, Matrix3 a) {
  for (auto& x : a) x *= factor;
  return a;
}

namespace {

/// Turn [rad] in a step of length h by the implicit midpoint rule: the fixed point of turn = h (I +
/// added)^-1 L, with the inertia I after half of the turn.
Vector midpoint_turn(const RigidBody& body, const Vector& angular_momentum, const Matrix3& added,
                     double h) {
  Vector turn = h * (inverse_of(present_inertia(body, 3) + added) * angular_momentum);
  for (int n = 0; n < RigidBodyTuning::kMost; ++n) {
    RigidBody middle = body;
    middle.orientation = turned(body.orientation, 0.5 * turn);
    const Vector next = h * (inverse_of(present_inertia(middle, 3) + added) * angular_momentum);
    const double change = norm(next - turn);
    turn = next;
    if (change <= RigidBodyTuning::kExact * norm(turn)) break;
  }
  return turn;
}

}  // namespace

BodyStep free_step(const RigidBody& body, const BodyLoad& load, double h, double impulse_time,
                   bool is_first, int dimension) {
  assert(h > 0 && body.mass > 0);
  BodyStep step;
  step.mobility = h / body.mass;
  step.displacement = h * (body.velocity + (impulse_time / body.mass) * load.force);
  const auto inertia = present_inertia(body, dimension);
  const auto added = scaled(h * impulse_time, load.stiffness);
  step.momentum_of_turn = scaled(1 / h, inertia);
  step.inverse_turn_mobility = scaled(1 / h, inertia + added);
  const Vector rest = is_first ? Vector{} : h * body.angular_velocity;
  const Vector momentum =
      body.angular_momentum + impulse_time * load.torque + impulse_time * (load.stiffness * rest);
  if (dimension == 3) {
    step.turn_mobility = scaled(h, inverse_of(inertia + added));
    step.turn = midpoint_turn(body, momentum, added, h);
  } else {
    step.turn_mobility[8] = h / (inertia[8] + added[8]);
    step.turn[2] = step.turn_mobility[8] * momentum[2];
  }
  step.angular_momentum = momentum - impulse_time * (load.stiffness * step.turn);
  return step;
}

void constrain(BodyStep& step, const Vector& displacement, const Vector& turn, int dimension) {
  const Vector change = turn - step.turn;
  if (dimension == 3)
    step.angular_momentum = step.angular_momentum + step.momentum_of_turn * change;
  else
    step.angular_momentum[2] = step.momentum_of_turn[8] * turn[2] + step.momentum_excess[2];
  step.displacement = displacement;
  step.turn = turn;
}

Vector displacement_at(const Vector& displacement, const Vector& turn, const Vector& arm,
                       int dimension) {
  if (dimension == 3) return displacement + rotated(turned({1, 0, 0, 0}, turn), arm) - arm;
  // c1 = cos(turn) - 1 is computed from the sine of half the angle, which avoids cancellation.
  const double s = std::sin(turn[2]), half = std::sin(turn[2] / 2), c1 = -2 * half * half;
  return {displacement[0] + c1 * arm[0] - s * arm[1], displacement[1] + s * arm[0] + c1 * arm[1],
          0};
}

void move_body(RigidBody& body, const BodyStep& step, double h, int dimension) {
  assert(h > 0);
  body.centre = body.centre + step.displacement;
  body.velocity = (1 / h) * step.displacement + step.velocity_excess;
  body.angular_momentum = step.angular_momentum;
  if (dimension == 3)
    body.orientation = turned(body.orientation, step.turn);
  else
    body.angle[2] += step.turn[2];
  update_angular_velocity(body, dimension);
}

}  // namespace viscontact::particles
