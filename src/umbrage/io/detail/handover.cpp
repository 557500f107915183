#include "umbrage/io/detail/handover.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "umbrage/io/load.hpp"

namespace umbrage::io::detail {
namespace {

constexpr std::uint64_t kMagic = 0x3330'4e43'5342'4d55;  // "UMBSCN03"
constexpr std::uint64_t kEnd = 0x444e'455f'4e43'535f;    // "_SCN_END"
enum class Kind : std::uint32_t { scene = 1, error = 2 };
enum class LightKind : std::uint32_t { point = 1, directional = 2, spot = 3 };

class Packer {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    raw(&v, sizeof v);
  }
  template <class T>
  void list(const std::vector<T>& items) {
    static_assert(std::is_trivially_copyable_v<T>);
    value<std::uint64_t>(items.size());
    raw(items.data(), items.size() * sizeof(T));
  }
  void text(const std::string& s) {
    value<std::uint64_t>(s.size());
    raw(s.data(), s.size());
  }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  std::vector<std::byte> bytes_;
};

// After the first read beyond the end everything reads as zero or empty and ok() stays false.
class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> bytes) : rest_(bytes) {}
  template <class T>
  T value() {
    T v{};
    raw(&v, sizeof v);
    return v;
  }
  template <class T>
  std::vector<T> list() {
    std::vector<T> items(count(sizeof(T)));
    raw(items.data(), items.size() * sizeof(T));
    return items;
  }
  std::string text() {
    std::string s(count(1), '\0');
    raw(s.data(), s.size());
    return s;
  }
  /// A number of things that take at least `least` bytes each.
  std::size_t count(std::size_t least) {
    const auto n = value<std::uint64_t>();
    if (n > rest_.size() / least) return fault(), 0;
    return static_cast<std::size_t>(n);
  }
  void fault() {
    ok_ = false;
    rest_ = {};
  }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool atEnd() const { return rest_.empty(); }

 private:
  void raw(void* out, std::size_t size) {
    if (size > rest_.size()) return fault();
    if (size > 0) std::memcpy(out, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

void packLight(Packer& out, const scene::Light& light) {
  if (const auto* point = std::get_if<scene::PointLight>(&light.shape)) {
    out.value(LightKind::point);
    out.value(point->position);
  } else if (const auto* sun = std::get_if<scene::DirectionalLight>(&light.shape)) {
    out.value(LightKind::directional);
    out.value(sun->direction);
  } else if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape)) {
    out.value(LightKind::spot);
    out.value(spot->position);
    out.value(spot->direction);
    out.value(spot->cutoff.radians());
  }
  out.value(light.colour);
  out.value(light.intensity);
  out.text(light.name);
}

scene::Light unpackLight(Unpacker& in) {
  scene::Light light;
  switch (in.value<LightKind>()) {
    case LightKind::point: light.shape = scene::PointLight{in.value<Vec3>()}; break;
    case LightKind::directional: light.shape = scene::DirectionalLight{in.value<Vec3>()}; break;
    case LightKind::spot: {
      const auto position = in.value<Vec3>();
      const auto direction = in.value<Vec3>();
      light.shape = scene::SpotLight{position, direction, Angle::radians(in.value<double>())};
      break;
    }
    default: in.fault();
  }
  light.colour = in.value<Vec3>();
  light.intensity = in.value<double>();
  light.name = in.text();
  return light;
}

std::shared_ptr<const mesh::Mesh> unpackMesh(Unpacker& in) {
  auto m = std::make_shared<mesh::Mesh>();
  m->name = in.text();
  m->positions = in.list<Vec3>();
  m->triangles = in.list<mesh::Triangle>();
  m->materials = in.list<std::uint32_t>();
  return m;
}

scene::Scene unpackScene(Unpacker& in) {
  scene::Scene s;
  s.up = in.value<std::uint32_t>() == 0 ? scene::UpAxis::y : scene::UpAxis::z;
  s.metresPerUnit = in.value<double>();
  s.northOffset = Angle::radians(in.value<double>());
  s.crs = in.text();
  for (std::size_t n = in.count(8); n > 0 && in.ok(); --n) s.warnings.push_back(in.text());
  for (std::size_t n = in.count(40); n > 0 && in.ok(); --n) {
    scene::Material m;
    m.name = in.text();
    m.colour = in.value<Vec3>();
    m.opacity = in.value<double>();
    if (in.value<std::uint8_t>() != 0) m.filter = in.value<Vec3>();
    m.emission = in.value<Vec3>();
    m.mirror = in.value<double>();
    m.ior = in.value<double>();
    s.materials.push_back(std::move(m));
  }
  for (std::size_t n = in.count(32); n > 0 && in.ok(); --n) s.meshes.push_back(unpackMesh(in));
  for (std::size_t n = in.count(152); n > 0 && in.ok(); --n) {
    scene::Instance i;
    i.name = in.text();
    i.mesh = in.value<std::uint32_t>();
    i.casts = in.value<std::uint32_t>() != 0;
    i.toWorld = in.value<Mat4>();
    i.group = in.text();
    s.instances.push_back(std::move(i));
  }
  for (std::size_t n = in.count(68); n > 0 && in.ok(); --n) s.lights.push_back(unpackLight(in));
  return s;
}

Error unpackError(Unpacker& in) {
  Error error;
  // A hostile reader must not choose just any code: only the world's faults of reading come through.
  error.code = in.value<std::uint32_t>() == static_cast<std::uint32_t>(ErrorCode::unsupported) ? ErrorCode::unsupported
                                                                                               : ErrorCode::input;
  error.message = in.text();
  error.where = in.text();
  return error;
}

// Before findFault, whose own work grows with instances times points.
std::optional<std::string> findExcess(const scene::Scene& s) {
  if (s.instances.size() > kMaxInstances)
    return "is too large: " + std::to_string(s.instances.size()) + " instances, at most " +
           std::to_string(kMaxInstances) + " are read";
  std::size_t triangles = 0, points = 0;
  for (const scene::Instance& i : s.instances) {
    if (i.mesh >= s.meshes.size()) continue;
    triangles += s.meshes[i.mesh]->triangles.size();
    points += s.meshes[i.mesh]->positions.size();
    if (triangles > kMaxTriangles || points > 3 * kMaxTriangles)
      return "is too large: more than " + std::to_string(kMaxTriangles) + " triangles with all instances";
  }
  return std::nullopt;
}

tl::unexpected<Error> broken() {
  return fail(ErrorCode::input, "the reader handed over something that is not a scene");
}

}  // namespace

std::vector<std::byte> pack(const scene::Scene& scene) {
  Packer out;
  out.value(kMagic);
  out.value(Kind::scene);
  out.value<std::uint32_t>(scene.up == scene::UpAxis::y ? 0 : 1);
  out.value(scene.metresPerUnit);
  out.value(scene.northOffset.radians());
  out.text(scene.crs);
  out.value<std::uint64_t>(scene.warnings.size());
  for (const std::string& warning : scene.warnings) out.text(warning);
  out.value<std::uint64_t>(scene.materials.size());
  for (const scene::Material& m : scene.materials) {
    out.text(m.name);
    out.value(m.colour);
    out.value(m.opacity);
    out.value(static_cast<std::uint8_t>(m.filter ? 1 : 0));
    if (m.filter) out.value(*m.filter);
    out.value(m.emission);
    out.value(m.mirror);
    out.value(m.ior);
  }
  out.value<std::uint64_t>(scene.meshes.size());
  for (const auto& m : scene.meshes) {
    out.text(m->name);
    out.list(m->positions);
    out.list(m->triangles);
    out.list(m->materials);
  }
  out.value<std::uint64_t>(scene.instances.size());
  for (const scene::Instance& i : scene.instances) {
    out.text(i.name);
    out.value(i.mesh);
    out.value<std::uint32_t>(i.casts ? 1 : 0);
    out.value(i.toWorld);
    out.text(i.group);
  }
  out.value<std::uint64_t>(scene.lights.size());
  for (const scene::Light& light : scene.lights) packLight(out, light);
  out.value(kEnd);
  return out.take();
}

std::vector<std::byte> pack(const Error& error) {
  Packer out;
  out.value(kMagic);
  out.value(Kind::error);
  out.value<std::uint32_t>(static_cast<std::uint32_t>(error.code));
  out.text(error.message);
  out.text(error.where);
  out.value(kEnd);
  return out.take();
}

Result<scene::Scene> unpack(std::span<const std::byte> bytes) {
  Unpacker in(bytes);
  if (in.value<std::uint64_t>() != kMagic) return broken();
  const auto kind = in.value<Kind>();
  if (kind == Kind::error) {
    Error error = unpackError(in);
    if (in.value<std::uint64_t>() != kEnd || !in.ok() || !in.atEnd()) return broken();
    return tl::unexpected(std::move(error));
  }
  if (kind != Kind::scene) return broken();
  scene::Scene scene = unpackScene(in);
  if (in.value<std::uint64_t>() != kEnd || !in.ok() || !in.atEnd()) return broken();
  if (auto excess = findExcess(scene)) return fail(ErrorCode::input, *excess);
  if (auto fault = scene::findFault(scene)) return fail(ErrorCode::input, *fault);
  return scene;
}

}  // namespace umbrage::io::detail
