#pragma once

#include <cstddef>

namespace umbrage::io::reader {

struct Limits {
  std::size_t memory = 0;    ///< bytes of address space
  std::size_t fileSize = 0;  ///< bytes of any file written, that is of the hand-over
  std::size_t cpuSeconds = 0;
};

/// Binds this process, for good, to the limits, to the life of its parent, and to reading: afterwards it can create, change or
/// remove no file, start no program and open no connection. What the system does not know how to forbid is left out.
void confine(const Limits& limits);

}  // namespace umbrage::io::reader
