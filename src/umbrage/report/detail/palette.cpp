#include "umbrage/report/detail/palette.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/math/vec.hpp"

namespace umbrage::report::detail {
namespace {

constexpr std::size_t kMostColours = 256;
// Roots of counts: a small label deserves colours of its own beside a large ground.
constexpr double kCountPower = 0.5;

struct Sample {
  Vec3 colour;
  double weight;
};

struct Group {
  std::vector<Sample> samples;
  Vec3 mean{0.0}, variance{0.0};  // variance: weighted sums, not divided
  [[nodiscard]] double spread() const { return std::max({variance.x, variance.y, variance.z}); }
};

Group groupOf(std::vector<Sample> samples) {
  Group group{std::move(samples)};
  double weight = 0.0;
  for (const Sample& s : group.samples) {
    group.mean += s.weight * s.colour;
    weight += s.weight;
  }
  group.mean /= std::max(weight, 1e-300);
  for (const Sample& s : group.samples) group.variance += s.weight * (s.colour - group.mean) * (s.colour - group.mean);
  return group;
}

std::pair<Group, Group> cut(Group group) {
  const Vec3& v = group.variance;
  const int axis = v.x >= v.y && v.x >= v.z ? 0 : v.y >= v.z ? 1 : 2;
  const auto middle = std::stable_partition(group.samples.begin(), group.samples.end(),
                                            [&](const Sample& s) { return s.colour[axis] <= group.mean[axis]; });
  std::vector<Sample> upper(middle, group.samples.end());
  group.samples.erase(middle, group.samples.end());
  return {groupOf(std::move(group.samples)), groupOf(std::move(upper))};
}

std::vector<Group> divide(std::vector<Sample> samples) {
  std::vector<Group> groups{groupOf(std::move(samples))};
  while (groups.size() < kMostColours) {
    const auto widest = std::max_element(groups.begin(), groups.end(),
                                         [](const Group& a, const Group& b) { return a.spread() < b.spread(); });
    if (widest->spread() < 1e-9 || widest->samples.size() < 2) break;
    auto [lower, upper] = cut(std::move(*widest));
    *widest = std::move(lower);
    groups.push_back(std::move(upper));
  }
  return groups;
}

std::uint8_t code(double v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0))); }

Vec3 colourOf(const ColourCount::Cell& cell, std::size_t index) {
  if (cell.count > 0) return Vec3(double(cell.r), double(cell.g), double(cell.b)) / double(cell.count);
  return Vec3(double(index / 1024), double(index / 32 % 32), double(index % 32)) * 8.0 + Vec3(3.5);
}

}  // namespace

void ColourCount::add(const image::RgbImage& picture) {
  for (const image::Rgb8 c : picture.pixels()) {
    Cell& cell = cells_[cellOf(c)];
    ++cell.count;
    cell.r += c.r;
    cell.g += c.g;
    cell.b += c.b;
  }
}

Palette::Palette(const ColourCount& count) : nearest_(ColourCount::kCells) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < count.cells().size(); ++i)
    if (const auto& cell = count.cells()[i]; cell.count > 0)
      samples.push_back({colourOf(cell, i), std::pow(double(cell.count), kCountPower)});
  for (const Group& group : divide(std::move(samples)))
    colours_.push_back({code(group.mean.x), code(group.mean.y), code(group.mean.z)});
  for (std::size_t i = 0; i < ColourCount::kCells; ++i) {
    const Vec3 wanted = colourOf(count.cells()[i], i);
    double best = 1e300;
    for (std::size_t k = 0; k < colours_.size(); ++k) {
      const Vec3 d = wanted - Vec3(colours_[k].r, colours_[k].g, colours_[k].b);
      if (const double distance = glm::dot(d, d); distance < best) {
        best = distance;
        nearest_[i] = static_cast<std::uint8_t>(k);
      }
    }
  }
}

image::GreyImage Palette::indices(const image::RgbImage& picture) const {
  image::GreyImage out(picture.width(), picture.height());
  for (std::size_t i = 0; i < out.size(); ++i) out.pixels()[i] = nearest_[ColourCount::cellOf(picture.pixels()[i])];
  return out;
}

}  // namespace umbrage::report::detail
