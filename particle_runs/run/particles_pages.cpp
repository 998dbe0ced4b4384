// Reads the frames of a run and draws them, with bounded memory however long the run is.
#include "viscontact/particle_runs/run/particles_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particle_runs/io/contact_file.hpp"
#include "viscontact/particle_runs/io/playback.hpp"
#include "viscontact/particle_runs/io/rheology_file.hpp"
#include "viscontact/particle_runs/io/vtk.hpp"
#include "viscontact/particle_runs/picture/particles_picture.hpp"
#include "viscontact/particle_runs/picture/scene.hpp"
#include "viscontact/particle_runs/run/rheology_charts.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/report/pictures/pdf.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::particles {
namespace {

namespace fs = std::filesystem;

/// Playback::origin.
Vector origin_of_pictures(const ParticlesCase& c) {
  const auto& p = c.particles;
  if (p.dimension == 1) return {};
  if (p.count() == 0) return distant_corner(c.setting.domain);
  Vector low = p.position(0), high = low;
  double radius = 0, size = 0;  // [L]
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = p.position(k);
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
    radius = std::max(radius, p.radii[k]);
  }
  for (std::size_t d = 0; d < 3; ++d) size = std::max(size, high[d] - low[d] + 2 * radius);
  // Single precision then has errors of at most some 1e-4 of the size.
  constexpr double kDistant = 1000;
  const double rounded = std::pow(10, std::floor(std::log10(size)));
  for (auto& x : low) x = std::abs(x) > kDistant * size ? std::round(x / rounded) * rounded : 0;
  return low;
}

Playback without_frames(const ParticlesCase& c) {
  Playback playback;
  playback.origin = origin_of_pictures(c);
  playback.dimension = c.particles.dimension;
  playback.units = c.units;
  playback.radii.assign(c.particles.radii.begin(), c.particles.radii.end());
  if (std::ranges::any_of(c.particles.masses, [](double mass) { return mass > 0; }))
    playback.masses.assign(c.particles.masses.begin(), c.particles.masses.end());
  playback.is_in_fluid = c.setting.fluid.has_value();
  playback.shapes = c.particles.shapes;
  playback.ids = c.particles.ids;
  playback.cell = cell_of(c.setting);
  for (std::size_t d = 0; d < 3; ++d) playback.cell.from[d] -= playback.origin[d];
  playback.bodies = c.particles.bodies.of_particle;
  if (const auto& friction = c.setting.laws.friction)
    playback.friction_coefficient = friction->coefficient;
  for (const auto& hinge : c.setting.links.hinges)
    playback.links.hinges.push_back(hinge.at - playback.origin);
  for (const auto& spring : c.setting.links.springs)
    playback.links.springs.push_back({spring.first, spring.second});
  for (const auto& arm : c.setting.links.arms)
    playback.links.arms.push_back({arm.first, arm.second});
  // Lines between neighbouring beads of a membrane are drawn as those of arms.
  for (const auto& membrane : membranes_of(c.setting))
    for (std::int32_t k = 0; k < membrane.count(); ++k)
      playback.links.arms.push_back({membrane.bead(k), membrane.bead(k + 1)});
  return playback;
}

/// Whether there is a flow, in the plane of x and y.
bool flows_in_xy(const PairLubrication& pairs) {
  const auto& g = pairs.gradient;
  double beside = std::abs(g[2][2]), within = 0;
  for (std::size_t d = 0; d < 2; ++d) {
    beside += std::abs(g[d][2]) + std::abs(g[2][d]);
    within += std::abs(g[d][0]) + std::abs(g[d][1]);
  }
  return beside == 0 && (within > 0 || pairs.stress || pairs.wave || !pairs.pieces.empty());
}

/// Shows a flow in the plane of x and y with y upwards. Frames of a box that is sheared across y
/// get Frame::offset in place of Frame::periods.
void set_view_of_flow(const ParticlesCase& c, Playback& playback) {
  if (flows_in_xy(*c.setting.lubrication)) playback.up = 1;
  const auto& lengths = playback.cell.lengths;
  for (auto& frame : playback.frames) {
    if (!frame.periods) continue;
    auto unsheared = *frame.periods;
    const double offset = std::exchange(unsheared[1][0], 0);
    if (unsheared !=
        std::array{Vector{lengths[0], 0, 0}, Vector{0, lengths[1], 0}, Vector{0, 0, lengths[2]}})
      continue;
    frame.offset = offset;
    frame.periods.reset();
  }
}

/// A frame without the flow, whose places are relative to `origin` [L]. Throws Error(kBadInput) if
/// the file has fewer particles than the case, or more although the case has no sources.
Frame read_frame(double time, const fs::path& path, const ParticlesCase& c,
                 std::span<const PlaneMotion> motions, const Vector& origin) {
  auto content = read_vtp(path, c.particles.dimension);
  if (content.positions.size() < c.particles.positions.size() ||
      (content.positions.size() > c.particles.positions.size() && c.setting.sources.empty()))
    throw_bad_input({path.string()}, "is a frame of other particles");
  Frame frame;
  frame.time = time;
  const auto dimension = static_cast<std::size_t>(c.particles.dimension);
  for (std::size_t i = 0; i < content.positions.size(); ++i) {
    const double x = content.positions[i], from = origin[i % dimension];
    frame.positions.push_back(static_cast<float>(from == 0 ? x : x - from));
  }
  frame.angles.assign(content.angles.begin(), content.angles.end());
  frame.speeds.assign(content.speeds.begin(), content.speeds.end());
  frame.orientations.assign(content.orientations.begin(), content.orientations.end());
  frame.planes = positions_of(obstacles_of(c.setting, motions), time);
  if (origin != Vector{})
    for (auto& plane : frame.planes) plane.point = plane.point - origin;
  frame.contacts = std::move(content.contacts);
  frame.periods = content.periods;
  return frame;
}

/// The motions at the times of all frames, from planes.csv; empty if no plane has a load. Throws
/// Error(kBadInput) if the file does not have a row for each plane and frame.
std::vector<std::vector<PlaneMotion>> read_plane_motions(const ParticlesCase& c,
                                                         const fs::path& folder,
                                                         std::size_t frames) {
  std::vector<std::vector<PlaneMotion>> motions(frames);
  std::vector<std::size_t> loaded;
  for (std::size_t k = 0; k < c.setting.planes.size(); ++k)
    if (c.setting.planes[k].load) loaded.push_back(k);
  if (loaded.empty()) return motions;
  const auto path = folder / kPlanesFile;
  const auto rows = read_csv<1>(path, {"displacement"}, 1).rows;
  if (rows.size() != frames * loaded.size())
    throw_bad_input({path.string()}, "has {} rows; it must have one for each plane and frame, {}",
                    rows.size(), frames * loaded.size());
  for (std::size_t f = 0; f < frames; ++f) {
    motions[f].resize(c.setting.planes.size());
    for (std::size_t l = 0; l < loaded.size(); ++l)
      motions[f][loaded[l]].displacement = rows[f * loaded.size() + l].fields[0].value_or(0);
  }
  return motions;
}

/// Whenever the frames in memory take more than kMostBytes, every second frame is left out; the
/// last frame is always kept. Throws Error(kBadInput) if there is no frame, or for a frame that is
/// missing, damaged or of other particles.
Playback read_playback(const ParticlesCase& c, const fs::path& folder) {
  auto playback = without_frames(c);
  auto& frames = playback.frames;
  const auto files = read_pvd(folder / "particles.pvd");
  if (files.empty()) throw_bad_input({(folder / "particles.pvd").string()}, "has no frame");
  if (!c.setting.sources.empty()) {
    // The last frame has all particles that sources have added.
    const auto last = read_vtp(folder / files.back().second, c.particles.dimension);
    playback.radii.assign(last.radii.begin(), last.radii.end());
    playback.masses.assign(last.masses.begin(), last.masses.end());
    if (!playback.ids.empty()) playback.ids = last.ids;
    if (!playback.bodies.empty()) playback.bodies.resize(last.radii.size(), -1);
    for (auto k = playback.shapes.size(); k > 0 && k < last.radii.size(); ++k)
      playback.shapes.push_back(Shape::disc(last.radii[k]));
  }
  // A page of 24 MB cannot show as much as kMostBytes.
  const auto motions = read_plane_motions(c, folder, files.size());
  constexpr std::size_t kMostBytes = std::size_t{256} << 20U;
  std::size_t every = 1, kept_bytes = 0;
  for (std::size_t f = 0; f < files.size(); ++f) {
    if (kept_bytes > kMostBytes && frames.size() > 4) {
      for (std::size_t i = 1; 2 * i < frames.size(); ++i) frames[i] = std::move(frames[2 * i]);
      frames.resize((frames.size() + 1) / 2);
      kept_bytes /= 2;
      every *= 2;
    }
    if (f % every != 0 && f + 1 != files.size()) continue;
    frames.push_back(
        read_frame(files[f].first, folder / files[f].second, c, motions[f], playback.origin));
    const auto& kept = frames.back();
    kept_bytes += (kept.positions.size() + kept.speeds.size() + kept.angles.size() +
                   kept.orientations.size()) *
                      sizeof(float) +
                  kept.planes.size() * sizeof(PlanePosition) +
                  kept.contacts.size() * sizeof(CurrentContact);
  }
  // Particles that a source has not added yet get the position NaN, and are not drawn.
  for (auto& frame : frames) {
    const auto count = playback.radii.size();
    frame.positions.resize(count * static_cast<std::size_t>(playback.dimension),
                           std::numeric_limits<float>::quiet_NaN());
    if (!frames.back().angles.empty()) frame.angles.resize(count);
    frame.speeds.resize(count);
    while (frame.orientations.size() < frames.back().orientations.size())
      frame.orientations.insert(frame.orientations.end(), {1, 0, 0, 0});
  }
  if (c.setting.fluid)
    for (const auto& [time, file] : read_pvd(folder / "flow.pvd"))
      if (const auto frame = std::ranges::find(frames, time, &Frame::time); frame != frames.end())
        frame->flow = folder / file;
  return playback;
}

/// The curves of the run in `folder`, whose frames `playback` has, and of the run beside it that
/// `compared_folder()` names, if that exists. Throws Error(kBadInput) if a file cannot be read.
SuspensionCurves read_curves(const ParticlesCase& c, const fs::path& folder, Playback& playback) {
  SuspensionCurves curves;
  curves.rheology = read_rheology(folder / kRheologyFile);
  set_view_of_flow(c, playback);
  curves.pairs = pair_distribution(c, playback);
  const auto beside = compared_folder(folder);
  if (!c.compares || !fs::is_regular_file(beside / kRheologyFile)) return curves;
  const auto compared = compared_case(c);
  auto other = read_playback(compared, beside);
  curves.compared = read_rheology(beside / kRheologyFile);
  set_view_of_flow(compared, other);
  curves.compared_pairs = pair_distribution(compared, other);
  return curves;
}

/// The numbers in run.json; unknown ones if the file is missing, as after an interrupted run, or
/// lacks them.
ParticleRegime regime_in(const fs::path& folder) {
  ParticleRegime regime;
  if (!fs::is_regular_file(folder / "run.json")) return regime;
  const auto json = nlohmann::json::parse(read_file(folder / "run.json"), nullptr, false);
  const auto read = [&](const char* key, double& number) {
    if (json.is_object() && json.contains(key) && json.at(key).is_number())
      number = json.at(key).get<double>();
  };
  read("reynolds_number", regime.reynolds);
  read("stokes_number", regime.stokes);
  read("film_stokes_number", regime.film);
  regime.has_contact = regime.film >= 0;
  return regime;
}

}  // namespace

fs::path compared_folder(const fs::path& folder) { return folder / "viscous_contact"; }

ParticlesCase compared_case(const ParticlesCase& c) {
  assert(c.setting.lubrication);
  auto compared = c;
  compared.compares = false;
  auto& pairs = *compared.setting.lubrication;
  pairs.pairs = PairTerms::kNone;
  pairs.regularisation = 0;
  set_film_of_pairs(compared);
  return compared;
}

void write_pages(const ParticlesCase& c, const fs::path& folder,
                 const results::Provenance& provenance, const ParticleRegime& regime) {
  constexpr int kPanels = 4;  // number of times that the still picture shows
  auto playback = read_playback(c, folder);
  if (c.setting.lubrication) {
    const auto curves = read_curves(c, folder, playback);
    playback.charts = suspension_charts(c, curves);
    if (playback.charts.empty())
      fs::remove(folder / "rheology.svg");
    else
      results::write_output(folder / "rheology.svg", TextKind::kSvg, playback.charts, provenance);
    results::write_output(folder / "pair_distribution.csv", TextKind::kHashComment,
                          write_pair_distribution(curves.pairs), provenance);
  }
  playback.note = in_words(regime);
  if (const auto& x = playback.origin; x != Vector{})
    playback.note += fmt::format(". Places are relative to ({}, {}{})", x[0], x[1],
                                 c.particles.dimension == 3 ? fmt::format(", {}", x[2]) : "");
  for (const auto& warning : warnings_of(c, regime)) playback.note += ". Warning: " + warning;
  if (!std::ranges::all_of(playback.radii, [](float radius) { return std::isnormal(radius); }))
    terminal::warn(
        "particles: warning: particles.html and particles.svg show nothing, because a radius is "
        "not between 1e-37 and 3e38, the lengths that they can draw; choose another unit of "
        "length");
  FlowFrames flows;
  results::write_output(folder / "particles.html", TextKind::kHtml,
                        particles_page(playback, c.title, &flows), provenance);
  report::remove_pdf_of(folder / "particles.svg");
  results::write_output(folder / "particles.svg", TextKind::kSvg,
                        particles_picture(playback, c.title, kPanels, &flows), provenance);
}

void report_particles(const fs::path& folder) {
  for (const auto* name :
       {"particles.html", "particles.svg", "rheology.svg", "pair_distribution.csv"})
    results::refuse_other_kind(folder / name, "", "result");
  auto files = results::given_inputs(folder / "particles.pvd");
  const auto c = read_particles_case(files.front());
  files.push_back(folder / "particles.pvd");
  if (c.setting.fluid) files.push_back(folder / "flow.pvd");
  write_pages(c, folder, results::provenance_of({files, {}}), regime_in(folder));
  terminal::say("report: {0}/particles.html, {0}/particles.svg", folder.string());
}

}  // namespace viscontact::particles
