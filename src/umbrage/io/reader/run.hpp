#pragma once

#include "umbrage/io/reader/read.hpp"

namespace umbrage::io::reader {

using ReadFunction = Result<scene::Scene> (*)(const Request& request);

/// The whole of a reader program: confines itself, reads what its arguments name, hands it over and ends the process.
/// Returns only when it was not started by the library.
[[nodiscard]] int runReader(int argc, char** argv, ReadFunction read);

}  // namespace umbrage::io::reader
