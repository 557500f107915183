#include "umbrage/cut/detail/cone.hpp"

#include <cmath>
#include <numbers>

namespace umbrage::cut::detail {

std::optional<Cone> coneOf(const scene::Light& light) {
  const auto* spot = std::get_if<scene::SpotLight>(&light.shape);
  if (spot == nullptr || spot->cutoff >= Angle::degrees(180)) return std::nullopt;
  Cone cone;
  cone.insideIsLit = spot->cutoff <= Angle::degrees(90);
  const Vec3 axis = glm::normalize(spot->direction) * (cone.insideIsLit ? 1.0 : -1.0);
  const double angle = cone.insideIsLit ? spot->cutoff.radians() : std::numbers::pi - spot->cutoff.radians();
  if (spot->cutoff == Angle::degrees(90)) {
    cone.inwards = {axis};
    return cone;
  }
  const Vec3 x = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 y = glm::cross(axis, x);
  const double part = std::numbers::pi / kConeSides;
  const double slope = std::tan(angle) * std::sqrt(part / std::tan(part));
  for (int i = 0; i < kConeSides; ++i) {
    const double turn = 2.0 * part * i;
    cone.inwards.push_back(glm::normalize(slope * axis - std::cos(turn) * x - std::sin(turn) * y));
  }
  return cone;
}

std::vector<Vec3> linesOn(const Cone& cone, const Face& face, const Vec3& apex) {
  std::vector<Vec3> lines;
  const FaceFrame& f = face.frame;
  for (const Vec3& n : cone.inwards) {
    const Vec3 line(glm::dot(n, f.e1), glm::dot(n, f.e2), glm::dot(n, f.origin - apex));
    // A side along the face leaves its third number, a distance in space, to tell on which side all of it lies.
    const double length = glm::length(Vec2(line));
    lines.push_back(length > 1e-12 ? line / length : Vec3(0.0, 0.0, line.z));
  }
  return lines;
}

}  // namespace umbrage::cut::detail
