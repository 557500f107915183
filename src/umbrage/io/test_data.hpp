#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/test_data.hpp"
#include "umbrage/mesh/mesh_report.hpp"
#include "umbrage/mesh/weld.hpp"
#include "umbrage/scene/scene.hpp"

// What the tests of io share.
namespace umbrage::io::test {

/// The collection of real and hostile files, or an empty path.
using support::testData;

/// A folder of its own that goes with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "umbrage-io-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// All instances in the world, identical points (in the precision of V) made one: what the topology of a whole file is.
template <class V>
mesh::MeshReport wholeReport(const scene::Scene& scene) {
  std::vector<V> points;
  std::vector<mesh::Triangle> triangles;
  for (const scene::Instance& i : scene.instances) {
    const auto base = static_cast<std::uint32_t>(points.size());
    const mesh::Mesh& m = *scene.meshes[i.mesh];
    for (const Vec3& p : m.positions) points.push_back(V(transformPoint(i.toWorld, p)));
    for (const mesh::Triangle& t : m.triangles) triangles.push_back({base + t[0], base + t[1], base + t[2]});
  }
  const mesh::Weld weld = mesh::weld(points);
  std::vector<mesh::Triangle> proper;
  for (mesh::Triangle t : triangles) {
    for (std::uint32_t& corner : t) corner = weld.remap[corner];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) proper.push_back(t);
  }
  return mesh::inspect(proper, mesh::buildEdgeTable(proper));
}

}  // namespace umbrage::io::test
