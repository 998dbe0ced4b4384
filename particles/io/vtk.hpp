// Frames of a simulation as VTK files for ParaView. Lengths, masses and times are in the units of
// the case. A run that continues, and pages, read the frames of a run again, so that a change must
// keep the names of the arrays. Used by vtk_reader.cpp and run/.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data).
/// Each particle is a point with radius, velocity, id and, if a particle has one, mass. Each
/// contact of two particles is a line, and each contact with an obstacle a vertex at the particle;
/// both have gap, gamma and the ids of both bodies (-1, -2, ... for obstacles), the normal force,
/// and in a periodic domain the image of the second particle. In two dimensions z = 0. The spheres
/// of dimension 1 are on the axis z. Particles that turn also have an angle or, in space, an
/// orientation (w, x, y, z), and an angular velocity; if there are rigid bodies, each point has the
/// number of its body or -1. With `has_friction` contacts have friction: 0 none, 1 sticks, 2
/// slides, and the tangential force.
std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts,
                      bool has_friction = false);

/// What read_vtp reads from the file of a frame.
struct VtpContent {
  /// Flat array [L], `dimension` numbers for each particle.
  std::vector<double> positions;
  std::vector<double> radii;      ///< of each particle [L]
  std::vector<double> masses;     ///< of each particle [M]; empty if all are 0
  std::vector<double> speeds;     ///< of each particle [L/T]
  std::vector<std::int32_t> ids;  ///< of each particle
  // Of discs, counter-clockwise; empty if they do not turn, and of spheres.
  std::vector<double> angles,  ///< of each disc [rad]
      angular_velocities;      ///< of each disc [1/T]
  /// Unit quaternions (w, x, y, z) of spheres in space; empty if they do not turn.
  std::vector<double> orientations;
  /// In the order of contacts_of: first pairs of particles, then particles at obstacles.
  std::vector<CurrentContact> contacts;
};

/// Reads a file that write_vtp wrote on a machine with the same byte order. Throws
/// Error(kBadInput), which names the file, if it is not such a file or was cut short.
VtpContent read_vtp(const std::filesystem::path& path, int dimension);

/// A PVD file, which ParaView opens: kPvdHead, a line for each frame with its time [T] and its
/// file, and kPvdFoot.
inline constexpr const char* kPvdHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
    "byte_order=\"LittleEndian\">\n<Collection>\n";
/// The end of a PVD file.
inline constexpr const char* kPvdFoot = "</Collection>\n</VTKFile>\n";
std::string pvd_line(double time, const std::string& file);  ///< the line of a frame

/// Times and files from a PVD file of this form. Throws Error(kBadInput), which names the file, if
/// it is not such a file.
std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path);

}  // namespace viscontact::particles
