// Frames as VTK files: particles are points, contacts are cells. vtk_reader.cpp and
// run/hdf5_file.cpp read these files.
#include "viscontact/particle_runs/io/vtk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "viscontact/common/text/number.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/particle_runs/io/contact_columns.hpp"

namespace viscontact::particles {
namespace {

/// Adds the three components of a vector, which is along z in a case on an axis.
void append(std::vector<double>& values, const Vector& x, int dimension) {
  if (dimension == 1)
    values.insert(values.end(), {0, 0, x[0]});
  else
    values.insert(values.end(), x.begin(), x.end());
}

/// The array of a column in the rows of a frame.
template <class Row, class Rows>
std::string array_of(const Column<Row>& column, const Rows& rows, int dimension) {
  const auto components = static_cast<int>(column.count_in_frames(dimension));
  return column.is_whole()
             ? vtk_array(column.name, components,
                         values_of<std::int32_t>(column, rows, dimension, true))
             : vtk_array(column.name, components, values_of<double>(column, rows, dimension, true));
}

/// The cells of a frame: a vertex for each contact with an obstacle, then a line for each other
/// contact. Cells have the numbers of particles, and rows their ids.
struct ContactCells {
  PolyCells cells;
  std::vector<ContactRow> rows;

  ContactCells(const Particles& particles, std::span<const CurrentContact> contacts) {
    rows.reserve(contacts.size());
    for (const bool wall : {true, false})
      for (const auto& contact : contacts)
        if ((contact.first < 0) == wall) add(particles, contact);
  }

 private:
  void add(const Particles& particles, const CurrentContact& contact) {
    assert(contact.second >= 0 && index_of(contact.second) < particles.count());
    if (contact.first < 0)
      cells.add_vertex(contact.second);
    else
      cells.add_line(contact.first, contact.second);
    rows.push_back({particles, contact});
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
  RunFacts run;
  run.dimension = particles.dimension;
  run.has_friction = has_friction;
  run.is_periodic = particles.cell.is_periodic();
  for (const auto* column :
       columns_in(Output::kFrames, contact_columns(), run, kFirstOfContactFrames))
    text += array_of(*column, listed.rows, particles.dimension);
  text += "</CellData>\n" + listed.cells.closing(points);
  text += kVtkClosing;
  return text;
}

std::string pvd_line(double time, const std::string& file) {
  return fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                     format_number(time), file);
}

}  // namespace viscontact::particles
