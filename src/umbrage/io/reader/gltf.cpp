// glTF 2.0, text and binary, through tinygltf. Of textures the alpha is read. Cameras, lights, skins, morphing and animation are not.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "umbrage/base/file.hpp"
#include "umbrage/base/json_depth.hpp"
#include "umbrage/io/reader/files.hpp"
#include "umbrage/io/reader/gltf_alpha.hpp"
#include "umbrage/io/reader/gltf_primitive.hpp"
#include "umbrage/io/reader/read.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

// What a file may demand: these change the look of textures and reflections, or are read here.
constexpr std::array<std::string_view, 8> kHarmless = {
    "KHR_mesh_quantization", "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp",
    "MSFT_texture_dds",      "KHR_lights_punctual",   "KHR_xmp_json_ld",    "KHR_animation_pointer"};
constexpr std::string_view kInstancing = "EXT_mesh_gpu_instancing";

bool isHarmless(std::string_view extension) {
  return extension.starts_with("KHR_materials_") ||
         std::find(kHarmless.begin(), kHarmless.end(), extension) != kHarmless.end();
}

bool isCompression(std::string_view extension) { return extension == kDraco || extension == "EXT_meshopt_compression"; }

// Pictures in buffers and files of their own are read where they are needed (gltf_textures.cpp).
bool keepEmbedded(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void* pictures) {
  if (image->bufferView < 0 && size > 0) (*static_cast<EmbeddedPictures*>(pictures))[index].assign(bytes, bytes + size);
  return true;
}

bool existsInside(const std::string& path, void* folder) {
  return isInside(*static_cast<const std::filesystem::path*>(folder), path);
}

bool readInside(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* folder) {
  if (!existsInside(path, folder)) {
    *error = "lies outside the folder of the scene";
    return false;
  }
  const auto bytes = readFile(path, kMaxFileBytes);
  if (!bytes) {
    *error = bytes.error().message;
    return false;
  }
  const auto* begin = reinterpret_cast<const unsigned char*>(bytes->data());
  out->assign(begin, begin + bytes->size());
  return true;
}

bool refuseToWrite(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

bool isBinary(const std::vector<std::byte>& bytes) { return asText(bytes).starts_with("glTF"); }

// The JSON of either kind of file; for a binary one that lies about its sizes, as much as there is.
std::string_view jsonOf(const std::vector<std::byte>& bytes) {
  const std::string_view all = asText(bytes);
  return isBinary(bytes) ? all.substr(std::min<std::size_t>(20, all.size())) : all;
}

std::string firstLine(const std::string& text) {
  const auto begin = text.find_first_not_of(" \n");
  const std::string line = begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
  const auto tag = line.starts_with("[json.") ? line.find("] ") : std::string::npos;
  return tag == std::string::npos ? line : line.substr(tag + 2);
}

Result<tinygltf::Model> parse(const Request& request, EmbeddedPictures& pictures) {
  const auto bytes = readJsonBytes(request.file);
  if (!bytes) return tl::unexpected(bytes.error());
  const bool binary = isBinary(*bytes);
  if (!binary)
    if (auto fine = checkJsonDepth(jsonOf(*bytes), kMaxJsonDepth); !fine) return tl::unexpected(fine.error());
  auto folder = request.file.parent_path();
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keepEmbedded, &pictures);
  loader.SetFsCallbacks({existsInside, tinygltf::ExpandFilePath, readInside, refuseToWrite, &folder});
  tinygltf::Model model;
  std::string errors, warnings;
  const auto size = static_cast<unsigned>(bytes->size());
  const bool parsed =
      binary ? loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                           reinterpret_cast<const unsigned char*>(bytes->data()), size, folder.string())
             : loader.LoadASCIIFromString(&model, &errors, &warnings, reinterpret_cast<const char*>(bytes->data()),
                                          size, folder.string());
  // Before the errors: a file that demands what is not known here may well look broken.
  for (const std::string& extension : model.extensionsRequired)
    if (!isHarmless(extension)) return fail(ErrorCode::unsupported, "needs the glTF extension " + extension);
  if (!model.asset.version.empty() && !model.asset.version.starts_with("2"))
    return fail(ErrorCode::unsupported, "is glTF " + model.asset.version + "; only glTF 2.0 is read");
  if (!parsed)
    for (const std::string& extension : model.extensionsUsed)
      if (isCompression(extension)) return fail(ErrorCode::unsupported, "needs the glTF extension " + extension);
  if (!parsed) return fail(ErrorCode::input, "is not valid glTF: " + firstLine(errors));
  return model;
}

/// A number of an extension, or what it is where the file does not say.
double numberOf(const tinygltf::Material& given, const char* extension, const char* name, double otherwise) {
  const auto found = given.extensions.find(extension);
  if (found == given.extensions.end() || !found->second.Has(name)) return otherwise;
  const tinygltf::Value& value = found->second.Get(name);
  return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

// What glTF says beyond colour: metals mirror as far as they are smooth, and only what has a volume bends light.
void addOptics(const tinygltf::Material& given, scene::Material& m) {
  if (given.emissiveFactor.size() == 3)
    m.emission = numberOf(given, "KHR_materials_emissive_strength", "emissiveStrength", 1.0) *
                 Vec3(given.emissiveFactor[0], given.emissiveFactor[1], given.emissiveFactor[2]);
  const auto& surface = given.pbrMetallicRoughness;
  // Where a texture says what is metal, the factors alone say nothing.
  if (surface.metallicRoughnessTexture.index < 0)
    m.mirror = surface.metallicFactor * std::pow(1.0 - std::clamp(surface.roughnessFactor, 0.0, 1.0), 2.0);
  if (numberOf(given, "KHR_materials_volume", "thicknessFactor", 0.0) > 0.0)
    m.ior = numberOf(given, "KHR_materials_ior", "ior", 1.5);
}

/// `part`: how much of the material's surface is there, or passes, where its texture says so; else its own numbers count.
struct Part {
  double value;
  bool transmits;
};

// What writeScene noted of it.
std::optional<Vec3> notedFilter(const tinygltf::Value& extras) {
  if (!extras.IsObject() || !extras.Has("filter")) return std::nullopt;
  const tinygltf::Value& filter = extras.Get("filter");
  if (!filter.IsArray() || filter.ArrayLen() != 3) return std::nullopt;
  Vec3 parts;
  for (int k = 0; k < 3; ++k) {
    if (!filter.Get(k).IsNumber()) return std::nullopt;
    parts[k] = filter.Get(k).GetNumberAsDouble();
  }
  return parts;
}

scene::Material materialOf(const tinygltf::Material& given, std::size_t index,
                           const std::optional<Part>& part = std::nullopt) {
  scene::Material m;
  m.name = given.name.empty() ? "material " + std::to_string(index) : given.name;
  addOptics(given, m);
  const auto& factor = given.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() != 4) return m;
  m.colour = glm::clamp(Vec3(factor[0], factor[1], factor[2]), 0.0, 1.0);
  if (given.alphaMode == "BLEND") m.opacity = std::clamp(factor[3], 0.0, 1.0);
  if (given.alphaMode == "MASK") m.opacity = factor[3] >= given.alphaCutoff ? 1.0 : 0.0;
  if (part && !part->transmits) m.opacity = part->value;
  if (!part) m.filter = notedFilter(given.extras);
  if (m.filter) return m;
  if (m.opacity == 0.0) return m;
  if (const double transmission = part && part->transmits ? part->value : transmissionOf(given); transmission > 0.0) {
    // Its share of what is there passes in the colour, and is not seen of the surface itself.
    m.filter = (1.0 - m.opacity * (1.0 - transmission)) * m.colour;
    m.opacity *= 1.0 - transmission;
  }
  return m;
}

class GltfReader {
 public:
  GltfReader(const tinygltf::Model& model, const GltfAlpha& alpha) : model_(model), alpha_(alpha) {}
  Result<scene::Scene> read();

 private:
  struct Visit {
    int node;
    Mat4 toWorld;
    std::string path;
  };
  [[nodiscard]] std::vector<int> roots() const;
  Result<void> walk();
  Result<void> enter(const Visit& visit, std::vector<Visit>& stack);
  Result<std::uint32_t> meshOf(int index);
  Result<void> addPrimitive(const tinygltf::Primitive& primitive, const CutPrimitive* cut, mesh::Mesh& m);
  void addPieces(const CutPrimitive& cut, std::size_t material, mesh::Mesh& m);
  std::uint32_t materialFor(std::size_t material, bool transmits, double part);
  void noteUnread();

  const tinygltf::Model& model_;
  const GltfAlpha& alpha_;
  std::map<std::tuple<std::size_t, bool, int>, std::uint32_t> parted_;  ///< materials of which a part is there
  scene::Scene scene_;
  std::vector<bool> visited_;
  std::map<int, std::uint32_t> meshes_;
  Complaints complaints_;
};

Result<scene::Scene> GltfReader::read() {
  scene_.up = scene::UpAxis::y;
  for (std::size_t i = 0; i < model_.materials.size(); ++i)
    scene_.materials.push_back(materialOf(model_.materials[i], i));
  scene_.materials.push_back({"default", Vec3(0.8), 1.0});
  visited_.assign(model_.nodes.size(), false);
  if (auto walked = walk(); !walked) return tl::unexpected(walked.error());
  noteUnread();
  for (std::string& note : alpha_.notes()) scene_.warnings.push_back(std::move(note));
  alpha_.complaints().appendTo(scene_.warnings);
  complaints_.appendTo(scene_.warnings);
  return std::move(scene_);
}

// The default scene's, or the first's; in a file without scenes the nodes that are nobody's child.
std::vector<int> GltfReader::roots() const {
  if (!model_.scenes.empty()) {
    const auto chosen = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
    return model_.scenes[chosen < model_.scenes.size() ? chosen : 0].nodes;
  }
  std::set<int> children;
  for (const tinygltf::Node& node : model_.nodes) children.insert(node.children.begin(), node.children.end());
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(model_.nodes.size()); ++i)
    if (!children.contains(i)) free.push_back(i);
  return free;
}

// Without recursion: node chains of any depth are legal.
Result<void> GltfReader::walk() {
  std::vector<Visit> stack;
  for (const int root : roots()) stack.push_back({root, Mat4(1.0), ""});
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {
    const Visit visit = std::move(stack.back());
    stack.pop_back();
    if (auto entered = enter(visit, stack); !entered) return entered;
  }
  return {};
}

Mat4 transformOf(const tinygltf::Node& node) {
  Mat4 m(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return m;
  }
  if (const auto& q = node.rotation; q.size() == 4) m = glm::mat4_cast(glm::dquat(q[3], q[0], q[1], q[2]));
  if (const auto& s = node.scale; s.size() == 3)
    for (int k = 0; k < 3; ++k) m[k] *= s[static_cast<std::size_t>(k)];
  if (const auto& t = node.translation; t.size() == 3) m[3] = Vec4(t[0], t[1], t[2], 1.0);
  return m;
}

Result<void> GltfReader::enter(const Visit& visit, std::vector<Visit>& stack) {
  if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= model_.nodes.size())
    return fail(ErrorCode::input, "a node that does not exist is referred to", "node " + std::to_string(visit.node));
  const auto index = static_cast<std::size_t>(visit.node);
  if (visited_[index])
    return fail(ErrorCode::input, "the nodes are not a tree: one is reached twice", "node " + std::to_string(index));
  visited_[index] = true;
  const tinygltf::Node& node = model_.nodes[index];
  const Mat4 toWorld = visit.toWorld * transformOf(node);
  const std::string path = childPath(visit.path, node.name);
  if (node.mesh >= 0) {
    const auto mesh = meshOf(node.mesh);
    if (!mesh) return tl::unexpected(mesh.error());
    scene_.instances.push_back(
        {node.name.empty() ? childPath(path, scene_.meshes[*mesh]->name) : path, *mesh, toWorld, true});
    if (node.skin >= 0) complaints_.add("skins are not read: a skinned mesh is shown as it was modelled");
    if (node.extensions.contains(std::string(kInstancing)))
      complaints_.add(std::string(kInstancing) + " is not read: such a mesh is shown once");
  }
  for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
    stack.push_back({*child, toWorld, path});
  return {};
}

Result<std::uint32_t> GltfReader::meshOf(int index) {
  if (const auto known = meshes_.find(index); known != meshes_.end()) return known->second;
  if (static_cast<std::size_t>(index) >= model_.meshes.size())
    return fail(ErrorCode::input, "a mesh that does not exist is referred to", "mesh " + std::to_string(index));
  const tinygltf::Mesh& given = model_.meshes[static_cast<std::size_t>(index)];
  mesh::Mesh m;
  m.name = given.name.empty() ? "mesh " + std::to_string(index) : given.name;
  for (std::size_t p = 0; p < given.primitives.size(); ++p)
    if (auto added = addPrimitive(given.primitives[p], alpha_.find(index, p), m); !added)
      return fail(added.error().code, added.error().message,
                  "mesh " + std::to_string(index) + ", " + added.error().where);
  const auto place = static_cast<std::uint32_t>(scene_.meshes.size());
  scene_.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  return meshes_[index] = place;
}

Result<void> GltfReader::addPrimitive(const tinygltf::Primitive& primitive, const CutPrimitive* cut, mesh::Mesh& m) {
  if (cut != nullptr) return addPieces(*cut, static_cast<std::size_t>(primitive.material), m), Result<void>();
  const auto given = readPrimitive(model_, primitive);
  if (!given) return tl::unexpected(given.error());
  if (!*given) {
    complaints_.add("a mesh without positions is left out");
    return {};
  }
  const auto& points = (*given)->points;
  const auto base = static_cast<std::uint32_t>(m.positions.size());
  const auto count = static_cast<std::uint32_t>(points.size());
  m.positions.insert(m.positions.end(), points.begin(), points.end());
  const bool known = primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < model_.materials.size();
  const auto material =
      static_cast<std::uint32_t>(known ? static_cast<std::size_t>(primitive.material) : model_.materials.size());
  for (const mesh::Triangle& t : (*given)->triangles) {
    mesh::Triangle placed;
    // A corner outside this primitive must not become one of the next.
    for (int k = 0; k < 3; ++k) placed[k] = t[k] < count ? base + t[k] : 0xffffffffU;
    m.triangles.push_back(placed);
    m.materials.push_back(material);
  }
  return {};
}

// tidy() makes the corners that pieces share one again.
void GltfReader::addPieces(const CutPrimitive& cut, std::size_t material, mesh::Mesh& m) {
  for (std::size_t t = 0; t < cut.pieces.triangles.size(); ++t) {
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    const auto& corners = cut.pieces.triangles[t];
    m.positions.insert(m.positions.end(), corners.begin(), corners.end());
    m.triangles.push_back({base, base + 1, base + 2});
    m.materials.push_back(materialFor(material, cut.transmits, cut.pieces.parts[t]));
  }
}

// In steps of 1/64, so that there are not as many materials as triangles.
std::uint32_t GltfReader::materialFor(std::size_t material, bool transmits, double part) {
  constexpr int kSteps = 64;
  const int step = static_cast<int>(std::lround(part * kSteps));
  const auto [place, isNew] = parted_.try_emplace({material, transmits, step}, 0);
  if (!isNew) return place->second;
  scene::Material m = materialOf(model_.materials[material], material, Part{double(step) / kSteps, transmits});
  if (m.opacity < 1.0) m.name += " " + std::to_string(step) + "/" + std::to_string(kSteps);
  place->second = static_cast<std::uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(m));
  return place->second;
}

void GltfReader::noteUnread() {
  for (const std::string& extension : model_.extensionsUsed)
    if (extension == "KHR_lights_punctual") complaints_.add(extension + " is not read");
  if (!model_.animations.empty()) complaints_.add("animations are not read");
}

}  // namespace

Result<scene::Scene> readGltf(const Request& request) {
  EmbeddedPictures pictures;
  const auto model = parse(request, pictures);
  if (!model) return tl::unexpected(model.error());
  const GltfAlpha alpha(*model, {*model, pictures, request.file.parent_path()},
                        {request.hints.alphaTriangles, request.hints.alphaLevel});
  return GltfReader(*model, alpha).read();
}

}  // namespace umbrage::io::reader
