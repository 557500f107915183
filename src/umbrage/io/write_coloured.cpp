#include "umbrage/io/write_coloured.hpp"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "umbrage/base/check.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/io/writer/common.hpp"
#include "umbrage/io/writer/glb_file.hpp"

namespace umbrage::io {
namespace {

static_assert(std::endian::native == std::endian::little, "both formats store numbers with the least byte first");

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertices = 34962, kIndices = 34963;

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A column of a .glb file's numbers.
template <class T>
Json& addAccessor(Json& json, std::string& binary, const std::vector<T>& values, int target, Json accessor) {
  accessor["bufferView"] = json["bufferViews"].size();
  json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}, {"target", target}});
  binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  return json["accessors"].emplace_back(std::move(accessor));
}

Json vectors(std::size_t count) { return {{"componentType", kFloat}, {"count", count}, {"type", "VEC3"}}; }

Result<std::string> glb(const ColouredMesh& mesh, const Mat4& turn) {
  Box3 box;
  for (const Vec3& p : mesh.positions) box.add(p);
  // A whole number keeps the translation exact.
  const Vec3 middle = glm::round(box.centre());
  Box3 stored;
  std::vector<Vec3f> positions;
  for (const Vec3& p : mesh.positions) stored.add(Vec3(positions.emplace_back(p - middle)));
  Json json;
  json["asset"] = {{"version", "2.0"}, {"generator", "umbrage"}};
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  Mat4 placed = turn;
  placed[3] = turn * Vec4(middle, 1.0);
  Json matrix = Json::array();
  for (int i = 0; i < 16; ++i) matrix.push_back(placed[i / 4][i % 4] + 0.0);
  json["nodes"] = {{{"name", "light"}, {"matrix", matrix}}};
  if (mesh.triangles.empty()) return writer::glbFile(json.dump(), {});
  std::string binary;
  const std::size_t count = positions.size();
  Json& first = addAccessor(json, binary, positions, kVertices, vectors(count));
  first["min"] = {stored.min.x, stored.min.y, stored.min.z};
  first["max"] = {stored.max.x, stored.max.y, stored.max.z};
  addAccessor(json, binary, mesh.colours, kVertices, vectors(count));
  addAccessor(json, binary, mesh.exitance, kVertices, vectors(count));
  addAccessor(json, binary, mesh.triangles, kIndices,
              {{"componentType", kUnsignedInt}, {"count", 3 * mesh.triangles.size()}, {"type", "SCALAR"}});
  json["nodes"][0]["mesh"] = 0;
  Json primitive;
  primitive["attributes"] = {{"POSITION", 0}, {"COLOR_0", 1}, {"_EXITANCE", 2}};
  primitive["indices"] = 3;
  primitive["material"] = 0;
  json["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
  json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                                    {"extensions", {{"KHR_materials_unlit", Json::object()}}}}});
  json["extensionsUsed"] = {"KHR_materials_unlit"};
  json["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  return writer::glbFile(json.dump(), std::move(binary));
}

Result<std::string> ply(const ColouredMesh& mesh, const Mat4& turn) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment metres, Y up\nelement vertex " +
                      std::to_string(mesh.positions.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "property float exitance_red\nproperty float exitance_green\nproperty float exitance_blue\n"
                      "element face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = transformPoint(turn, mesh.positions[i]), srgb = writer::srgbFromLinear(Vec3(mesh.colours[i]));
    for (int k = 0; k < 3; ++k) append(bytes, p[k]);
    for (int k = 0; k < 3; ++k) append(bytes, static_cast<std::uint8_t>(std::lround(255.0 * srgb[k])));
    for (int k = 0; k < 3; ++k) append(bytes, mesh.exitance[i][k]);
  }
  for (const mesh::Triangle& t : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : t) append(bytes, corner);
  }
  return bytes;
}

}  // namespace

Result<void> writeColoured(const ColouredMesh& mesh, const scene::Scene& frame, const std::filesystem::path& path) {
  UMBRAGE_CHECK(mesh.colours.size() == mesh.positions.size() && mesh.exitance.size() == mesh.positions.size(),
                "one colour a position");
  const Mat4 turn = writer::toMetres(frame, scene::UpAxis::y);
  const std::string extension = lowerExtension(path);
  if (extension != ".glb" && extension != ".ply")
    return fail(ErrorCode::usage, "the file name must end with .glb or .ply", path.string());
  const auto bytes = extension == ".glb" ? glb(mesh, turn) : ply(mesh, turn);
  if (!bytes) return fail(bytes.error().code, bytes.error().message, path.string());
  return writeFile(path, *bytes);
}

}  // namespace umbrage::io
