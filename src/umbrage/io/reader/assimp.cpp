// OBJ, PLY, STL, OFF, 3DS, IFC and X3D through assimp.
//
// What was found out about assimp 5.2 (Debian builds it in single precision) and is relied on here:
// - OBJ, PLY, STL, OFF and X3D keep the file's axes. 3DS and IFC are turned to Y up in the root node's transform; the turn is
//   taken back here, so that both are Z up like their files. IFC lengths come in metres whatever the file's unit is.
// - OBJ: each object and each group becomes a node of its own, named after it; a mesh inside it is a run of one material.
#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>

#include "umbrage/base/file.hpp"
#include "umbrage/io/reader/files.hpp"
#include "umbrage/io/reader/polygon.hpp"
#include "umbrage/io/reader/read.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

class FolderOnly : public Assimp::DefaultIOSystem {
 public:
  explicit FolderOnly(std::filesystem::path folder) : folder_(std::move(folder)) {}
  bool Exists(const char* file) const override { return isInside(folder_, file); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = std::strpbrk(mode, "wa+") == nullptr;
    return reads && isInside(folder_, file) ? Assimp::DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::filesystem::path folder_;
};

class Listener : public Assimp::LogStream {
 public:
  Listener(Complaints& complaints, std::filesystem::path file) : complaints_(complaints), file_(std::move(file)) {}
  void write(const char* message) override {
    std::string text(message);
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    // "Warn,  T7f..: what" -> "what"
    const auto colon = text.find(": ");
    complaints_.add(withoutFolder(colon == std::string::npos ? text : text.substr(colon + 2), file_));
  }

 private:
  Complaints& complaints_;
  std::filesystem::path file_;
};

scene::UpAxis upOf(detail::Format format) {
  using enum detail::Format;
  return format == stl || format == off || format == ifc || format == threeDs ? scene::UpAxis::z : scene::UpAxis::y;
}

Mat4 matrixOf(const aiMatrix4x4& m) {
  return {Vec4(m.a1, m.b1, m.c1, m.d1), Vec4(m.a2, m.b2, m.c2, m.d2), Vec4(m.a3, m.b3, m.c3, m.d3),
          Vec4(m.a4, m.b4, m.c4, m.d4)};
}

// Takes back assimp's turn to Y up: (x, y, z) -> (x, -z, y).
Mat4 rootTransform(detail::Format format) {
  if (format != detail::Format::ifc && format != detail::Format::threeDs) return Mat4(1.0);
  return {Vec4(1, 0, 0, 0), Vec4(0, 0, 1, 0), Vec4(0, -1, 0, 0), Vec4(0, 0, 0, 1)};
}

scene::Material materialOf(const aiMaterial& given, unsigned index) {
  scene::Material m;
  aiString name;
  if (given.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) m.name = name.C_Str();
  if (m.name.empty()) m.name = "material " + std::to_string(index);
  aiColor3D diffuse;
  if (given.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == aiReturn_SUCCESS)
    m.colour = linearFromSrgb(Vec3(diffuse.r, diffuse.g, diffuse.b));
  float opacity = 1.0F;
  if (given.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) m.opacity = opacity;
  return m;
}

bool isUsable(const aiFace& face, const mesh::Mesh& m) {
  return std::all_of(face.mIndices, face.mIndices + face.mNumIndices, [&](unsigned corner) {
    return corner < m.positions.size() && std::isfinite(glm::dot(m.positions[corner], m.positions[corner]));
  });
}

// Polygons are cut here and not by assimp, which gives up where it finds no ear and so opens closed surfaces.
void addFace(const aiFace& face, mesh::Mesh& m) {
  const unsigned* corners = face.mIndices;
  if (face.mNumIndices < 3) return;
  if (face.mNumIndices > 3 && isUsable(face, m)) {
    const auto cut = triangulate(m.positions, {{corners, corners + face.mNumIndices}});
    m.triangles.insert(m.triangles.end(), cut.begin(), cut.end());
  } else {  // as a fan, so that what is not usable is counted
    for (unsigned k = 1; k + 1 < face.mNumIndices; ++k) m.triangles.push_back({corners[0], corners[k], corners[k + 1]});
  }
}

mesh::Mesh meshOf(const aiMesh& given, std::size_t materialCount) {
  mesh::Mesh m;
  m.name = given.mName.C_Str();
  for (unsigned i = 0; i < given.mNumVertices; ++i)
    m.positions.emplace_back(given.mVertices[i].x, given.mVertices[i].y, given.mVertices[i].z);
  for (unsigned i = 0; i < given.mNumFaces; ++i) addFace(given.mFaces[i], m);
  m.materials.assign(m.triangles.size(), given.mMaterialIndex < materialCount ? given.mMaterialIndex : 0);
  return m;
}

// The meshes of one node are one part: assimp splits by material, which the part's triangles keep.
struct PartMaker {
  const aiScene& given;
  scene::Scene& scene;
  std::map<std::vector<unsigned>, std::uint32_t> made;

  std::uint32_t make(const aiNode& node) {
    const std::vector<unsigned> indices(node.mMeshes, node.mMeshes + node.mNumMeshes);
    const auto [at, isNew] = made.try_emplace(indices, static_cast<std::uint32_t>(scene.meshes.size()));
    if (!isNew) return at->second;
    mesh::Mesh part;
    for (const unsigned index : indices) {
      if (index >= given.mNumMeshes) continue;
      const mesh::Mesh m = meshOf(*given.mMeshes[index], given.mNumMaterials);
      if (part.name.empty()) part.name = m.name;
      const auto base = static_cast<std::uint32_t>(part.positions.size());
      part.positions.insert(part.positions.end(), m.positions.begin(), m.positions.end());
      part.materials.insert(part.materials.end(), m.materials.begin(), m.materials.end());
      for (const mesh::Triangle& t : m.triangles) part.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(part)));
    return at->second;
  }
};

// assimp names nodes that have none itself, the root most of all; such names say nothing about the scene.
std::string nameOf(const aiNode& node, const std::string& fileName) {
  std::string name = node.mName.C_Str();
  if (name.starts_with("<") || name.starts_with("$") || (node.mParent == nullptr && name.ends_with(fileName)))
    return {};
  return name;
}

void addNodes(const aiScene& given, const Mat4& root, const std::string& fileName, scene::Scene& scene) {
  struct Visit {
    const aiNode* node;
    Mat4 toWorld;
    std::string path;
  };
  PartMaker parts{given, scene, {}};
  std::vector<Visit> stack = {{given.mRootNode, root, ""}};
  while (!stack.empty()) {
    const Visit visit = std::move(stack.back());
    stack.pop_back();
    const aiNode& node = *visit.node;
    const Mat4 toWorld = visit.toWorld * matrixOf(node.mTransformation);
    const std::string path = childPath(visit.path, nameOf(node, fileName));
    if (node.mNumMeshes > 0) {
      const std::uint32_t part = parts.make(node);
      scene.instances.push_back({path.empty() ? scene.meshes[part]->name : path, part, toWorld, true});
    }
    for (unsigned i = node.mNumChildren; i-- > 0;) stack.push_back({node.mChildren[i], toWorld, path});
  }
}

// assimp looks for the end of a PLY header for ever.
Result<void> checkPlyHeader(const std::filesystem::path& file) {
  const auto bytes = readFile(file, kMaxFileBytes);
  if (!bytes) return fail(bytes.error().code, bytes.error().message);
  if (asText(*bytes).find("\nend_header") != std::string_view::npos) return {};
  if (asText(*bytes).find("\rend_header") != std::string_view::npos) return {};
  return fail(ErrorCode::input, "is not a PLY file: its header has no end");
}

}  // namespace

Result<scene::Scene> readWithAssimp(const Request& request, detail::Format format) {
  if (format == detail::Format::ply)
    if (auto fine = checkPlyHeader(request.file); !fine) return tl::unexpected(fine.error());
  Complaints complaints;
  Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(new Listener(complaints, request.file),
                                             Assimp::Logger::Warn | Assimp::Logger::Err);
  Assimp::Importer importer;
  importer.SetIOHandler(new FolderOnly(request.file.parent_path()));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // No steps: joining, sorting or cleaning would lose parts or move points.
  const aiScene* given = importer.ReadFile(request.file.string(), 0);
  if (given == nullptr || given->mRootNode == nullptr) {
    const std::string reason = withoutFolder(importer.GetErrorString(), request.file);
    // assimp catches what its formats' readers throw.
    if (reason == "std::bad_alloc") return fail(ErrorCode::input, "needs more memory than a scene is allowed");
    return fail(ErrorCode::input, "cannot be read: " + (reason.empty() ? "the parser gives no reason" : reason));
  }
  scene::Scene scene;
  scene.up = upOf(format);
  for (unsigned i = 0; i < given->mNumMaterials; ++i) scene.materials.push_back(materialOf(*given->mMaterials[i], i));
  addNodes(*given, rootTransform(format), request.file.filename().string(), scene);
  complaints.appendTo(scene.warnings);
  return scene;
}

}  // namespace umbrage::io::reader
