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
#include "viscontact/particle_runs/io/particle_columns.hpp"

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

/// `first` are columns that stand before the others.
template <class AnyColumn, class Rows>
std::string arrays_of(const std::vector<AnyColumn>& columns, const Rows& rows, const RunFacts& run,
                      std::span<const std::string_view> first) {
  std::string text;
  for (const auto* column : columns_in(Output::kFrames, columns, run, first))
    text += array_of(*column, rows, run.dimension);
  return text;
}

/// VTK takes the number of rows of field data from the element itself.
std::string periods_as_field(const std::array<Vector, 3>& periods) {
  std::vector<double> numbers;
  for (const auto& period : periods) numbers.insert(numbers.end(), period.begin(), period.end());
  auto element = vtk_array("periods", 3, numbers);
  element.insert(element.find("format="), "NumberOfTuples=\"3\" ");
  return "<FieldData>\n" + element + "</FieldData>\n";
}

}  // namespace

std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts,
                      bool has_friction) {
  std::vector<double> points;
  for (std::size_t k = 0; k < particles.count(); ++k)
    append(points, particles.position(k), particles.dimension);
  const ContactCells listed(particles, contacts);
  std::string text = vtk_opening("PolyData");
  auto opening = listed.cells.opening(particles.count());
  if (const auto& cell = particles.cell; cell.vectors || cell.offset)
    opening.insert(opening.find("<Piece"), periods_as_field({shift_of(cell, Periods{1, 0, 0}),
                                                             shift_of(cell, Periods{0, 1, 0}),
                                                             shift_of(cell, Periods{0, 0, 1})}));
  text += opening;
  auto run = facts_of(particles);
  run.has_friction = has_friction;
  text += "<PointData Scalars=\"radius\" Vectors=\"velocity\">\n";
  text += arrays_of(particle_columns(), rows_of(particles, 0, nullptr, {}), run,
                    kFirstOfParticleFrames);
  text += "</PointData>\n<CellData Scalars=\"gamma\">\n";
  text += arrays_of(contact_columns(), listed.rows, run, kFirstOfContactFrames);
  text += "</CellData>\n" + listed.cells.closing(points);
  text += kVtkClosing;
  return text;
}

std::string pvd_line(double time, const std::string& file) {
  return fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                     format_number(time), file);
}

}  // namespace viscontact::particles
