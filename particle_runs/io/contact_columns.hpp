// The columns of contacts: final_contacts.csv, contacts.csv, the lines and vertices of the frames,
// the group `contacts` of particles.h5, and contacts() of Python.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "viscontact/particle_runs/io/columns.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {

struct ContactRow {
  const Particles& particles;
  const CurrentContact& contact;
  double time = 0;  ///< [T], in tables over time only
};

struct ContactColumn : Column<ContactRow> {
  /// Sets the member of a contact from the entries that a frame has. False: there is no such value.
  /// Null for values that follow from other ones.
  bool (*set)(CurrentContact&, std::span<const double>) = nullptr;
};

const std::vector<ContactColumn>& contact_columns();

/// Frames have these arrays of contacts before the others.
inline constexpr std::array<std::string_view, 2> kFirstOfContactFrames = {"gap", "gamma"};

/// The columns of contacts in docs/file-formats.md.
ColumnTable contact_column_table();

}  // namespace viscontact::particles
