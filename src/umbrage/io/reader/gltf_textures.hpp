#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "umbrage/io/reader/alpha_cut.hpp"
#include "umbrage/io/reader/tidy.hpp"
#include "umbrage/io/reader/tinygltf.hpp"

namespace umbrage::io::reader {

/// The bytes of pictures that stand in the file's own text, by their number.
using EmbeddedPictures = std::map<int, std::vector<unsigned char>>;

/// What a material's texture says of how much of its surfaces is there.
struct MaterialCoverage {
  std::shared_ptr<const Coverage> coverage;
  CutRule rule;
  bool transmits = false;  ///< its parts are those that KHR_materials_transmission lets pass, not alpha
  int texCoord = 0;
  /// From texture coordinates to places on the texture: KHR_texture_transform.
  Vec2 scale{1.0}, offset{0.0};
  double turn = 0.0;  ///< radians

  [[nodiscard]] Vec2 place(const Vec2& coordinates) const;
};

/// The alpha of base colours and the red of transmission textures. PNG is decoded (where the library was built with it); JPEG has no alpha.
class GltfTextures {
 public:
  /// `folder`: of the file; pictures are read from there or below it. Both outlive this.
  GltfTextures(const tinygltf::Model& model, const EmbeddedPictures& embedded, std::filesystem::path folder)
      : model_(model), embedded_(embedded), folder_(std::move(folder)) {}

  /// None where all of a surface is there to the same part, or what the texture says cannot be read, which is a complaint.
  [[nodiscard]] std::optional<MaterialCoverage> of(const tinygltf::Material& material, Complaints& complaints);

 private:
  struct Sampled {
    int texture = -1, texCoord = 0;
    const tinygltf::Value* transform = nullptr;
  };
  [[nodiscard]] std::optional<MaterialCoverage> sample(const Sampled& sampled, int channel, int threshold,
                                                       Complaints& complaints);
  [[nodiscard]] std::shared_ptr<const Coverage> coverageOf(int picture, int channel, int threshold,
                                                           Complaints& complaints);
  [[nodiscard]] std::vector<unsigned char> bytesOf(int picture) const;

  const tinygltf::Model& model_;
  const EmbeddedPictures& embedded_;
  std::filesystem::path folder_;
  std::map<std::tuple<int, int, int>, std::shared_ptr<const Coverage>> known_;
  std::size_t decoded_ = 0;  ///< texels
};

/// The factor of KHR_materials_transmission, 0 without it.
[[nodiscard]] double transmissionOf(const tinygltf::Material& material);

}  // namespace umbrage::io::reader
