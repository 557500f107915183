#include <nlohmann/json.hpp>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#define TINYGLTF_IMPLEMENTATION
#include "umbrage/io/reader/tinygltf.hpp"
#pragma GCC diagnostic pop

namespace umbrage::io::reader {

std::string decodedUri(const std::string& uri) { return tinygltf::dlib::urldecode(uri); }

}  // namespace umbrage::io::reader
