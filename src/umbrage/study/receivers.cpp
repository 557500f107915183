#include "umbrage/study/receivers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "umbrage/base/check.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/base/sha256.hpp"

namespace umbrage::study {
namespace {

// East, north and up of the file's own frame.
struct Plan {
  Vec3 east, north, up;
  explicit Plan(const scene::Scene& scene)
      : east(scene::eastVector(scene.up)), north(scene::northVector(scene.up)), up(scene::upVector(scene.up)) {}
  [[nodiscard]] Vec3 flat(const Vec3& p) const { return {glm::dot(p, east), glm::dot(p, north), glm::dot(p, up)}; }
  [[nodiscard]] Vec3 world(const Vec3& p) const { return p.x * east + p.y * north + p.z * up; }
};

Result<void> checkCount(double count) {
  if (count <= double(kMostReceivers)) return {};
  return fail(ErrorCode::usage,
              fmt::format("a grid this fine has {:.0f} million points, more than {} million; take larger steps",
                          count / 1e6, kMostReceivers / 1'000'000));
}

// Around a box in plan, aligned to whole steps.
Result<Lattice> latticeAround(const Box3& box, double step, double margin) {
  Lattice l;
  l.step = step;
  l.west = std::floor((box.min.x - margin) / step) * step;
  l.north = std::ceil((box.max.y + margin) / step) * step;
  const double columns = std::ceil((box.max.x + margin - l.west) / step - 1e-9),
               rows = std::ceil((l.north - box.min.y + margin) / step - 1e-9);
  if (auto fits = checkCount(columns * rows); !fits) return tl::unexpected(fits.error());
  l.columns = std::max(1, static_cast<int>(columns)), l.rows = std::max(1, static_cast<int>(rows));
  l.receiver.assign(static_cast<std::size_t>(l.columns) * static_cast<std::size_t>(l.rows), -1);
  return l;
}

// From the north-western corner on.
Result<Lattice> latticeOver(const PlanExtent& extent, double step) {
  Lattice l;
  l.step = step, l.west = extent.west, l.north = extent.north;
  const double columns = std::ceil((extent.east - extent.west) / step - 1e-6),
               rows = std::ceil((extent.north - extent.south) / step - 1e-6);
  if (auto fits = checkCount(columns * rows); !fits) return tl::unexpected(fits.error());
  l.columns = std::max(1, static_cast<int>(columns)), l.rows = std::max(1, static_cast<int>(rows));
  l.receiver.assign(static_cast<std::size_t>(l.columns) * static_cast<std::size_t>(l.rows), -1);
  return l;
}

Vec2 middleOf(const Lattice& l, int column, int row) {
  return {l.west + (column + 0.5) * l.step, l.north - (row + 0.5) * l.step};
}

std::vector<const scene::Instance*> matching(const scene::Scene& scene, const std::vector<std::string>& patterns) {
  std::vector<const scene::Instance*> found;
  for (const scene::Instance& instance : scene.instances)
    if (std::any_of(patterns.begin(), patterns.end(),
                    [&](const auto& p) { return scene::matchesName(instance.name, p); }))
      found.push_back(&instance);
  return found;
}

std::string named(const std::vector<std::string>& patterns) {
  std::string text;
  for (const std::string& p : patterns) text += (text.empty() ? "'" : ", '") + p + "'";
  return text;
}

template <class Fn>
void forTriangles(const scene::Scene& scene, const scene::Instance& instance, Fn&& fn) {
  const mesh::Mesh& m = *scene.meshes[instance.mesh];
  const bool mirrored = glm::determinant(Mat3(instance.toWorld)) < 0.0;
  for (const mesh::Triangle& t : m.triangles) {
    Vec3 c[3];
    for (int k = 0; k < 3; ++k) c[k] = transformPoint(instance.toWorld, m.positions[t[k]]);
    if (mirrored) std::swap(c[1], c[2]);
    fn(c[0], c[1], c[2]);
  }
}

// Of the largest coordinate: what four operations in double precision can move a point by.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

// The highest surface in each cell's middle, and the way it faces, upwards.
struct Tops {
  std::vector<double> height;
  std::vector<Vec3> normal;
};

void addTop(const Lattice& l, const Vec3& a, const Vec3& b, const Vec3& c, Tops& tops) {
  Vec3 normal = glm::cross(b - a, c - a);
  if (normal.z == 0.0 || !(glm::length(normal) > 0.0)) return;
  normal = glm::normalize(normal.z < 0.0 ? -normal : normal);
  const auto cell = [&](double v) { return static_cast<int>(std::clamp(std::floor(v), -1.0, 1e9)); };
  const int left = std::max(0, cell((std::min({a.x, b.x, c.x}) - l.west) / l.step - 0.5));
  const int right = std::min(l.columns - 1, cell((std::max({a.x, b.x, c.x}) - l.west) / l.step + 0.5));
  const int top = std::max(0, cell((l.north - std::max({a.y, b.y, c.y})) / l.step - 0.5));
  const int bottom = std::min(l.rows - 1, cell((l.north - std::min({a.y, b.y, c.y})) / l.step + 0.5));
  // Cells' middles are often corners of a raster's surface: one within rounding of an edge is on it, so that it falls into no gap.
  const double near = kRounding * std::max({std::abs(a.x), std::abs(a.y), std::abs(l.west), std::abs(l.north)});
  const auto side = [&](const Vec3& p, const Vec3& q, const Vec2& at) {
    const double across = (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
    return std::abs(across) <= near * std::hypot(q.x - p.x, q.y - p.y) ? 0.0 : across;
  };
  const double lowest = std::min({a.z, b.z, c.z}), highest = std::max({a.z, b.z, c.z});
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const Vec2 at = middleOf(l, column, row);
      const double u = side(a, b, at), v = side(b, c, at), w = side(c, a, at);
      if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) continue;
      const double plane = a.z - ((at.x - a.x) * normal.x + (at.y - a.y) * normal.y) / normal.z;
      const double z = std::clamp(plane, lowest, highest);
      const auto i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(l.columns) + static_cast<std::size_t>(column);
      if (z > tops.height[i]) tops.height[i] = z, tops.normal[i] = normal;
    }
}

Box3 boxInPlan(const scene::Scene& scene, const std::vector<const scene::Instance*>& parts) {
  const Plan plan(scene);
  Box3 box;
  for (const auto* part : parts)
    forTriangles(scene, *part, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      for (const Vec3& p : {a, b, c}) box.add(plan.flat(p));
    });
  return box;
}

tl::unexpected<Error> noMiddles(const scene::Scene& scene, double step) {
  return fail(ErrorCode::usage, fmt::format("no cell of {:g} has its middle on the surface; take smaller steps", step),
              scene.source);
}

enum class Facing { up, asTheSurface };

// A receiver in each cell whose middle lies over the parts.
ReceiverSet layOn(const scene::Scene& scene, const std::vector<const scene::Instance*>& parts, Lattice lattice,
                  double above, Facing facing) {
  const Plan plan(scene);
  Tops tops{std::vector<double>(lattice.receiver.size(), -std::numeric_limits<double>::infinity()),
            std::vector<Vec3>(lattice.receiver.size())};
  for (const auto* part : parts)
    forTriangles(scene, *part, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      addTop(lattice, plan.flat(a), plan.flat(b), plan.flat(c), tops);
    });
  ReceiverSet set;
  for (std::size_t i = 0; i < tops.height.size(); ++i) {
    if (!std::isfinite(tops.height[i])) continue;
    lattice.receiver[i] = static_cast<std::int32_t>(set.receivers.size());
    const auto columns = static_cast<std::size_t>(lattice.columns);
    const Vec2 at = middleOf(lattice, static_cast<int>(i % columns), static_cast<int>(i / columns));
    set.receivers.push_back({plan.world({at.x, at.y, tops.height[i] + above}),
                             facing == Facing::up ? plan.up : plan.world(tops.normal[i])});
  }
  set.lattice = std::move(lattice);
  return set;
}

// One point for each square of the side `step`, by a lattice of as many parts along two edges.
void addFace(const Vec3& a, const Vec3& b, const Vec3& c, double step, std::vector<Receiver>& out) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double area = 0.5 * glm::length(normal);
  if (!(area > 0.0)) return;
  const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(area) / step)));
  const Vec3 unit = glm::normalize(normal);
  for (int i = 0; i < n; ++i)  // n x n triangles of equal area: their centres
    for (int k = 0; k + i < n; ++k) {
      out.push_back({a + (b - a) * ((i + 1.0 / 3.0) / n) + (c - a) * ((k + 1.0 / 3.0) / n), unit});
      if (i + k + 1 < n) out.push_back({a + (b - a) * ((i + 2.0 / 3.0) / n) + (c - a) * ((k + 2.0 / 3.0) / n), unit});
    }
}

}  // namespace

Result<ReceiverSet> planeReceivers(const scene::Scene& scene, double step, double height) {
  UMBRAGE_CHECK(step > 0.0, "a grid's step is a length");
  const Plan plan(scene);
  Box3 box;
  const Box3 world = scene::bounds(scene, true);
  if (world.empty()) return fail(ErrorCode::input, "nothing casts, so there is no place for a grid", scene.source);
  for (const Vec3& corner : {world.min, world.max}) box.add(plan.flat(corner));
  auto lattice = latticeAround(box, step, 0.5 * std::max(0.0, box.max.z - height));
  if (!lattice) return tl::unexpected(lattice.error());
  ReceiverSet set;
  for (int row = 0; row < lattice->rows; ++row)
    for (int column = 0; column < lattice->columns; ++column) {
      lattice->receiver[set.receivers.size()] = static_cast<std::int32_t>(set.receivers.size());
      const Vec2 at = middleOf(*lattice, column, row);
      set.receivers.push_back({plan.world({at.x, at.y, height}), plan.up});
    }
  set.described = fmt::format("grid of {:g}, horizontal, at height {:g}", step, height);
  set.lattice = std::move(*lattice);
  return set;
}

Result<ReceiverSet> groundReceivers(const scene::Scene& scene, const std::vector<std::string>& patterns, double step,
                                    double above) {
  UMBRAGE_CHECK(step > 0.0, "a grid's step is a length");
  const auto parts = matching(scene, patterns);
  const Box3 box = boxInPlan(scene, parts);
  if (box.empty()) return fail(ErrorCode::usage, "no part is named " + named(patterns), scene.source);
  auto lattice = latticeAround(box, step, 0.0);
  if (!lattice) return tl::unexpected(lattice.error());
  ReceiverSet set = layOn(scene, parts, std::move(*lattice), above, Facing::asTheSurface);
  if (set.receivers.empty()) return noMiddles(scene, step);
  set.described = fmt::format("grid of {:g} on the highest surface of {}, {:g} above it", step, named(patterns), above);
  return set;
}

Result<ReceiverSet> rasterReceivers(const scene::Scene& scene, const std::optional<PlanExtent>& extent, double step,
                                    double above) {
  UMBRAGE_CHECK(step > 0.0, "a grid's step is a length");
  const auto parts = matching(scene, {"*"});
  const Box3 box = boxInPlan(scene, parts);
  if (box.empty()) return fail(ErrorCode::input, "has no cells with a height, so there is no ground", scene.source);
  auto lattice = extent ? latticeOver(*extent, step) : latticeAround(box, step, 0.0);
  if (!lattice) return tl::unexpected(lattice.error());
  ReceiverSet set = layOn(scene, parts, std::move(*lattice), above, Facing::up);
  if (set.receivers.empty()) return noMiddles(scene, step);
  set.described = fmt::format("grid of {:g} on the raster's surface, {:g} above it, facing up", step, above);
  return set;
}

Result<ReceiverSet> faceReceivers(const scene::Scene& scene, const std::vector<std::string>& patterns, double step) {
  UMBRAGE_CHECK(step > 0.0, "a grid's step is a length");
  const auto parts = matching(scene, patterns);
  if (parts.empty()) return fail(ErrorCode::usage, "no part is named " + named(patterns), scene.source);
  double count = 0.0;
  for (const auto* part : parts)
    forTriangles(scene, *part, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      count += 1.0 + 0.5 * glm::length(glm::cross(b - a, c - a)) / (step * step);
    });
  if (auto fits = checkCount(count); !fits) return tl::unexpected(fits.error());
  ReceiverSet set;
  for (const auto* part : parts)
    forTriangles(scene, *part,
                 [&](const Vec3& a, const Vec3& b, const Vec3& c) { addFace(a, b, c, step, set.receivers); });
  set.spacing = step;
  set.described = fmt::format("points on all faces of {}, {:g} apart", named(patterns), step);
  return set;
}

Result<ReceiverSet> readReceivers(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  ReceiverSet set;
  std::size_t line = 0;
  const auto wrong = [&](const std::string& what) {
    return fail(ErrorCode::input, what, fmt::format("{}, line {}", path.string(), line));
  };
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  while (!text.empty()) {
    ++line;
    const std::size_t end = text.find('\n');
    std::string_view row = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (row.ends_with('\r')) row.remove_suffix(1);
    if (line == 1) {
      if (row != "x,y,z,nx,ny,nz") return wrong("the header x,y,z,nx,ny,nz is wanted");
      continue;
    }
    if (row.find_first_not_of(" \t") == row.npos) continue;
    double value[6];
    for (int k = 0; k < 6; ++k) {
      const std::size_t comma = row.find(',');
      if ((comma == row.npos) != (k == 5)) return wrong("six numbers are wanted: x,y,z,nx,ny,nz");
      std::string_view word = row.substr(0, comma);
      while (word.starts_with(' ') || word.starts_with('\t')) word.remove_prefix(1);
      while (word.ends_with(' ') || word.ends_with('\t')) word.remove_suffix(1);
      const std::string shown(word.substr(0, 40));
      if (word.starts_with('+')) word.remove_prefix(1);
      const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value[k]);
      if (error != std::errc() || stop != word.data() + word.size() || !(std::abs(value[k]) <= 1e12))
        return wrong(fmt::format("'{}' is no number", shown));
      row.remove_prefix(comma == row.npos ? row.size() : comma + 1);
    }
    set.receivers.push_back({{value[0], value[1], value[2]}, {value[3], value[4], value[5]}});
    if (glm::length(set.receivers.back().normal) < 1e-9) return wrong("the normal nx,ny,nz has no length");
    if (set.receivers.size() > kMostReceivers) return wrong("these are too many points");
  }
  if (line == 0) return wrong("the file is empty; the header x,y,z,nx,ny,nz is wanted");
  set.described = fmt::format("{} points of {}, where they are, SHA-256 {}", set.receivers.size(),
                              path.filename().string(), sha256(*bytes));
  return set;
}

}  // namespace umbrage::study
