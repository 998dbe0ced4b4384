// The frames of a simulation of many particles: files for ParaView, and what page and picture show.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/io/playback.hpp"
#include "viscontact/particles/simulation.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {

/// The times at which frames are due: multiples of an interval after the first time, each taken
/// after the first step that reaches it.
struct FrameTimes {
  double first = 0;     ///< [T]
  double interval = 0;  ///< [T], at least a time step
  double tiny = 0;      ///< times that differ by less are equal [T]

  /// When the frame after the one at `time` is due [T].
  double after(double time) const;
};

/// The name of a frame's file and its time [T].
using FrameFile = std::pair<double, std::string>;

/// Frames are written as they come, and kept to be drawn.
class ParticleFrames {
 public:
  /// `provenance` must outlive this object.
  ParticleFrames(std::filesystem::path folder, const Provenance& provenance,
                 const particles::Particles& particles);

  /// Writes a frame of the present state.
  void add(const particles::Simulation& simulation);

  /// Takes up the frames that an interrupted run has written, in place of writing them. Throws
  /// Error(kBadInput) naming the file if one cannot be read or is of other particles.
  void resume(const std::vector<FrameFile>& files, const particles::Setting& setting);

  /// The last state is always among the frames.
  void end(const particles::Simulation& simulation);

  const particles::Playback& playback() const { return playback_; }
  const std::vector<FrameFile>& files() const { return files_; }

 private:
  void keep(particles::Frame frame);

  std::filesystem::path folder_;
  const Provenance& provenance_;
  particles::Playback playback_;
  std::vector<FrameFile> files_;
  std::size_t every_ = 1, kept_bytes_ = 0;
};

/// The frames in particles.pvd, as write_pvd writes it, that belong to a run up to `time`: without
/// later ones, and without one that was written only because the run was interrupted at `time`.
/// Throws Error(kBadInput) naming the file if it cannot be read.
std::vector<FrameFile> frames_until(const std::filesystem::path& pvd, double time,
                                    const FrameTimes& times);

}  // namespace viscontact
