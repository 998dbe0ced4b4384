#include "viscontact/common/system/memory.hpp"

#include <malloc.h>

namespace viscontact {

void keep_freed_memory() {
  // Larger values of the first are not allowed. Above the second, freed memory is given back.
  constexpr int kLargestBlock = 32 << 20, kMost = 512 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestBlock);
  mallopt(M_TRIM_THRESHOLD, kMost);
}

}  // namespace viscontact
