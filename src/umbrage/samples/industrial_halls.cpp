// Halls with saw-tooth roofs, and the conveyor that climbs from a hall to the silos.
#include <array>
#include <vector>

#include "umbrage/samples/detail/industrial.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail::plant {
namespace {

constexpr double kHalfLength = 30.0, kHalfDepth = 16.0, kEaves = 8.0, kTooth = 3.5;
constexpr int kTeeth = 8;
constexpr double kBay = 2.0 * kHalfLength / kTeeth;

/// The conveyor's axis: from the hall's end up to the silos' heads.
constexpr Vec3 kLow{56.0, 40.0, 9.0}, kHigh{80.0, 34.0, 27.0};
constexpr double kHalfWidth = 1.25, kHalfHeight = 1.5;
constexpr int kPanels = 14;

struct Truss {
  Vec3 forward = glm::normalize(kHigh - kLow);
  Vec3 side = glm::normalize(glm::cross(Vec3(0, 0, 1), kHigh - kLow));
  Vec3 up = glm::cross(forward, side);
  [[nodiscard]] Vec3 at(double along, double across, double above) const {
    return kLow + along * (kHigh - kLow) + across * side + above * up;
  }
};

}  // namespace

Part sawToothHall(const Colours& colour) {
  Part part("Hall", colour.cladding);
  // The teeth's steep, glazed sides look to -x here.
  Outline section{{-kHalfLength, 0.0}, {kHalfLength, 0.0}, {kHalfLength, kEaves}};
  for (int i = kTeeth - 1; i >= 0; --i) {
    const double left = -kHalfLength + i * kBay;
    section.emplace_back(left + 1.0, kEaves + kTooth);
    section.emplace_back(left, kEaves);
  }
  addPrism(part, section, {0, kHalfDepth, 0}, {1, 0, 0}, {0, 0, 1}, {0, -2 * kHalfDepth, 0});
  part.use(colour.concrete);
  const std::array<Vec3, 4> foot{Vec3{-kHalfLength, -kHalfDepth, 0.375},
                                 {kHalfLength, -kHalfDepth, 0.375},
                                 {kHalfLength, kHalfDepth, 0.375},
                                 {-kHalfLength, kHalfDepth, 0.375}};
  addSweep(part, foot, rectangle(0.375, 0.75), Ends::joined);
  part.use(colour.blue);
  for (const double y : {-kHalfDepth, kHalfDepth})
    for (int i = 0; i <= kTeeth; ++i) {
      const double x = -kHalfLength + i * kBay + (i == 0 ? 0.125 : i == kTeeth ? -0.125 : 0.0);
      addBox(part, {x - 0.25, y - 0.25, 0}, {x + 0.25, y + 0.25, kEaves + 0.125});
    }
  part.use(colour.door);
  for (const double y : {-kHalfDepth, kHalfDepth})
    for (const double x : {-18.75, 11.25}) addBox(part, {x - 2.25, y - 0.3125, 0}, {x + 2.25, y + 0.3125, 4.5});
  part.use(colour.steel);
  for (int i = 0; i < kTeeth; i += 2)
    addRevolved(part, {-kHalfLength + (i + 0.625) * kBay, 6.0, kEaves},
                {{0, 0}, {0.5, 0}, {0.5, 3.25}, {0.875, 3.25}, {0.875, 3.75}, {0, 4.125}}, 12);
  return part;
}

/// Panes a hand's breadth in front of the steep sides, and a ribbon of windows along the walls: single sheets.
Part sawToothGlass(const Colours& colour) {
  Part part("Glazing", colour.glass);
  for (int i = 0; i < kTeeth; ++i) {
    const double left = -kHalfLength + i * kBay;
    const Vec3 foot{left + 0.1875, 0, kEaves + 0.9375}, head{left + 0.8125, 0, kEaves + 3.125};
    for (double y = -15.0; y < 15.0; y += 3.0)
      addSheet(part, foot + Vec3(0, y + 2.75, 0), foot + Vec3(0, y + 0.25, 0), head + Vec3(0, y + 0.25, 0),
               head + Vec3(0, y + 2.75, 0));
  }
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < kTeeth; ++i) {
      const double y = side * (kHalfDepth + 0.125), a = -side * 2.75, x = -kHalfLength + (i + 0.5) * kBay;
      addSheet(part, {x + a, y, 5.25}, {x - a, y, 5.25}, {x - a, y, 7.0}, {x + a, y, 7.0});
    }
  return part;
}

Part conveyorTruss(const Colours& colour) {
  Part part("Truss", colour.steel);
  const Truss truss;
  for (const double across : {-kHalfWidth, kHalfWidth})
    for (const double above : {-kHalfHeight, kHalfHeight})
      addBeam(part, truss.at(0, across, above), truss.at(1, across, above), 0.25);
  for (int i = 0; i <= kPanels; ++i) {
    const double a = static_cast<double>(i) / kPanels, b = static_cast<double>(i + 1) / kPanels;
    for (const double across : {-kHalfWidth, kHalfWidth}) {
      addBeam(part, truss.at(a, across, -kHalfHeight), truss.at(a, across, kHalfHeight), 0.1563);
      if (i < kPanels)
        addBeam(part, truss.at(a, across, i % 2 == 0 ? -kHalfHeight : kHalfHeight),
                truss.at(b, across, i % 2 == 0 ? kHalfHeight : -kHalfHeight), 0.125);
    }
    addBeam(part, truss.at(a, -kHalfWidth, -kHalfHeight), truss.at(a, kHalfWidth, -kHalfHeight), 0.1875);
    addBeam(part, truss.at(a, -kHalfWidth, kHalfHeight), truss.at(a, kHalfWidth, kHalfHeight), 0.1875);
  }
  for (const double along : {0.25, 0.5}) {
    const Vec3 left = truss.at(along, -kHalfWidth, -kHalfHeight), right = truss.at(along, kHalfWidth, -kHalfHeight);
    const Vec3 spread = 1.25 * truss.side;
    const Vec3 leftFoot = Vec3(left.x, left.y, 0.25) - spread, rightFoot = Vec3(right.x, right.y, 0.25) + spread;
    for (const Vec3& foot : {leftFoot, rightFoot})
      addBox(part, foot - Vec3(0.5, 0.5, 0.25), foot + Vec3(0.5, 0.5, 0.125));
    addBeam(part, leftFoot, left, 0.375);
    addBeam(part, rightFoot, right, 0.375);
    for (int i = 0; i < 4; ++i) {
      const double low = i / 4.0, high = (i + 1) / 4.0;
      addBeam(part, glm::mix(leftFoot, left, low), glm::mix(rightFoot, right, high), 0.1875);
      addBeam(part, glm::mix(leftFoot, left, high), glm::mix(rightFoot, right, high), 0.2188);
    }
  }
  return part;
}

Part conveyorGallery(const Colours& colour) {
  Part part("Gallery", colour.cladding);
  const Truss truss;
  const Outline shell{{-1.0, -1.25}, {1.0, -1.25}, {1.0, 0.75}, {0.0, 1.1875}, {-1.0, 0.75}};
  part.use(colour.blue);
  addPrism(part, shell, kLow - truss.forward, truss.side, truss.up, kHigh - kLow + 2.0 * truss.forward);
  part.use(colour.cladding);
  addBox(part, {77.0, 30.0, 24.5}, {87.0, 42.0, 30.0});
  addBox(part, {54.0, 37.0, 0.0}, {60.0, 43.0, 11.5});
  return part;
}

}  // namespace umbrage::samples::detail::plant
