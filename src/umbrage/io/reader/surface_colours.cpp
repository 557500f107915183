#include "umbrage/io/reader/surface_colours.hpp"

#include <array>

#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

struct TypeColour {
  std::string_view type;
  std::uint32_t srgb;
};

// Muted tones of the things themselves, so that shadows stay readable on all of them.
constexpr std::array kColours = {
    TypeColour{"RoofSurface", 0xb5604a},
    TypeColour{"WallSurface", 0xe3dccb},
    TypeColour{"GroundSurface", 0x8c857b},
    TypeColour{"OuterCeilingSurface", 0xcfc8b8},
    TypeColour{"OuterFloorSurface", 0xa9a196},
    TypeColour{"InteriorWallSurface", 0xede8dd},
    TypeColour{"FloorSurface", 0xb09a7c},
    TypeColour{"CeilingSurface", 0xf2efe8},
    TypeColour{"ClosureSurface", 0xc9c9c9},
    TypeColour{"Window", 0x8fb0c9},
    TypeColour{"Door", 0x7d5a3c},
    TypeColour{"WaterSurface", 0x6f9fbf},
    TypeColour{"WaterGroundSurface", 0x7f8f86},
    TypeColour{"TrafficArea", 0x9b9b9b},
    TypeColour{"AuxiliaryTrafficArea", 0xb3b0a4},
    TypeColour{"Building", 0xd9cdb8},
    TypeColour{"BuildingPart", 0xd9cdb8},
    TypeColour{"BuildingInstallation", 0xc4b69c},
    TypeColour{"Bridge", 0xb7b2a8},
    TypeColour{"BridgePart", 0xb7b2a8},
    TypeColour{"Tunnel", 0x97928a},
    TypeColour{"Road", 0x9b9b9b},
    TypeColour{"Railway", 0x8a8178},
    TypeColour{"TransportSquare", 0xb3b0a4},
    TypeColour{"TINRelief", 0xa8b08a},
    TypeColour{"LandUse", 0xb6bd94},
    TypeColour{"PlantCover", 0x86a86b},
    TypeColour{"SolitaryVegetationObject", 0x6c9a55},
    TypeColour{"WaterBody", 0x6f9fbf},
    TypeColour{"CityFurniture", 0x8f8f99},
};
constexpr std::uint32_t kNeutral = 0xc8c8c8;

}  // namespace

Vec3 colourOfType(std::string_view type) {
  std::uint32_t srgb = kNeutral;
  for (const TypeColour& known : kColours)
    if (known.type == type) srgb = known.srgb;
  return linearFromSrgb(Vec3((srgb >> 16) & 255, (srgb >> 8) & 255, srgb & 255) / 255.0);
}

}  // namespace umbrage::io::reader
