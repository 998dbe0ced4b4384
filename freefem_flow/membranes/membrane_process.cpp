// The boundary of the mesh around membranes, and the dialogue with membranes.edp
// (membrane_process.hpp). The script computes in a unit of length near the size of a membrane and a
// unit of viscosity near that of the fluid; both are powers of 2, so that no digit changes.
#include "viscontact/freefem_flow/membranes/membrane_process.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/freefem_flow/dissipation_alone.hpp"
#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/freefem_flow/mesh_boundary.hpp"
#include "viscontact/freefem_flow/process/flow_process.hpp"
#include "viscontact/freefem_flow/process/opening.hpp"
#include "viscontact/freefem_flow/process/solver_dialogue.hpp"
#include "viscontact/particles/membranes/membrane_curve.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::DiscDomain;
using particles::Membrane;

constexpr std::size_t kComponents = 3;      // of the motion of a particle in the plane
constexpr int kFirstMembraneLabel = 20;     // of membranes.edp
constexpr std::size_t kMostMembranes = 70;  // labels of particles begin at 100

/// Appends numbers with a space before each, and ends the line.
template <class Numbers>
void append_line(std::string& text, const Numbers& numbers) {
  for (const double number : numbers) text += ' ' + format_number(number);
  text += '\n';
}

/// The two matrices between the N beads of a membrane and the 2 E nodes of its E edges, at which
/// the velocity is known: quadratic on each edge.
struct MembraneNodes {
  /// From positions of beads to those of nodes, by trigonometric interpolation: 2 E rows.
  Eigen::MatrixXd sampling;
  /// From forces on beads to forces on nodes: 2 E rows. Its transpose gives the velocities of beads
  /// that are nearest to those on the edges (least squares), so that powers are the same.
  Eigen::MatrixXd smoothing;
};

MembraneNodes nodes_of(int beads, int edges) {
  MembraneNodes nodes;
  nodes.sampling.resize(2 * edges, beads);
  for (int i = 0; i < 2 * edges; ++i)
    for (int k = 0; k < beads; ++k)
      nodes.sampling(i, k) = particles::cardinal(
          beads, particles::kTwoPi * (i / (2.0 * edges) - static_cast<double>(k) / beads), 0);
  // Integrals of the products of the quadratic functions, over the length of an edge.
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(2 * edges, 2 * edges);
  const Eigen::Matrix3d own = (Eigen::Matrix3d() << 4, 2, -1, 2, 16, 2, -1, 2, 4).finished() / 30;
  for (int e = 0; e < edges; ++e)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        mass((2 * e + i) % (2 * edges), (2 * e + j) % (2 * edges)) += own(i, j);
  const Eigen::MatrixXd weighted = mass * nodes.sampling;
  nodes.smoothing = weighted * (nodes.sampling.transpose() * weighted).inverse();
  return nodes;
}

/// Stokes flow around membranes, computed by FreeFEM.
class MembraneProcess : public particles::FluidSolver {
 public:
  MembraneProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                  const StopToken& stop);

  void place(const particles::FluidParticles& bodies) override;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  std::vector<double> mobility(std::size_t components) override;
  particles::FlowQuantities quantities() override {
    particles::FlowQuantities quantities;
    quantities.dissipation = dissipation_;
    if (dissipation_alone_ > 0) quantities.apparent_viscosity = dissipation_ / dissipation_alone_;
    return quantities;
  }
  double vary_penalty() override { return 0; }
  particles::SecondMesh vary_mesh() override { return {}; }
  FlowField flow() override;
  std::size_t unknowns() const override { return unknowns_; }
  double peak_memory_mebibytes() const override {
    return static_cast<double>(std::max(peak_memory_kb_, solver_->peak_memory_kb())) / 1024;
  }

 private:
  void start();
  std::string boundary_of(const std::vector<Eigen::MatrixXd>& nodes) const;
  double shift_for(const std::vector<Eigen::MatrixXd>& nodes) const;
  void check_places(const std::vector<Eigen::MatrixXd>& nodes) const;

  SolverCommand command_;
  StopToken stop_;
  std::string opening_;
  particles::Domain domain_;  // in the units of the solver
  double length_ = 1, viscosity_ = 1;
  std::vector<Membrane> membranes_;
  int edges_;  // on each membrane
  std::vector<MembraneNodes> nodes_;
  // Of the last flow, and of the fluid without membranes (0: not known), in the units of the case.
  double dissipation_ = 0, dissipation_alone_;
  std::unique_ptr<SolverDialogue> solver_;
  double shift_ = 0;  // along x, of the domain with respect to the mesh
  std::size_t unknowns_ = 0;
  long peak_memory_kb_ = 0;  // of processes that were replaced
};

particles::Domain in_unit(particles::Domain domain, double unit) {
  if (auto* disc = std::get_if<DiscDomain>(&domain)) {
    for (auto& x : disc->centre) x /= unit;
    disc->radius /= unit;
  } else if (auto* box = std::get_if<BoxDomain>(&domain)) {
    for (auto* corner : {&box->from, &box->to})
      for (auto& x : *corner) x /= unit;
  }
  return domain;
}

MembraneProcess::MembraneProcess(const particles::Fluid& fluid, const particles::Domain& domain,
                                 const StopToken& stop)
    : command_(membrane_solver_command()),
      stop_(stop),
      edges_(fluid.edges_per_particle),
      dissipation_alone_(dissipation_alone(fluid, domain)) {
  const auto& membranes = fluid.membranes;
  if (membranes.size() > kMostMembranes)
    throw Error(ErrorKind::kBadInput,
                fmt::format("the case has {} membranes; at most {} are allowed", membranes.size(),
                            kMostMembranes));
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& membrane : membranes) {
    smallest = std::min(smallest, std::sqrt(membrane.area / std::numbers::pi));
    // With fewer nodes on the edges a force on a bead would not be smooth on the edges.
    edges_ = std::max(edges_, (2 * membrane.beads + 2) / 3);
  }
  membranes_ = membranes;
  length_ = std::exp2(std::round(std::log2(smallest)));
  viscosity_ = std::exp2(std::round(std::log2(fluid.viscosity)));
  domain_ = in_unit(domain, length_);
  // Without particles, the rigid motions are unknowns that are not there.
  auto scaled = fluid;
  scaled.viscosity /= viscosity_;
  scaled.constraint = particles::RigidConstraint::kRigid;
  if (auto* sides = std::get_if<particles::SideVelocities>(&scaled.boundary))
    for (auto& side : *sides)
      for (auto& component : side.value) component /= length_;
  std::string text =
      opening(scaled, domain_, {}, 2) + fmt::format("membranes {}\n", membranes.size());
  for (const auto& membrane : membranes) {
    nodes_.push_back(nodes_of(membrane.beads, edges_));
    text +=
        fmt::format("{} {} {}\n", membrane.beads, edges_, format_number(membrane.viscosity_ratio));
    for (const auto& row : nodes_.back().smoothing.rowwise()) append_line(text, row);
  }
  opening_ = std::move(text);
  start();
}

void MembraneProcess::start() {
  if (solver_) peak_memory_kb_ = std::max(peak_memory_kb_, solver_->peak_memory_kb());
  solver_.reset();
  const auto limits = solver_limits(stop_);
  solver_ = std::make_unique<SolverDialogue>(command_, limits.answer, limits.ready, limits.stop);
  solver_->ask("viscontact-fluid", opening_);
  solver_->expect("ready", true);
  solver_->expect("boundary");
}

/// Throws Error(kNotConverged) if a node of a membrane is not in the domain.
void MembraneProcess::check_places(const std::vector<Eigen::MatrixXd>& nodes) const {
  const auto is_inside = [&](double x, double y) {
    if (const auto* disc = std::get_if<DiscDomain>(&domain_))
      return std::hypot(x - disc->centre[0], y - disc->centre[1]) < disc->radius;
    const auto& box = std::get<BoxDomain>(domain_);
    return (box.periodic[0] || (x > box.from[0] && x < box.to[0])) && y > box.from[1] &&
           y < box.to[1];
  };
  for (const auto& own : nodes)
    for (Eigen::Index i = 0; i < own.rows(); ++i)
      if (!is_inside(own(i, 0), own(i, 1)))
        throw Error(ErrorKind::kNotConverged,
                    fmt::format("a membrane leaves the domain at ({:.6g}, {:.6g}); use a shorter "
                                "time_step, or more room between membranes and walls",
                                own(i, 0) * length_, own(i, 1) * length_));
}

/// The shift along x after which no membrane crosses the sides of a box that is periodic along x.
double MembraneProcess::shift_for(const std::vector<Eigen::MatrixXd>& nodes) const {
  const auto* box = std::get_if<BoxDomain>(&domain_);
  if (box == nullptr || !box->periodic[0] || nodes.empty()) return 0;
  const double period = box->to[0] - box->from[0];
  // Where membranes begin and end within the period, and the widest gap between them.
  std::vector<std::array<double, 2>> ranges;
  for (const auto& own : nodes) {
    const double from = own.col(0).minCoeff(), width = own.col(0).maxCoeff() - from;
    const double start = from - period * std::floor((from - box->from[0]) / period);
    ranges.push_back({start, start + width});
  }
  std::ranges::sort(ranges);
  double end = ranges.front()[1], widest = 0, middle = 0;
  for (const auto& range : ranges) end = std::max(end, range[1]);
  end -= period;  // the furthest end of the images one period before
  for (const auto& [from, to] : ranges) {
    if (from - end > widest) {
      widest = from - end;
      middle = (from + end) / 2;
    }
    end = std::max(end, to);
  }
  if (!(widest > 1e-3 * period))
    throw Error(
        ErrorKind::kNotConverged,
        "no straight line across the periodic domain passes between the membranes, at which "
        "the mesh could end; use a longer domain");
  return middle - box->from[0];
}

std::string MembraneProcess::boundary_of(const std::vector<Eigen::MatrixXd>& nodes) const {
  std::vector<Point> points;
  std::vector<MeshBoundary::Curve> curves;
  const auto add = [&](const std::vector<Point>& more, int label) {
    curves.push_back({static_cast<int>(points.size()), static_cast<int>(more.size()) - 1, label});
    points.insert(points.end(), more.begin(), more.end());
  };
  // Edges grow by this share of the distance from the nearest membrane, with 24 edges on it.
  constexpr double kGrowthOfMembranes = 0.25, kEdgesOfAWall = 6, kOfGap = 0.5;
  const double growth = kGrowthOfMembranes * 24 / edges_, cap = size_of(domain_) / kEdgesOfAWall;
  const auto wanted_at = [&](const Point& x) {
    double wanted = cap;
    for (const auto& own : nodes)
      for (Eigen::Index i = 0; i + 2 < own.rows(); i += 2) {
        const double edge = (own.row(i + 2) - own.row(i)).norm();
        const double distance = std::hypot(own(i, 0) - x[0], own(i, 1) - x[1]);
        wanted =
            std::min({wanted, edge + growth * distance, std::max(edge / 8, kOfGap * distance)});
      }
    return wanted;
  };
  const auto line = [&](const Point& from, const Point& to) {
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    const auto at = [&](double s) {
      return Point{from[0] + s / length * (to[0] - from[0]),
                   from[1] + s / length * (to[1] - from[1])};
    };
    std::vector<Point> cut;
    for (const double s : cut_curve(length, 1, [&](double t) { return wanted_at(at(t)); }))
      cut.push_back(at(s));
    cut.front() = from;
    cut.back() = to;
    return cut;
  };
  if (const auto* disc = std::get_if<DiscDomain>(&domain_)) {
    const auto at = [&](double s) {
      return Point{disc->centre[0] + disc->radius * std::cos(s / disc->radius),
                   disc->centre[1] + disc->radius * std::sin(s / disc->radius)};
    };
    std::vector<Point> circle;
    for (const double s : cut_curve(particles::kTwoPi * disc->radius, 24,
                                    [&](double t) { return wanted_at(at(t)); }))
      circle.push_back(at(s));
    circle.back() = circle.front();
    add(circle, 1);
  } else {
    const auto& box = std::get<BoxDomain>(domain_);
    const auto &a = box.from, &b = box.to;
    auto right = line({b[0], a[1]}, {b[0], b[1]}), left = line({a[0], b[1]}, {a[0], a[1]});
    if (box.periodic[0]) {
      right = left;
      std::ranges::reverse(right);
      for (auto& x : right) x[0] = b[0];
    }
    add(line(a, {b[0], a[1]}), 3);
    add(right, box.periodic[0] ? kPeriodicLabel : 2);
    add(line(b, {a[0], b[1]}), 4);
    add(left, box.periodic[0] ? kPeriodicLabel : 1);
  }
  std::string middles = "middles\n";
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    std::vector<Point> ends;
    for (Eigen::Index e = 0; e < edges_; ++e) {
      ends.push_back({nodes[m](2 * e, 0), nodes[m](2 * e, 1)});
      append_line(middles, std::array{nodes[m](2 * e + 1, 0), nodes[m](2 * e + 1, 1)});
    }
    ends.push_back(ends.front());
    add(ends, kFirstMembraneLabel + static_cast<int>(m));
  }
  std::string text = fmt::format("boundary {} {}\n", points.size(), curves.size());
  for (const auto& point : points) append_line(text, point);
  for (const auto& curve : curves)
    text += fmt::format("{} {} {}\n", curve.first, curve.edges, curve.label);
  return text + middles;
}

void MembraneProcess::place(const particles::FluidParticles& bodies) {
  std::vector<Eigen::MatrixXd> nodes;
  for (std::size_t m = 0; m < nodes_.size(); ++m) {
    Eigen::MatrixXd own(membranes_[m].beads, 2);
    for (Eigen::Index k = 0; k < own.rows(); ++k) {
      const auto at = bodies.particles->position(static_cast<std::size_t>(membranes_[m].first + k));
      own.row(k) << at[0] / length_, at[1] / length_;
    }
    if (!own.allFinite())
      throw Error(ErrorKind::kNotConverged, "a position of a membrane left the range of a double");
    nodes.emplace_back(nodes_[m].sampling * own);
  }
  check_places(nodes);
  shift_ = shift_for(nodes);
  if (const auto* box = std::get_if<BoxDomain>(&domain_); box != nullptr && box->periodic[0]) {
    // The mesh covers the period that begins at a line between membranes.
    const double period = box->to[0] - box->from[0];
    for (auto& own : nodes) {
      own.col(0).array() -= shift_;
      const double from = own.col(0).minCoeff() - box->from[0];
      own.col(0).array() -= period * std::floor(from / period);
    }
  }
  // A large system changes the rounding errors of later ones (SolverCommand).
  if (unknowns_ > command_.most_unknowns_reproduced) start();
  solver_->ask("place", "place\ndriven 0\ninertia 0\n" + boundary_of(nodes));
  solver_->expect("placed", true);
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  unknowns_ = static_cast<std::size_t>(solver_->whole_number(kMost));
}

// The script has x of the beads of all membranes, which are all particles, and then y.

std::vector<double> MembraneProcess::mobility(std::size_t components) {
  solver_->ask("mobility", "mobility\n");
  solver_->expect("mobility");
  const auto beads = components / kComponents;
  std::vector<double> rows(components * components);
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t k = 0; k < beads; ++k)
      for (std::size_t d = 0; d < 2; ++d)
        for (std::size_t i = 0; i < beads; ++i)
          rows[(kComponents * k + c) * components + kComponents * i + d] =
              solver_->number() / viscosity_;
  return rows;
}

std::vector<double> MembraneProcess::velocities(std::span<const double> forces, bool driving) {
  std::string text = driving ? "solve 1" : "solve 0";
  const auto beads = forces.size() / kComponents;
  std::vector<double> scaled;
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t k = 0; k < beads; ++k) {
      scaled.push_back(forces[kComponents * k + d] / (viscosity_ * length_));
      if (!std::isfinite(scaled.back()))
        throw Error(ErrorKind::kNotConverged, "a force of a membrane left the range of a double");
    }
  append_line(text, scaled);
  solver_->ask("solve", text);
  solver_->expect("velocities");
  std::vector<double> velocities(forces.size());
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t k = 0; k < beads; ++k)
      velocities[kComponents * k + d] = solver_->number() * length_;
  if (driving) dissipation_ = solver_->number() * viscosity_ * length_ * length_;
  return velocities;
}

FlowField MembraneProcess::flow() {
  auto field = read_flow(*solver_);
  for (auto& x : field.x) x += shift_;
  for (auto* lengths : {&field.x, &field.y, &field.velocity_x, &field.velocity_y})
    for (auto& value : *lengths) value *= length_;
  for (auto& pressure : field.pressure) pressure *= viscosity_;
  return field;
}

}  // namespace

std::unique_ptr<particles::FluidSolver> start_membrane_solver(const particles::Fluid& fluid,
                                                              const particles::Domain& domain,
                                                              const StopToken& stop) {
  return std::make_unique<MembraneProcess>(fluid, domain, stop);
}

}  // namespace viscontact::freefem_flow
