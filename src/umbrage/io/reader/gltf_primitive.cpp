#include "umbrage/io/reader/gltf_primitive.hpp"

#include "umbrage/io/reader/gltf_accessor.hpp"

namespace umbrage::io::reader {
namespace {

void addStrip(const std::vector<std::uint32_t>& v, std::vector<mesh::Triangle>& out) {
  for (std::size_t i = 0; i + 2 < v.size(); ++i) out.push_back({v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]});
}
void addFan(const std::vector<std::uint32_t>& v, std::vector<mesh::Triangle>& out) {
  for (std::size_t i = 1; i + 1 < v.size(); ++i) out.push_back({v[i], v[i + 1], v[0]});
}
void addList(const std::vector<std::uint32_t>& v, std::vector<mesh::Triangle>& out) {
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) out.push_back({v[i], v[i + 1], v[i + 2]});
}

std::vector<mesh::Triangle> assemble(int mode, const std::vector<std::uint32_t>& corners) {
  std::vector<mesh::Triangle> triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES || mode < 0) addList(corners, triangles);
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) addStrip(corners, triangles);
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) addFan(corners, triangles);
  return triangles;
}

bool isCompressed(const tinygltf::Model& model, const tinygltf::Primitive& primitive, int position) {
  return primitive.extensions.contains(kDraco) && position >= 0 &&
         static_cast<std::size_t>(position) < model.accessors.size() &&
         model.accessors[static_cast<std::size_t>(position)].bufferView < 0;
}

}  // namespace

Result<std::optional<PrimitiveTriangles>> readPrimitive(const tinygltf::Model& model,
                                                        const tinygltf::Primitive& primitive) {
  PrimitiveTriangles out;
  if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) return out;  // they cast no shadow
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return std::nullopt;
  if (isCompressed(model, primitive, position->second))
    return fail(ErrorCode::unsupported, std::string("needs the glTF extension ") + kDraco, "primitive");
  auto points = readPoints(model, position->second);
  if (!points) return tl::unexpected(points.error());
  out.points = std::move(*points);
  std::vector<std::uint32_t> corners;
  if (primitive.indices >= 0) {
    auto given = readIndices(model, primitive.indices);
    if (!given) return tl::unexpected(given.error());
    corners = std::move(*given);
  } else {
    for (std::uint32_t i = 0; i < out.points.size(); ++i) corners.push_back(i);
  }
  out.triangles = assemble(primitive.mode, corners);
  return out;
}

}  // namespace umbrage::io::reader
