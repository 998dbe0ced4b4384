// Times of signed distances of random shapes, mean over pairs, in nanoseconds.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <vector>

#include "tests/particles/shapes/random_shapes.hpp"

namespace {

using namespace viscontact::particles;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Pairs {
  std::vector<PlacedShape> first, second;
  std::vector<Vector2> normals;  ///< of the last call
};

enum class Place { kNear, kFar, kDeep };

Pairs random_pairs(ShapeKind one, ShapeKind other, double ratio, Place place) {
  constexpr int kPairs = 10'000;
  RandomShapes random(1);
  Pairs pairs;
  for (int n = 0; n < kPairs; ++n) {
    const auto first = random.at_random_angle(random.shape(one, ratio, 10));
    auto second = random.at_random_angle(random.shape(other, ratio, 10));
    const double gap =
        place == Place::kFar ? random.log_uniform(1, 1e3) : random.log_uniform(1e-8, 1e-1);
    random.place(first, second, gap * second.shape.bounding_radius());
    if (place == Place::kDeep)
      second.centre = first.centre + random.uniform(0, 0.5) * (second.centre - first.centre);
    pairs.first.push_back(first);
    pairs.second.push_back(second);
  }
  pairs.normals.resize(kPairs);
  return pairs;
}

/// The least of several times, because other processes interrupt some of them.
template <class Function>
double nanoseconds(const Pairs& pairs, const Function& function) {
  double least = 1e300;
  for (int repetition = 0; repetition < 20; ++repetition) {
    const double begin = cpu_seconds();
    for (std::size_t n = 0; n < pairs.first.size(); ++n) function(n);
    least = std::min(least, cpu_seconds() - begin);
  }
  return 1e9 * least / static_cast<double>(pairs.first.size());
}

void run(ShapeKind one, ShapeKind other, double ratio, Place place) {
  Pairs pairs = random_pairs(one, other, ratio, place);
  const double cold = nanoseconds(pairs, [&](std::size_t n) {
    pairs.normals[n] = nearest_points(pairs.first[n], pairs.second[n]).normal;
  });
  // As far from the normal as after a step of a hundredth of a radian.
  std::vector<Vector2> guesses;
  for (const Vector2& normal : pairs.normals)
    guesses.push_back(unit(normal + 1e-2 * quarter_turn(normal)));
  const double warm = nanoseconds(pairs, [&](std::size_t n) {
    pairs.normals[n] = nearest_points(pairs.first[n], pairs.second[n], guesses[n]).normal;
  });
  const auto name_of = [](ShapeKind kind) {
    return Shape(kind, {2, 1 + (kind == ShapeKind::kDisc ? 1.0 : 0.0)}).name();
  };
  constexpr std::array kPlaces = {"near", "far", "deep"};
  fmt::print("{:<8} {:<8} {:>12.4g}  {:<5} {:>5.0f} {:>5.0f}\n", name_of(one), name_of(other),
             ratio, kPlaces[static_cast<std::size_t>(place)], cold, warm);
}

}  // namespace

int main() {
  fmt::print("first    second   ratios up to         cold  warm\n");
  for (const auto& [one, other] : {std::pair{ShapeKind::kDisc, ShapeKind::kDisc},
                                   {ShapeKind::kPlate, ShapeKind::kDisc},
                                   {ShapeKind::kPlate, ShapeKind::kPlate}})
    run(one, other, 20, Place::kNear);
  for (const double ratio : {1.01, 5.0, 20.0}) {
    run(ShapeKind::kEllipse, ShapeKind::kDisc, ratio, Place::kNear);
    run(ShapeKind::kEllipse, ShapeKind::kPlate, ratio, Place::kNear);
    run(ShapeKind::kEllipse, ShapeKind::kEllipse, ratio, Place::kNear);
  }
  run(ShapeKind::kEllipse, ShapeKind::kEllipse, 20, Place::kFar);
  run(ShapeKind::kEllipse, ShapeKind::kEllipse, 20, Place::kDeep);
}
