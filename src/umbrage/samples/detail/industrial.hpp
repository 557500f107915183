#pragma once

#include <string>

#include "umbrage/samples/detail/part.hpp"

/// The pieces of the industrial site; those with a place stand there, the others around their own origin.
namespace umbrage::samples::detail::plant {

struct Colours {
  std::uint32_t concrete, cladding, blue, steel, white, silo, brick, red, silver, yellow, green, glass, door;
};

// industrial_storage.cpp
[[nodiscard]] Part tank(const Colours& colour);
[[nodiscard]] Part tankStair(const Colours& colour);
[[nodiscard]] Part bund(const Colours& colour, const Vec2& min, const Vec2& max);
[[nodiscard]] Part gasSphere(const Colours& colour);
[[nodiscard]] Part silo(const Colours& colour);
[[nodiscard]] Part chimney(const Colours& colour, const std::string& name, const Vec3& at, double height,
                           double radius);
[[nodiscard]] Part coolingShell(const Colours& colour, const Vec3& at);
[[nodiscard]] Part coolingBase(const Colours& colour, const Vec3& at);

[[nodiscard]] Part containers(const Colours& colour);

// industrial_halls.cpp
[[nodiscard]] Part sawToothHall(const Colours& colour);
[[nodiscard]] Part sawToothGlass(const Colours& colour);
[[nodiscard]] Part conveyorTruss(const Colours& colour);
[[nodiscard]] Part conveyorGallery(const Colours& colour);

// industrial_process.cpp
[[nodiscard]] Part rackFrames(const Colours& colour);
[[nodiscard]] Part rackPipes(const Colours& colour);
[[nodiscard]] Part processFrame(const Colours& colour);
[[nodiscard]] Part processVessels(const Colours& colour);
[[nodiscard]] Part processStairs(const Colours& colour);

}  // namespace umbrage::samples::detail::plant
