#pragma once

#include <map>
#include <utility>

#include "umbrage/io/reader/gltf_textures.hpp"

namespace umbrage::io::reader {

/// How finely textures may cut triangles.
struct AlphaLimits {
  std::size_t mostTriangles = 0;  ///< in all the pieces of a file, every placing of a mesh counted
  std::size_t finestLevel = 0;    ///< cells of 2^this texels on a side are the smallest
};

/// A primitive's triangles as its texture cuts them.
struct CutPrimitive {
  CutPieces pieces;
  bool transmits = false;  ///< as MaterialCoverage has it
  bool decides = false;    ///< pieces are there wholly
};

/// The triangles of a file cut by what their textures let through.
///
/// Every primitive is cut along texels (or `finestLevel`); while there are more triangles than the limit, that with the most is cut more
/// coarsely. Time and memory are bounded whatever the file says.
class GltfAlpha {
 public:
  GltfAlpha(const tinygltf::Model& model, GltfTextures textures, const AlphaLimits& limits);

  /// Null: its triangles stay as they are.
  [[nodiscard]] const CutPrimitive* find(int mesh, std::size_t primitive) const;
  /// What was done and what is approximated, for the user.
  [[nodiscard]] const Complaints& complaints() const { return complaints_; }
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  struct Job {
    MaterialCoverage material;
    std::vector<TexturedTriangle> triangles;
    std::size_t placings = 1, level = 0;
    CutPrimitive cut;
    /// Triangles that there are more of, all placings counted; below 0: fewer.
    [[nodiscard]] long excess() const {
      return static_cast<long>(placings) *
             (static_cast<long>(cut.pieces.triangles.size()) - static_cast<long>(triangles.size()));
    }
  };
  using Key = std::pair<int, std::size_t>;
  void findJobs(GltfTextures& textures);
  [[nodiscard]] std::vector<TexturedTriangle> placed(const tinygltf::Primitive& primitive,
                                                     const MaterialCoverage& material);
  void boundWork();
  void cutOne(Job& job, const AlphaLimits& limits);
  void cutAll(const AlphaLimits& limits);

  const tinygltf::Model& model_;
  std::map<Key, Job> jobs_;
  std::size_t effort_;
  Complaints complaints_;
};

}  // namespace umbrage::io::reader
