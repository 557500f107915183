#include "umbrage/io/writer/common.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace umbrage::io::writer {
namespace {

template <class Number>
void appendShortest(std::string& text, Number number) {
  std::array<char, 32> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

// Below this many levels the rest of a path is one name, and longer names are cut: no stack grows without bounds, here or in the
// parsers that will read the file.
constexpr std::size_t kMaxLevels = 64, kMaxName = 400;

bool isSingle(const Vec3& p) { return Vec3(Vec3f(p)) == p; }

}  // namespace

std::vector<std::string> levels(const std::string& path) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= path.size();) {
    const bool last = names.size() + 1 == kMaxLevels;
    const std::size_t end = last ? path.size() : std::min(path.find('/', begin), path.size());
    if (end > begin) names.push_back(path.substr(begin, std::min(end - begin, kMaxName)));
    begin = end + 1;
  }
  if (names.empty()) names.emplace_back("part");
  return names;
}

Mat4 toMetres(const scene::Scene& scene, scene::UpAxis up) {
  const double s = scene.metresPerUnit;
  if (scene.up == up) return {{s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, s, 0}, {0, 0, 0, 1}};
  // East stays +X; north is +Y with Z up and -Z with Y up.
  const double t = up == scene::UpAxis::y ? s : -s;
  return {{s, 0, 0, 0}, {0, 0, -t, 0}, {0, t, 0, 0}, {0, 0, 0, 1}};
}

SinglePrecision inSinglePrecision(const mesh::Mesh& m) {
  SinglePrecision result;
  // A whole number keeps the translation exact, and coordinates with few digits after the point stay so.
  if (!std::all_of(m.positions.begin(), m.positions.end(), isSingle)) result.origin = glm::round(m.bounds().centre());
  result.positions.reserve(m.positions.size());
  for (const Vec3& p : m.positions) result.positions.emplace_back(p - result.origin);
  return result;
}

std::vector<std::uint32_t> usedMaterials(const mesh::Mesh& m) {
  if (m.materials.empty()) return {0};
  std::vector<std::uint32_t> used = m.materials;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

Vec3 srgbFromLinear(const Vec3& linear) {
  Vec3 srgb;
  for (int k = 0; k < 3; ++k)
    srgb[k] = linear[k] <= 0.0031308 ? 12.92 * linear[k] : 1.055 * std::pow(linear[k], 1.0 / 2.4) - 0.055;
  return glm::clamp(srgb, 0.0, 1.0);
}

void append(std::string& text, double number) { appendShortest(text, number); }
void append(std::string& text, float number) { appendShortest(text, number); }
void append(std::string& text, std::uint32_t number) { appendShortest(text, number); }

}  // namespace umbrage::io::writer
