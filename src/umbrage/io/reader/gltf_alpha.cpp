#include "umbrage/io/reader/gltf_alpha.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "umbrage/io/load.hpp"
#include "umbrage/io/reader/gltf_accessor.hpp"
#include "umbrage/io/reader/gltf_primitive.hpp"

namespace umbrage::io::reader {
namespace {

/// Cells that may be looked at for all primitives together: a quarter of a second.
constexpr double kMostCells = 40e6;
/// Rectangles of cells: about a second.
constexpr std::size_t kMostEffort = 2'000'000;
/// With textures that let something through; what they take of memory while they are cut.
constexpr std::size_t kMostTextured = 2'000'000;

std::vector<std::size_t> placingsOf(const tinygltf::Model& model) {
  std::vector<std::size_t> placings(model.meshes.size(), 0);
  for (const tinygltf::Node& node : model.nodes)
    if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) < placings.size())
      ++placings[static_cast<std::size_t>(node.mesh)];
  return placings;
}

bool hasAlpha(const tinygltf::Model& model, int accessor) {
  return accessor >= 0 && static_cast<std::size_t>(accessor) < model.accessors.size() &&
         model.accessors[static_cast<std::size_t>(accessor)].type == TINYGLTF_TYPE_VEC4;
}

}  // namespace

GltfAlpha::GltfAlpha(const tinygltf::Model& model, GltfTextures textures, const AlphaLimits& limits)
    : model_(model), effort_(kMostEffort) {
  findJobs(textures);
  for (auto& [key, job] : jobs_) {
    const Coverage& coverage = *job.material.coverage;
    job.level = coverage.isUniform() || limits.mostTriangles == 0 ? coverage.levels() : limits.finestLevel;
  }
  boundWork();
  cutAll(limits);
}

void GltfAlpha::findJobs(GltfTextures& textures) {
  const auto placings = placingsOf(model_);
  std::size_t textured = 0;
  std::map<int, std::optional<MaterialCoverage>> materials;
  for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
    if (placings[m] == 0) continue;
    const auto& primitives = model_.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const int index = primitives[p].material;
      if (index < 0 || static_cast<std::size_t>(index) >= model_.materials.size()) continue;
      const tinygltf::Material& material = model_.materials[static_cast<std::size_t>(index)];
      const auto colour = primitives[p].attributes.find("COLOR_0");
      if (material.alphaMode != "OPAQUE" && colour != primitives[p].attributes.end() &&
          hasAlpha(model_, colour->second))
        complaints_.add("the alpha of corners' colours is not read");
      if (!materials.contains(index)) materials[index] = textures.of(material, complaints_);
      const auto& coverage = materials[index];
      if (!coverage) continue;
      auto triangles = placed(primitives[p], *coverage);
      if (textured += triangles.size(); textured > kMostTextured) {
        complaints_.add(
            "there are too many triangles with textures that let something through: the last count as a whole");
        return;
      }
      if (!triangles.empty()) jobs_[{static_cast<int>(m), p}] = {*coverage, std::move(triangles), placings[m]};
    }
  }
}

std::vector<TexturedTriangle> GltfAlpha::placed(const tinygltf::Primitive& primitive,
                                                const MaterialCoverage& material) {
  // What is broken is an error when the primitive is read in earnest.
  const auto given = readPrimitive(model_, primitive);
  if (!given || !*given) return {};
  const auto set = primitive.attributes.find("TEXCOORD_" + std::to_string(material.texCoord));
  std::vector<Vec2> coordinates;
  if (set != primitive.attributes.end())
    if (auto read = readCoordinates(model_, set->second)) coordinates = std::move(*read);
  if (coordinates.empty()) complaints_.add("triangles without texture coordinates take the mean of their texture");
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  std::vector<TexturedTriangle> triangles;
  triangles.reserve((*given)->triangles.size());
  for (const mesh::Triangle& t : (*given)->triangles) {
    TexturedTriangle out;
    bool exists = true;
    for (std::size_t k = 0; k < 3; ++k) {
      exists = exists && t[k] < (*given)->points.size();
      out.corners[k] = exists ? (*given)->points[t[k]] : Vec3(kNowhere);  // counted as such by tidy()
      out.places[k] = t[k] < coordinates.size() ? material.place(coordinates[t[k]]) : Vec2(kNowhere);
    }
    triangles.push_back(out);
  }
  return triangles;
}

// Coarser cells for who asks for the most, until it is little enough.
void GltfAlpha::boundWork() {
  std::vector<std::pair<double, Job*>> work;
  double total = 0.0;
  for (auto& [key, job] : jobs_) {
    work.emplace_back(cellsToLookAt(job.triangles, *job.material.coverage, job.level), &job);
    total += work.back().first;
  }
  std::make_heap(work.begin(), work.end());
  while (total > kMostCells) {
    std::pop_heap(work.begin(), work.end());
    auto& [cells, job] = work.back();
    total -= cells;
    cells = cellsToLookAt(job->triangles, *job->material.coverage, ++job->level);
    total += cells;
    std::push_heap(work.begin(), work.end());
  }
}

void GltfAlpha::cutOne(Job& job, const AlphaLimits& limits) {
  const Coverage& coverage = *job.material.coverage;
  // A triangle that stays whole is none of the limit's.
  const std::size_t most = job.triangles.size() + limits.mostTriangles / job.placings;
  for (;; ++job.level) {
    if (effort_ == 0) job.level = std::max(job.level, coverage.levels());
    auto pieces = cutByCoverage(job.triangles, coverage, job.material.rule, job.level, most, effort_);
    if (!pieces) continue;
    job.cut = {std::move(*pieces), job.material.transmits, job.material.rule.decides};
    return;
  }
}

// Whenever there are too many, what came to more by the most is done again with coarser cells: so there never are many more than the limit.
void GltfAlpha::cutAll(const AlphaLimits& limits) {
  long total = 0;
  std::vector<std::pair<long, Job*>> excesses;
  for (auto& [key, job] : jobs_) {
    cutOne(job, limits);
    total += job.excess();
    excesses.emplace_back(job.excess(), &job);
    std::push_heap(excesses.begin(), excesses.end());
    // Triangles that stay whole exceed nothing, so the largest excess is that of a job that can be done more coarsely.
    while (total > static_cast<long>(limits.mostTriangles)) {
      std::pop_heap(excesses.begin(), excesses.end());
      auto& [excess, most] = excesses.back();
      total -= excess;
      ++most->level;
      cutOne(*most, limits);
      total += excess = most->excess();
      std::push_heap(excesses.begin(), excesses.end());
    }
  }
}

const CutPrimitive* GltfAlpha::find(int mesh, std::size_t primitive) const {
  const auto found = jobs_.find({mesh, primitive});
  return found == jobs_.end() ? nullptr : &found->second.cut;
}

std::vector<std::string> GltfAlpha::notes() const {
  std::size_t cut = 0, pieces = 0, dropped = 0, unplaced = 0, coarsest = 0, whole = 0;
  double worstArea = 0.0, worstPart = 0.0;
  for (const auto& [key, job] : jobs_) {
    const CutPieces& p = job.cut.pieces;
    cut += p.cut, pieces += p.pieces, dropped += p.dropped, unplaced += p.unplaced;
    worstArea = std::max(worstArea, p.worstArea), worstPart = std::max(worstPart, p.worstPart);
    const bool uncut = job.level >= job.material.coverage->levels();
    if (uncut && !job.material.coverage->isUniform()) whole += job.triangles.size();
    if (!uncut) coarsest = std::max(coarsest, job.level);
  }
  const std::string prefix(kAlphaNote);
  std::vector<std::string> notes;
  if (cut > 0)
    notes.push_back(prefix + fmt::format("{} cut into {} along {}", counted(cut, "triangle"), counted(pieces, "piece"),
                                         coarsest == 0
                                             ? "texels"
                                             : fmt::format("cells of up to {0} x {0} texels",
                                                           std::size_t{1} << std::min<std::size_t>(coarsest, 30))));
  if (dropped > 0) notes.push_back(prefix + counted(dropped, "triangle") + " of which nothing is there left out");
  if (whole > 0)
    notes.push_back(prefix + counted(whole, "triangle") + " left whole by the mean of their texture: too many to cut");
  if (unplaced > 0)
    notes.push_back(prefix + counted(unplaced, "triangle") + " without a usable place on their texture take its mean");
  if (worstArea > 5e-5)
    notes.push_back(
        prefix + fmt::format("up to {:.1f} % of a triangle's area is there too much or too little", 100.0 * worstArea));
  if (worstPart > 5e-4)
    notes.push_back(
        prefix +
        fmt::format("what a piece lets through is the mean of its texels, which differ from it by up to {:.3f}",
                    worstPart + 0.5 / 64));
  return notes;
}

}  // namespace umbrage::io::reader
