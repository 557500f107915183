#include "umbrage/io/reader/gltf_textures.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/base/file.hpp"
#include "umbrage/io/reader/files.hpp"
#ifdef UMBRAGE_READS_PNG
#include "umbrage/png/png.hpp"
#endif

namespace umbrage::io::reader {
namespace {

/// Of all textures together: what time and memory allow.
constexpr std::size_t kMostTexels = std::size_t{1} << 26;
constexpr std::size_t kMostPictureBytes = std::size_t{1} << 28;
constexpr int kRed = 0, kAlpha = 3;
constexpr int kEvenly = -1;  ///< no threshold

const tinygltf::Value* memberOf(const tinygltf::Value& value, const char* name) {
  return value.IsObject() && value.Has(name) ? &value.Get(name) : nullptr;
}

double numberOf(const tinygltf::Value* value, double otherwise) {
  return value != nullptr && value->IsNumber() ? value->GetNumberAsDouble() : otherwise;
}

Vec2 pairOf(const tinygltf::Value* value, const Vec2& otherwise) {
  if (value == nullptr || !value->IsArray() || value->ArrayLen() != 2) return otherwise;
  return {numberOf(&value->Get(0), otherwise.x), numberOf(&value->Get(1), otherwise.y)};
}

const tinygltf::Value* transmission(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_transmission");
  return extension == material.extensions.end() ? nullptr : &extension->second;
}

Wrap wrapOf(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

bool isPng(const std::vector<unsigned char>& bytes) {
  constexpr std::array<unsigned char, 4> kSignature = {0x89, 'P', 'N', 'G'};
  return bytes.size() > 4 && std::equal(kSignature.begin(), kSignature.end(), bytes.begin());
}
bool isJpeg(const std::vector<unsigned char>& bytes) {
  return bytes.size() > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

#ifdef UMBRAGE_READS_PNG
std::optional<CoverageCells> decoded(const std::vector<unsigned char>& bytes, int channel, int threshold,
                                     std::size_t mostTexels) {
  const auto picture = png::decode(std::as_bytes(std::span(bytes)), mostTexels);
  if (!picture || picture->empty()) return std::nullopt;
  CoverageCells cells{picture->width(), picture->height(), {}};
  cells.values.reserve(picture->size());
  for (const image::Rgba8& texel : picture->pixels()) {
    const int value = channel == kAlpha ? texel.a : texel.r;
    const int part = threshold == kEvenly ? value : value >= threshold ? 255 : 0;
    cells.values.push_back(static_cast<std::uint16_t>(257 * part));
  }
  return cells;
}
#else
std::optional<CoverageCells> decoded(const std::vector<unsigned char>&, int, int, std::size_t) { return std::nullopt; }
#endif

std::string namedPicture(const tinygltf::Image& picture, int index) {
  return picture.name.empty() ? picture.uri.empty() ? "picture " + std::to_string(index) : picture.uri : picture.name;
}

}  // namespace

Vec2 MaterialCoverage::place(const Vec2& coordinates) const {
  // Counter-clockwise as one sees it, the second coordinate pointing down.
  const Vec2 p = scale * coordinates;
  const double c = std::cos(turn), s = std::sin(turn);
  return offset + Vec2(c * p.x + s * p.y, c * p.y - s * p.x);
}

double transmissionOf(const tinygltf::Material& material) {
  const tinygltf::Value* extension = transmission(material);
  return extension == nullptr ? 0.0 : std::clamp(numberOf(memberOf(*extension, "transmissionFactor"), 0.0), 0.0, 1.0);
}

std::optional<MaterialCoverage> GltfTextures::of(const tinygltf::Material& material, Complaints& complaints) {
  const auto& base = material.pbrMetallicRoughness.baseColorTexture;
  const auto& factor = material.pbrMetallicRoughness.baseColorFactor;
  const double alpha = factor.size() == 4 ? std::clamp(factor[3], 0.0, 1.0) : 1.0;
  const bool masks = material.alphaMode == "MASK", blends = material.alphaMode == "BLEND";
  if (base.index >= 0 && (masks || blends) && alpha > 0.0) {
    const auto transform = base.extensions.find("KHR_texture_transform");
    const Sampled sampled{base.index, base.texCoord, transform == base.extensions.end() ? nullptr : &transform->second};
    // The least byte that the cutoff lets stay.
    const int threshold =
        static_cast<int>(std::clamp(std::ceil(255.0 * material.alphaCutoff / alpha - 1e-9), 0.0, 256.0));
    auto out = sample(sampled, kAlpha, masks ? threshold : kEvenly, complaints);
    if (out) out->rule.decides = masks, out->rule.factor = masks ? 1.0 : alpha;
    if (out) return out;
  }
  const tinygltf::Value* extension = transmission(material);
  const tinygltf::Value* texture = extension == nullptr ? nullptr : memberOf(*extension, "transmissionTexture");
  if (texture == nullptr || !(transmissionOf(material) > 0.0)) return std::nullopt;
  const tinygltf::Value* extensions = memberOf(*texture, "extensions");
  auto out = sample({static_cast<int>(numberOf(memberOf(*texture, "index"), -1.0)),
                     static_cast<int>(numberOf(memberOf(*texture, "texCoord"), 0.0)),
                     extensions == nullptr ? nullptr : memberOf(*extensions, "KHR_texture_transform")},
                    kRed, kEvenly, complaints);
  if (out) out->transmits = out->rule.keepsEmpty = true, out->rule.factor = transmissionOf(material);
  return out;
}

std::optional<MaterialCoverage> GltfTextures::sample(const Sampled& sampled, int channel, int threshold,
                                                     Complaints& complaints) {
  if (sampled.texture < 0 || static_cast<std::size_t>(sampled.texture) >= model_.textures.size()) return std::nullopt;
  const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(sampled.texture)];
  MaterialCoverage out;
  out.coverage = coverageOf(texture.source, channel, threshold, complaints);
  if (out.coverage == nullptr) return std::nullopt;
  if (out.coverage->isUniform() && out.coverage->mean() == CoverageCells::kAll) return std::nullopt;
  if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model_.samplers.size()) {
    const tinygltf::Sampler& sampler = model_.samplers[static_cast<std::size_t>(texture.sampler)];
    out.rule.u = wrapOf(sampler.wrapS), out.rule.v = wrapOf(sampler.wrapT);
  }
  out.texCoord = sampled.texCoord;
  if (sampled.transform != nullptr) {
    out.scale = pairOf(memberOf(*sampled.transform, "scale"), out.scale);
    out.offset = pairOf(memberOf(*sampled.transform, "offset"), out.offset);
    out.turn = numberOf(memberOf(*sampled.transform, "rotation"), 0.0);
    out.texCoord =
        static_cast<int>(std::clamp(numberOf(memberOf(*sampled.transform, "texCoord"), out.texCoord), -1.0, 1e6));
  }
  return out;
}

std::shared_ptr<const Coverage> GltfTextures::coverageOf(int picture, int channel, int threshold,
                                                         Complaints& complaints) {
  const auto key = std::tuple(picture, channel, threshold);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  auto& out = known_[key];
  if (picture < 0 || static_cast<std::size_t>(picture) >= model_.images.size()) {
    complaints.add("a texture has no picture of a kind that is read: its material counts as a whole");
    return out;
  }
  const auto bytes = bytesOf(picture);
  if (isJpeg(bytes) && channel == kAlpha && threshold <= 255) return out;
  auto cells = isPng(bytes) ? decoded(bytes, channel, threshold, kMostTexels - decoded_) : std::nullopt;
  if (!cells) {
    complaints.add("the texture '" + namedPicture(model_.images[static_cast<std::size_t>(picture)], picture) +
                   "' is missing, too large or no PNG: materials with it count as a whole");
    return out;
  }
  decoded_ += cells->values.size();
  return out = std::make_shared<const Coverage>(std::move(*cells));
}

std::vector<unsigned char> GltfTextures::bytesOf(int picture) const {
  if (const auto found = embedded_.find(picture); found != embedded_.end()) return found->second;
  const tinygltf::Image& image = model_.images[static_cast<std::size_t>(picture)];
  if (image.bufferView >= 0) {
    if (static_cast<std::size_t>(image.bufferView) >= model_.bufferViews.size()) return {};
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(image.bufferView)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model_.buffers.size()) return {};
    const auto& buffer = model_.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) return {};
    const auto begin = buffer.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
    return {begin, begin + static_cast<std::ptrdiff_t>(view.byteLength)};
  }
  const auto path = folder_ / decodedUri(image.uri);
  if (image.uri.empty() || !isInside(folder_, path)) return {};
  const auto bytes = readFile(path, kMostPictureBytes);
  if (!bytes) return {};
  const auto* begin = reinterpret_cast<const unsigned char*>(bytes->data());
  return {begin, begin + bytes->size()};
}

}  // namespace umbrage::io::reader
