// Frames for ParaView.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "particles/contacts_now.hpp"

namespace viscontact::particles {

/// A VTK XML PolyData file (VTK's file formats, "XML file formats"; appended raw data): a point for each particle, with radius, velocity and id; a line for each
/// contact of two particles and a vertex at the particle for each with a plane, with gap, gamma and the ids of both (a plane's is -1, -2, ...).
/// 2D: z = 0.
std::string write_vtp(const Particles& particles, std::span<const ContactNow> contacts);

/// The collection that ParaView opens: a file for each time.
std::string write_pvd(std::span<const std::pair<double, std::string>> files);

}  // namespace viscontact::particles
