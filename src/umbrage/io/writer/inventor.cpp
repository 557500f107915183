// Open Inventor 2.1, text. A part is a Separator with its name below Separators with the names of its levels; what parts share
// is DEFined without a name ("+3", as Inventor itself writes it), so that no name comes in between.
// Source: Wernecke, The Inventor Mentor, 1994, appendix on file format.
#include <algorithm>
#include <map>
#include <utility>

#include "umbrage/io/writer/common.hpp"
#include "umbrage/io/writer/writers.hpp"

namespace umbrage::io::writer {
namespace {

std::string identifier(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    if (digit && result.empty()) result += '_';
    result += letter || digit ? c : '_';
  }
  return result;
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result + '"';
}

template <class V>
void appendVector(std::string& text, const V& v) {
  append(text, v.x);
  text += ' ';
  append(text, v.y);
  text += ' ';
  append(text, v.z);
}

/// One level of the hierarchy: the instances that stand in it, and the levels below.
struct Level {
  std::string name;
  std::vector<std::pair<std::string, const scene::Instance*>> parts;
  std::vector<Level> levels;

  Level& below(const std::string& wanted) {
    for (Level& level : levels)
      if (level.name == wanted) return level;
    return levels.emplace_back(Level{wanted, {}, {}});
  }
};

class InventorWriter {
 public:
  explicit InventorWriter(const scene::Scene& scene) : scene_(scene) {}

  std::string write();

 private:
  void line(std::string_view text);
  void open(std::string_view text);
  void close(std::string_view text = "}");
  void openLevel(const std::string& name);
  void addMatrix(const Mat4& m);
  void addPalette();
  void addMaterials(const std::vector<std::uint32_t>& materials);
  void addLevel(const Level& level);
  void addPart(const std::string& name, const scene::Instance& instance);
  void addMesh(const mesh::Mesh& m, const SinglePrecision& single);

  const scene::Scene& scene_;
  std::map<std::uint32_t, Vec3> defined_;  // meshes that can be USEd, with their origins
  std::string out_ = "#Inventor V2.1 ascii\n\n";
  std::size_t depth_ = 0;
};

void InventorWriter::line(std::string_view text) {
  out_.append(2 * depth_, ' ');
  out_ += text;
  out_ += '\n';
}
void InventorWriter::open(std::string_view text) {
  line(text);
  ++depth_;
}
void InventorWriter::close(std::string_view text) {
  --depth_;
  line(text);
}

/// A name that Inventor cannot hold stands inside as a remark, which this project's reader takes instead.
void InventorWriter::openLevel(const std::string& name) {
  open("DEF " + identifier(name) + " Separator {");
  if (identifier(name) != name) line("Info { string " + quoted("name: " + name) + " }");
}

/// Inventor multiplies row vectors from the left, so its rows are our columns.
void InventorWriter::addMatrix(const Mat4& m) {
  if (m == Mat4(1.0)) return;
  std::string text = "MatrixTransform { matrix";
  for (int i = 0; i < 16; ++i) append(text += ' ', m[i / 4][i % 4] + 0.0);
  line(text + " }");
}

/// Every material once with its name; parts repeat the colours that they use.
void InventorWriter::addPalette() {
  open("Separator {");
  for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
    const std::string name = identifier(scene_.materials[i].name);
    if (!name.empty()) out_.append(2 * depth_, ' ').append("DEF " + name + "\n");
    addMaterials({i});
  }
  close();
}

void InventorWriter::addMaterials(const std::vector<std::uint32_t>& materials) {
  std::string colours, clear;
  for (const std::uint32_t i : materials) {
    appendVector(colours += colours.empty() ? "" : ", ", Vec3f(srgbFromLinear(scene_.materials[i].colour)));
    append(clear += clear.empty() ? "" : ", ", static_cast<float>(1.0 - scene_.materials[i].opacity));
  }
  line("Material { diffuseColor [ " + colours + " ] transparency [ " + clear + " ] }");
}

void InventorWriter::addLevel(const Level& level) {
  for (const auto& [name, instance] : level.parts) addPart(name, *instance);
  for (const Level& lower : level.levels) {
    openLevel(lower.name);
    addLevel(lower);
    close();
  }
}

void InventorWriter::addPart(const std::string& name, const scene::Instance& instance) {
  const mesh::Mesh& m = *scene_.meshes[instance.mesh];
  if (m.triangles.empty()) return;
  openLevel(name);
  const bool known = defined_.contains(instance.mesh);
  SinglePrecision single;
  if (!known) {
    single = inSinglePrecision(m);
    defined_[instance.mesh] = single.origin;
  }
  Mat4 placed = instance.toWorld;
  placed[3] = instance.toWorld * Vec4(defined_[instance.mesh], 1.0);
  addMatrix(placed);
  const std::string reference = "+" + std::to_string(instance.mesh);
  if (known) {
    line("USE " + reference);
  } else {
    open("DEF " + reference + " Separator {");
    addMesh(m, single);
    close();
  }
  close();
}

void InventorWriter::addMesh(const mesh::Mesh& m, const SinglePrecision& single) {
  const std::vector<std::uint32_t> materials = usedMaterials(m);
  addMaterials(materials);
  line(materials.size() > 1 ? "MaterialBinding { value PER_FACE_INDEXED }" : "MaterialBinding { value OVERALL }");
  open("Coordinate3 { point [");
  for (const Vec3f& p : single.positions) {
    std::string text;
    appendVector(text, p);
    line(text + ',');
  }
  close("] }");
  open("IndexedFaceSet {");
  open("coordIndex [");
  for (const mesh::Triangle& t : m.triangles) {
    std::string text;
    for (const std::uint32_t corner : t) {
      append(text, corner);
      text += ", ";
    }
    line(text + "-1,");
  }
  close("]");
  if (materials.size() > 1) {
    std::string text = "materialIndex [";
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const auto place = std::lower_bound(materials.begin(), materials.end(), materialOf(m, t)) - materials.begin();
      append(text += ' ', static_cast<std::uint32_t>(place));
      text += ',';
    }
    line(text + " ]");
  }
  close();
}

std::string InventorWriter::write() {
  Level root;
  for (const scene::Instance& instance : scene_.instances) {
    const auto path = levels(instance.name);
    Level* level = &root;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) level = &level->below(path[i]);
    level->parts.emplace_back(path.back(), &instance);
  }
  open("Separator {");
  addMatrix(toMetres(scene_, scene::UpAxis::y));
  // Both sides are lit, edges stay sharp.
  line("ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType UNKNOWN_SHAPE_TYPE faceType CONVEX creaseAngle 0 }");
  addPalette();
  addLevel(root);
  close();
  return std::move(out_);
}

}  // namespace

Result<Document> inventor(const scene::Scene& scene, const std::string&) {
  return Document{InventorWriter(scene).write(), {}, {}};
}

}  // namespace umbrage::io::writer
