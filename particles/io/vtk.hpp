// Frames for ParaView.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {

/// A VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data): a point for each particle, with radius, velocity and id; a line for each
/// contact of two particles and a vertex at the particle for each with a plane, with gap, gamma and
/// the ids of both (a plane's is -1, -2, ...).
/// 2D: z = 0.
std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts);

/// What a frame shows, as read back from its file.
struct VtpContent {
  std::vector<double> positions;         ///< flat [L], the numbers of `dimension` for each particle
  std::vector<CurrentContact> contacts;  ///< in the order of contacts_of: pairs, then walls
};

/// Reads a file that write_vtp wrote on a machine with the same order of bytes. Throws
/// Error(kBadInput) naming the file if it is not such a file or was cut short.
VtpContent read_vtp(const std::filesystem::path& path, int dimension);

/// The collection that ParaView opens: a file for each time.
std::string write_pvd(std::span<const std::pair<double, std::string>> files);

/// The times and files in a collection that write_pvd wrote. Throws Error(kBadInput) naming the file
/// if it is not such a file.
std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path);

}  // namespace viscontact::particles
