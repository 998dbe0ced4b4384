// The period vectors of a suspension's cell: the start, steps, and where they end.
#include <algorithm>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/suspensions/cell/lattice_fault.hpp"
#include "viscontact/suspensions/simulation_content.hpp"

namespace viscontact::particles {
namespace {

/// Of lattices that do not last against the flow.
constexpr std::string_view kLastsBothWays =
    "a planar extension without rotation, in a box whose edges in its plane are equal, has no such "
    "end";

}  // namespace

void SuspensionSimulation::Content::start_periods() {
  auto& shear = state.shear;
  if (!strains_cell(lubrication(), setting.domain) && !shear.has_periods()) return;
  const auto path = lubrication().stress ? FlowPath{} : path_of(lubrication());
  const auto lengths = periods_of(setting.domain);
  const bool is_new = !shear.has_periods() && state.steps == 0;
  if (!shear.has_periods()) {
    const suspensions::StrainedLattice lattice(lengths, path.direction, lubrication().turns_box);
    auto start = lattice.start();
    if (!is_new) {
      // A run that continues a shear: the box is where the shear left it.
      start = {};
      for (std::size_t d = 0; d < 3; ++d) start[d][d] = lengths[d];
      start[1][0] = shear.offset;
    }
    shear.offset = 0;
    shear.periods = suspensions::reduced(start);
    if (is_new) turn_box(lattice.turn());
  }
  find_lasting(path);
  check_lasting(is_new ? path.lowest : 0);
  check_images();
}

void SuspensionSimulation::Content::find_lasting(const FlowPath& path) {
  // The run that turned the box may have had the opposite direction.
  for (const double sign : {1.0, -1.0}) {
    auto direction = path.direction;
    for (auto& row : direction) row = sign * row;
    const suspensions::StrainedLattice lattice(periods_of(setting.domain), direction, true);
    strain_sign = sign * path.sign;
    const double t = strain_sign * state.shear.net_strain;
    if (lattice.kind() == suspensions::StrainedLattice::Kind::kAsTheBox || t < lattice.earliest() ||
        !suspensions::are_same(lattice.at(t), state.shear.periods))
      continue;
    lasting = lattice;
    return;
  }
}

void SuspensionSimulation::Content::check_lasting(double back) const {
  if (!lasting) return;
  const double pair_length = largest_distance(lubrication(), state.particles);
  if (const auto fault = suspensions::fault_of_lattice(*lasting, pair_length, back))
    throw Error(ErrorKind::kBadInput, "{} {}", fault->key, fault->message);
}

void SuspensionSimulation::Content::turn_box(const suspensions::Matrix& turn) {
  auto& p = particles();
  const auto cell_now = cell();
  const Vector middle = middle_of_box();
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = cell_now.wrapped(middle + suspensions::times(turn, p.position(k) - middle));
    std::ranges::copy(x, &p.positions[3 * k]);
  }
}

void SuspensionSimulation::Content::check_images() const {
  if (!state.shear.has_periods()) return;
  const double least = cell().least_height();
  const double needed = 2 * largest_distance(lubrication(), state.particles);
  if (lasting && strain_sign * state.shear.net_strain < lasting->earliest())
    throw Error(ErrorKind::kNotConverged,
                "the flow has reversed too far beyond its start at t = {:.6g}, the net strain "
                "{:.6g}; {}",
                state.time, state.shear.net_strain, kLastsBothWays);
  if (least < needed)
    throw Error(ErrorKind::kNotConverged,
                "the flow has brought images of the spheres too near at t = {:.6g}, the strain "
                "{:.6g}: opposite faces of the cell are {:.6g} apart, and must be {:.6g} apart, "
                "twice the largest distance of a pair; {}",
                state.time, state.shear.strain, least, needed,
                lasting ? kLastsBothWays
                        : "a larger box gets further, and a box that is turned at the start for a "
                          "planar extension, or a cube for one along three axes, has no such end");
}

void SuspensionSimulation::Content::move_periods(double h) {
  auto& shear = state.shear;
  if (!shear.has_periods()) {
    shear.offset = cell().moved_offset(h * gradient_now()[0][1] * periods_of(setting.domain)[1]);
    return;
  }
  shear.periods = lasting ? lasting->at(strain_sign * shear.net_strain)
                          : suspensions::carried_lattice(gradient_now(), h, shear.periods);
}

}  // namespace viscontact::particles
