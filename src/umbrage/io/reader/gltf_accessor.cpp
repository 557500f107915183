#include "umbrage/io/reader/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <string>

namespace umbrage::io::reader {
namespace {

// More elements than this no scene needs, and an accessor without data could ask for any number.
constexpr std::size_t kMaxElements = 100'000'000;

using Bytes = std::span<const unsigned char>;

std::string named(const char* what, int index) { return std::string(what) + " " + std::to_string(index); }

struct Layout {
  int componentType = 0;
  std::size_t components = 1;
  bool normalized = false;
  [[nodiscard]] std::size_t componentSize() const {
    const int size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(componentType));
    return size > 0 && size <= 4 ? static_cast<std::size_t>(size) : 0;
  }
  [[nodiscard]] std::size_t elementSize() const { return componentSize() * components; }
};

// A run of elements: where it begins, how far apart they are.
struct Run {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
};

Result<Run> locate(const tinygltf::Model& model, int viewIndex, std::size_t offset, std::size_t count,
                   const Layout& layout, bool strided) {
  if (viewIndex < 0 || static_cast<std::size_t>(viewIndex) >= model.bufferViews.size())
    return fail(ErrorCode::input, "does not exist", named("bufferView", viewIndex));
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(viewIndex)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size())
    return fail(ErrorCode::input, "the buffer does not exist", named("bufferView", viewIndex));
  const Bytes buffer(model.buffers[static_cast<std::size_t>(view.buffer)].data);
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
    return fail(ErrorCode::input, "reaches beyond its buffer", named("bufferView", viewIndex));
  const std::size_t size = layout.elementSize();
  const std::size_t stride = strided && view.byteStride != 0 ? view.byteStride : size;
  if (stride > 4096) return fail(ErrorCode::input, "the byteStride is out of range", named("bufferView", viewIndex));
  const std::size_t room = offset <= view.byteLength ? view.byteLength - offset : 0;
  if (count > 0 &&
      (offset > view.byteLength || size > room || (count - 1) > (room - size) / std::max<std::size_t>(stride, 1)))
    return fail(ErrorCode::input, "holds less than its accessor asks for", named("bufferView", viewIndex));
  return Run{buffer.data() + view.byteOffset + offset, stride};
}

template <class T>
double component(const unsigned char* at, bool normalized) {
  T value;
  std::memcpy(&value, at, sizeof value);
  if (!normalized) return static_cast<double>(value);
  return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double readComponent(const unsigned char* at, const Layout& layout) {
  switch (layout.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return component<std::int8_t>(at, layout.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return component<std::uint8_t>(at, layout.normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return component<std::int16_t>(at, layout.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return component<std::uint16_t>(at, layout.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return component<std::uint32_t>(at, layout.normalized);
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return component<float>(at, false);
    default: return 0.0;
  }
}

void copy(const Run& run, std::size_t count, const Layout& layout, double* out) {
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < layout.components; ++k)
      *out++ = readComponent(run.data + i * run.stride + k * layout.componentSize(), layout);
}

Result<void> applySparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const Layout& layout,
                         std::vector<double>& values) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0)
    return fail(ErrorCode::input, "the sparse part is out of range");
  const auto count = static_cast<std::size_t>(sparse.count);
  const Layout indexLayout{sparse.indices.componentType, 1, false};
  if (indexLayout.componentSize() == 0) return fail(ErrorCode::input, "the sparse indices have no known type");
  const auto indices = locate(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                              count, indexLayout, false);
  if (!indices) return tl::unexpected(indices.error());
  const auto changes =
      locate(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count, layout, false);
  if (!changes) return tl::unexpected(changes.error());
  for (std::size_t i = 0; i < count; ++i) {
    const double target = readComponent(indices->data + i * indices->stride, indexLayout);
    if (!(target >= 0.0 && target < static_cast<double>(accessor.count)))
      return fail(ErrorCode::input, "a sparse index is out of range");
    copy({changes->data + i * changes->stride, 0}, 1, layout,
         &values[static_cast<std::size_t>(target) * layout.components]);
  }
  return {};
}

Result<std::vector<double>> readValues(const tinygltf::Model& model, int index, std::size_t components) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size())
    return fail(ErrorCode::input, "does not exist", named("accessor", index));
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const Layout layout{accessor.componentType, components, accessor.normalized};
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != static_cast<int>(components) ||
      layout.componentSize() == 0)
    return fail(ErrorCode::input, "is of the wrong type for its use", named("accessor", index));
  if (accessor.count > kMaxElements) return fail(ErrorCode::input, "is too large", named("accessor", index));
  const bool stored = accessor.bufferView >= 0;
  const auto run =
      stored ? locate(model, accessor.bufferView, accessor.byteOffset, accessor.count, layout, true) : Run{};
  if (!run) return tl::unexpected(run.error());
  std::vector<double> values(accessor.count * components, 0.0);
  if (stored) copy(*run, accessor.count, layout, values.data());
  if (accessor.sparse.isSparse)
    if (auto applied = applySparse(model, accessor, layout, values); !applied)
      return fail(ErrorCode::input, applied.error().message, named("accessor", index));
  return values;
}

}  // namespace

Result<std::vector<Vec3>> readPoints(const tinygltf::Model& model, int accessor) {
  const auto values = readValues(model, accessor, 3);
  if (!values) return tl::unexpected(values.error());
  std::vector<Vec3> points;
  points.reserve(values->size() / 3);
  for (std::size_t i = 0; i + 2 < values->size(); i += 3)
    points.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2]);
  return points;
}

Result<std::vector<Vec2>> readCoordinates(const tinygltf::Model& model, int accessor) {
  const auto values = readValues(model, accessor, 2);
  if (!values) return tl::unexpected(values.error());
  std::vector<Vec2> coordinates;
  coordinates.reserve(values->size() / 2);
  for (std::size_t i = 0; i + 1 < values->size(); i += 2) coordinates.emplace_back((*values)[i], (*values)[i + 1]);
  return coordinates;
}

Result<std::vector<std::uint32_t>> readIndices(const tinygltf::Model& model, int accessor) {
  const auto values = readValues(model, accessor, 1);
  if (!values) return tl::unexpected(values.error());
  std::vector<std::uint32_t> indices;
  indices.reserve(values->size());
  for (const double value : *values)
    indices.push_back(value >= 0.0 && value < 4294967295.0 ? static_cast<std::uint32_t>(value) : 0xffffffffU);
  return indices;
}

}  // namespace umbrage::io::reader
