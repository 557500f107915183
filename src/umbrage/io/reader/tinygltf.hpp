#pragma once

// tinygltf without its picture decoders: of pictures only alpha matters here (gltf_textures.hpp), and the less code meets a hostile file the better. It is
// compiled into the reader (tinygltf_implementation.cpp) because Debian's shared library is built with decoders, which every
// class of the header then refers to. Include this, never tiny_gltf.h itself.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

namespace umbrage::io::reader {

/// With "%20" and the like as what they stand for.
[[nodiscard]] std::string decodedUri(const std::string& uri);

}  // namespace umbrage::io::reader
