// A file descriptor (POSIX) that is closed when its object is destroyed. common/files/,
// common/system/ and freefem_axi/journal/ use it for files, locks and child processes. Nothing is
// thrown: the code that opens a file checks its descriptor. A change must keep that no descriptor
// is closed twice.
#pragma once

#include <unistd.h>

#include <utility>

namespace viscontact {

/// Owns a file descriptor: one object at a time holds it, and closes it.
class Descriptor {
 public:
  /// Takes over an open descriptor; -1: none.
  explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  /// Takes over the descriptor of `other`, which has none afterwards.
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  /// Exchanges the descriptors of both objects; `other` closes the one that it receives when it is
  /// destroyed.
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~Descriptor() { close(); }

  int get() const { return descriptor_; }  ///< -1 after close()
  /// Closes the descriptor, if there is one. Errors of closing are not reported.
  void close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  }

 private:
  int descriptor_;
};

}  // namespace viscontact
