// Frames as VTK files: particles are points, contacts are cells. vtk_reader.cpp and
// run/hdf5_file.cpp read these files.
#include "viscontact/particle_runs/io/vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"

namespace viscontact::particles {
namespace {

/// Adds the three components of a vector, which is along z in a case on an axis.
void append(std::vector<double>& values, const Vector& x, int dimension) {
  if (dimension == 1)
    values.insert(values.end(), {0, 0, x[0]});
  else
    values.insert(values.end(), x.begin(), x.end());
}

/// The cells of a frame: a vertex for each contact with an obstacle, then a line for each other
/// contact.
struct ContactCells {
  std::vector<double> gaps, gammas, normal_forces, tangential_forces, solid_forces;
  std::vector<std::int32_t> firsts, seconds, images, frictions;
  std::vector<ShownMemory> shown;
  PolyCells cells;

  ContactCells(const Particles& particles, std::span<const CurrentContact> contacts) {
    for (const bool wall : {true, false})
      for (const auto& contact : contacts)
        if ((contact.first < 0) == wall) add(particles, contact);
  }

  /// The number at index `place` of ShownMemory (pair_memory.hpp) of all cells.
  std::vector<double> memory(std::size_t place) const {
    std::vector<double> values;
    for (const auto& numbers : shown) values.push_back(std::span(numbers)[place]);
    return values;
  }

 private:
  /// `firsts` and `seconds` have the numbers of ids_of(), cells those of particles.
  void add(const Particles& particles, const CurrentContact& contact) {
    assert(contact.second >= 0 && index_of(contact.second) < particles.count());
    if (contact.first < 0)
      cells.add_vertex(contact.second);
    else
      cells.add_line(contact.first, contact.second);
    gaps.push_back(contact.gap);
    gammas.push_back(contact.gamma);
    normal_forces.push_back(contact.normal_force);
    append(tangential_forces, contact.tangential_force, particles.dimension);
    solid_forces.push_back(contact.solid_force);
    const auto [first, second] = ids_of(particles, contact);
    firsts.push_back(first);
    seconds.push_back(second);
    images.push_back(contact.image);
    frictions.push_back(static_cast<std::int32_t>(contact.friction));
    shown.push_back(contact.shown);
  }
};

std::string point_data(const Particles& particles) {
  std::vector<double> velocities;
  std::vector<std::int32_t> ids;
  for (std::size_t k = 0; k < particles.count(); ++k) {
    append(velocities, particles.velocity(k), particles.dimension);
    ids.push_back(particles.id(k));
  }
  std::string text = "<PointData Scalars=\"radius\" Vectors=\"velocity\">\n";
  text += vtk_array("radius", 1, particles.radii);
  text += vtk_array("velocity", 3, velocities);
  text += vtk_array("id", 1, ids);
  if (std::ranges::any_of(particles.masses, [](double mass) { return mass > 0; }))
    text += vtk_array("mass", 1, particles.masses);
  if (!particles.angles.empty()) {
    text += vtk_array("angle", 1, particles.angles);
    text += vtk_array("angular_velocity", 1, particles.angular_velocities);
  }
  if (!particles.orientations.empty()) {
    text += vtk_array("orientation", 4, particles.orientations);
    text += vtk_array("angular_velocity", 3, particles.angular_velocities);
  }
  if (!particles.bodies.empty()) text += vtk_array("body", 1, particles.bodies.of_particle);
  return text + "</PointData>\n";
}

}  // namespace

std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts,
                      bool has_friction) {
  std::vector<double> points;
  for (std::size_t k = 0; k < particles.count(); ++k)
    append(points, particles.position(k), particles.dimension);
  const ContactCells listed(particles, contacts);
  std::string text = vtk_opening("PolyData");
  text += listed.cells.opening(particles.count());
  text += point_data(particles);
  text += "<CellData Scalars=\"gamma\">\n";
  text += vtk_array("gap", 1, listed.gaps);
  text += vtk_array("gamma", 1, listed.gammas);
  text += vtk_array("i", 1, listed.firsts);
  text += vtk_array("j", 1, listed.seconds);
  if (particles.cell.is_periodic()) text += vtk_array("image", 1, listed.images);
  if (has_friction) text += vtk_array("friction", 1, listed.frictions);
  text += vtk_array("normal_force", 1, listed.normal_forces);
  if (has_friction) text += vtk_array("tangential_force", 3, listed.tangential_forces);
  std::size_t place = 0;
  for (const auto& field : kMemoryFields)
    if (field.is_shown) text += vtk_array(field.name, 1, listed.memory(place++));
  if (has_friction) text += vtk_array("solid_force", 1, listed.solid_forces);
  text += "</CellData>\n" + listed.cells.closing(points);
  text += kVtkClosing;
  return text;
}

std::string pvd_line(double time, const std::string& file) {
  return fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                     format_number(time), file);
}

}  // namespace viscontact::particles
