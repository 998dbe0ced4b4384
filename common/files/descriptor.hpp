// A file descriptor (POSIX) that is closed when its object is destroyed, and a write to it.
// common/files/, common/system/ and freefem_axi/journal/ use it for files, locks and child
// processes. Nothing is thrown: the code that opens a file checks its descriptor. Further calls of
// the system may be added; a change must keep that no descriptor is closed twice.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <utility>

namespace viscontact {

/// Owns a file descriptor: one object at a time holds it, and closes it.
class Descriptor {
 public:
  /// Takes over an open descriptor, which must have no other owner (not checked). A negative number
  /// means that the object has no descriptor.
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

  int get() const { return descriptor_; }  ///< the number, >= 0; negative: none, as after close()
  /// Closes the descriptor, if there is one. Errors of closing are not reported.
  void close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  }

 private:
  int descriptor_;
};

/// Writes all bytes of `text` at the current position of an open file. Returns false if that fails,
/// with the reason in errno (EBADF if `file` has no descriptor); a part of the text may then have
/// been written.
inline bool write_all(const Descriptor& file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file.get(), text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  }
  return true;
}

}  // namespace viscontact
