// Writes and reads frames, the states of a simulation at the output times, as VTK files for
// ParaView. Lengths, masses and times are in the units of the case. Writing throws nothing. run/
// uses it: a run that continues, and pages, read the frames of a run again. A change must keep the
// names of the arrays, and that read_vtp() and read_pvd() can read all files that were written
// before.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"

namespace viscontact::particles {

/// Content of a VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data).
/// Each particle is a point with the arrays radius, velocity, id and, if a particle has a mass,
/// mass. Particles that turn also have an angle or, in space, an orientation (w, x, y, z), and an
/// angular_velocity. If there are rigid bodies, body is the number of the body of each particle, or
/// -1. In two dimensions z = 0; spheres on an axis are on the axis z. Each contact of two particles
/// is a line, and each contact with an obstacle a vertex at the particle. Both have gap, gamma,
/// normal_force, the ids i and j of ids_of() and, in a periodic domain, image, that of the second
/// particle. With `has_friction` they also have friction (0: none, 1: sticks, 2: slides) and
/// tangential_force. Units are those of Particles and CurrentContact.
std::string write_vtp(const Particles& particles, std::span<const CurrentContact> contacts,
                      bool has_friction = false);

/// What read_vtp() reads from the file of a frame.
struct VtpContent {
  /// Flat array [L], `dimension` numbers for each particle.
  std::vector<double> positions;
  std::vector<double> radii;      ///< of each particle [L]
  std::vector<double> masses;     ///< of each particle [M]; empty if the file has none
  std::vector<double> speeds;     ///< of each particle [L/T], >= 0
  std::vector<std::int32_t> ids;  ///< of each particle; empty if the file has none
  // Counter-clockwise; empty for discs that do not turn, and for spheres.
  std::vector<double> angles,  ///< of each disc [rad]
      angular_velocities;      ///< of each disc [1/T]
  /// Unit quaternions (w, x, y, z) of spheres in space; empty if they do not turn.
  std::vector<double> orientations;
  /// In the order of contacts_of(): first pairs of particles, then particles at obstacles; with the
  /// numbers of particles in `radii`, not their ids; empty if there are none. Errors of gamma,
  /// normals and branches are not in the file and keep their defaults.
  std::vector<CurrentContact> contacts;
};

/// Reads a file that write_vtp() wrote for particles of this dimension on a machine with the same
/// byte order. Throws Error(kBadInput), which names the file, if it cannot be read, is not such a
/// file or was cut short.
VtpContent read_vtp(const std::filesystem::path& path, int dimension);

/// The beginning of a PVD file, a list of frames for ParaView: this, their pvd_line(), and
/// kPvdFoot.
inline constexpr const char* kPvdHead =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
    "byte_order=\"LittleEndian\">\n<Collection>\n";
/// The end of a PVD file.
inline constexpr const char* kPvdFoot = "</Collection>\n</VTKFile>\n";
std::string pvd_line(double time, const std::string& file);  ///< the line of a frame at `time` [T]

/// Times [T] and names of the files of all frames in a PVD file of this form. Throws
/// Error(kBadInput), which names the file, if it cannot be read or is not such a file.
std::vector<std::pair<double, std::string>> read_pvd(const std::filesystem::path& path);

}  // namespace viscontact::particles
