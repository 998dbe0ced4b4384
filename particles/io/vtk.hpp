// Frames of a simulation as VTK files for ParaView. Lengths, masses and times are in the units of
// the case.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/contact/current_contacts.hpp"

namespace viscontact::particles {

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data).
/// Each particle is a point with radius, velocity and id. Each contact of two particles is a line,
/// and each contact with an obstacle a vertex at the particle; both have gap, gamma and the ids of
/// both bodies (-1, -2, ... for obstacles), and in a periodic domain the image of the second
/// particle. In two dimensions z = 0. The spheres of dimension 1 are on the axis z. In a fluid the
/// points also have angle and angular velocity.
std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts);

/// What read_vtp reads from the file of a frame.
struct VtpContent {
  /// Flat array [L], `dimension` numbers for each particle.
  std::vector<double> positions;
  /// Of each particle, counter-clockwise [rad], [1/T]; empty without a fluid.
  std::vector<double> angles, angular_velocities;
  /// In the order of contacts_of: first pairs of particles, then particles at obstacles.
  std::vector<CurrentContact> contacts;
};

/// Reads a file that write_vtp wrote on a machine with the same byte order. Throws
/// Error(kBadInput), which names the file, if it is not such a file or was cut short.
VtpContent read_vtp(const std::filesystem::path& path, int dimension);

/// Content of a PVD file, which lists the time and the file of each frame; ParaView opens it.
std::string write_pvd(std::span<const std::pair<double, std::string>> files);

/// Times and files from a PVD file that write_pvd wrote. Throws Error(kBadInput), which names the
/// file, if it is not such a file.
std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path);

}  // namespace viscontact::particles
