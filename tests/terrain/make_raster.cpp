// Writes a city of made-up towers on gentle hills as a GeoTIFF of N x N cells of 1 m (EPSG:25833), uncompressed, a strip a row:
//   umbrage_make_raster N FILE.tif
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

void put(std::vector<unsigned char>& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
}
void putDouble(std::vector<unsigned char>& bytes, double value) {
  std::uint64_t bits = 0;
  static_assert(sizeof bits == sizeof value);
  __builtin_memcpy(&bits, &value, sizeof bits);
  put(bytes, bits, 8);
}

std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16, x *= 0x7feb352dU, x ^= x >> 15, x *= 0x846ca68bU;
  return x ^ (x >> 16);
}

// Blocks of 40 m with streets of 12 m; most houses low, few high.
float heightAt(std::uint32_t column, std::uint32_t row) {
  const float hill = 6.0F * std::sin(float(column) * 0.0017F) + 5.0F * std::cos(float(row) * 0.0023F);
  if (column % 40 < 12 || row % 40 < 12) return hill;
  const std::uint32_t dice = mix(column / 40 * 65537U + row / 40);
  const float house = 6.0F + float(dice % 16U);
  return hill + (dice % 97U == 0 ? 60.0F : house);
}

}  // namespace

int main(int count, char** words) {
  const auto side = count == 3 ? static_cast<std::uint32_t>(std::strtoul(words[1], nullptr, 10)) : 0U;
  std::FILE* out = side > 1 && side <= 30000 ? std::fopen(words[2], "wb") : nullptr;
  if (out == nullptr) return std::fputs("umbrage_make_raster N FILE.tif\n", stderr), 2;
  // Header, directory, then what does not fit into it, then the strips.
  struct Entry {
    std::uint16_t tag, type;
    std::uint32_t count, value;
  };
  const std::uint32_t entries = 13, after = 8 + 2 + entries * 12 + 4;
  const std::uint32_t offsets = after, sizes = offsets + 4 * side, scale = sizes + 4 * side, tie = scale + 24,
                      keys = tie + 48;
  const std::uint32_t data = keys + 32;
  const Entry directory[entries] = {
      {256, 4, 1, side},       {257, 4, 1, side},   {258, 3, 1, 32},     {259, 3, 1, 1},        {262, 3, 1, 1},
      {273, 4, side, offsets}, {277, 3, 1, 1},      {278, 4, 1, 1},      {279, 4, side, sizes}, {339, 3, 1, 3},
      {33550, 12, 3, scale},   {33922, 12, 6, tie}, {34735, 3, 16, keys}};
  std::vector<unsigned char> head = {'I', 'I', 42, 0};
  put(head, 8, 4);
  put(head, entries, 2);
  for (const Entry& e : directory)
    put(head, e.tag, 2), put(head, e.type, 2), put(head, e.count, 4), put(head, e.value, 4);
  put(head, 0, 4);
  for (std::uint32_t row = 0; row < side; ++row) put(head, data + std::uint64_t(row) * side * 4, 4);
  for (std::uint32_t row = 0; row < side; ++row) put(head, std::uint64_t(side) * 4, 4);
  for (const double v : {1.0, 1.0, 0.0}) putDouble(head, v);
  for (const double v : {0.0, 0.0, 0.0, 390000.0, 5820000.0, 0.0}) putDouble(head, v);
  // Projected, cells are areas, EPSG:25833.
  for (const int v : {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 25833}) put(head, std::uint64_t(v), 2);
  std::fwrite(head.data(), 1, head.size(), out);
  std::vector<float> line(side);
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) line[column] = heightAt(column, row);
    std::fwrite(line.data(), sizeof(float), side, out);
  }
  return std::fclose(out) == 0 ? 0 : 1;
}
