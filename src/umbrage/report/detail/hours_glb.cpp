#include "umbrage/report/detail/hours_glb.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "umbrage/report/detail/hours_scale.hpp"

namespace umbrage::report::detail {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out + "\"";
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// glTF's colours are linear.
std::uint8_t linear(std::uint8_t code) {
  const double c = code / 255.0, l = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  return static_cast<std::uint8_t>(std::lround(l * 255.0));
}

void chunk(std::string& out, const char* kind, std::string bytes, char fill) {
  while (bytes.size() % 4 != 0) bytes += fill;
  append(out, static_cast<std::uint32_t>(bytes.size()));
  out.append(kind, 4);
  out += bytes;
}

}  // namespace

std::string hoursGlb(const study::HoursTable& table, const scene::Scene& scene) {
  const auto& receivers = table.set.receivers;
  const double side = (table.set.lattice.columns > 0 ? table.set.lattice.step
                       : table.set.spacing > 0       ? 0.9 * table.set.spacing
                                                     : 1.0) /
                      2.0;
  Box3 box;
  for (const study::Receiver& r : receivers) box.add(r.position);
  const Vec3 middle = receivers.empty() ? Vec3(0.0) : glm::round(box.centre());
  const double most = scaleOf(table).top;
  std::string positions, colours, hours, indices;
  Vec3f low(1e30f), high(-1e30f);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const Vec3 n =
        glm::length(receivers[i].normal) > 0 ? glm::normalize(receivers[i].normal) : scene::upVector(scene.up);
    const Vec3 east = scene::eastVector(scene.up),
               along = std::abs(glm::dot(n, east)) < 0.9 ? east : scene::northVector(scene.up);
    const Vec3 v = glm::normalize(glm::cross(n, along)), u = glm::cross(v, n), lift = 0.002 * side * n;
    const image::Rgb8 c = hoursColour(table.hours[i] / most);
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
      const Vec3f p(receivers[i].position - middle + lift + side * (corner.x * u + corner.y * v));
      low = glm::min(low, p), high = glm::max(high, p);
      append(positions, p.x), append(positions, p.y), append(positions, p.z);
      for (const std::uint8_t channel : {linear(c.r), linear(c.g), linear(c.b), std::uint8_t{255}})
        append(colours, channel);
      append(hours, static_cast<float>(table.hours[i]));
    }
    const auto base = static_cast<std::uint32_t>(4 * i);
    for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) append(indices, base + k);
  }
  if (receivers.empty()) low = high = Vec3f(0.0f);
  std::string ledger;
  for (const study::LedgerLine& line : table.ledger)
    ledger += (ledger.empty() ? "" : ",") + quoted(line.subject) + ":" + quoted(line.text);
  const std::size_t n = 4 * receivers.size(), p = positions.size(), c = colours.size(), h = hours.size();
  // A scene with Z up is turned to glTF's Y up by the node that holds it.
  const std::string turn =
      scene.up == scene::UpAxis::z
          ? fmt::format("\"matrix\":[1,0,0,0,0,0,-1,0,0,1,0,0,{},{},{},1]", middle.x, middle.z, -middle.y)
          : fmt::format("\"translation\":[{},{},{}]", middle.x, middle.y, middle.z);
  const std::string mesh =
      receivers.empty()
          ? std::string()
          : std::string(
                R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1,"_HOURS":2},"indices":3,"material":0}]}],)");
  const std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0","generator":"Umbrage","extras":{{"ledger":{{{}}},"scale_hours":[0,{}]}}}},"scene":0,"scenes":[{{"nodes":[0]}}],)"
      R"("nodes":[{{"name":"hours of sun",{}{}}}],{})"
      R"("materials":[{{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":1}},"doubleSided":true,"extensions":{{"KHR_materials_unlit":{{}}}}}}],)"
      R"("extensionsUsed":["KHR_materials_unlit"])",
      ledger, most, turn, receivers.empty() ? "" : ",\"mesh\":0", mesh);
  const std::string data =
      receivers.empty()
          ? std::string("}")
          : fmt::format(
                R"(,"accessors":[{{"bufferView":0,"componentType":5126,"count":{0},"type":"VEC3","min":[{1},{2},{3}],"max":[{4},{5},{6}]}},)"
                R"({{"bufferView":1,"componentType":5121,"normalized":true,"count":{0},"type":"VEC4"}},{{"bufferView":2,"componentType":5126,"count":{0},"type":"SCALAR"}},)"
                R"({{"bufferView":3,"componentType":5125,"count":{7},"type":"SCALAR"}}],"bufferViews":[{{"buffer":0,"byteLength":{8},"target":34962}},)"
                R"({{"buffer":0,"byteOffset":{8},"byteLength":{9},"target":34962}},{{"buffer":0,"byteOffset":{10},"byteLength":{11},"target":34962}},)"
                R"({{"buffer":0,"byteOffset":{12},"byteLength":{13},"target":34963}}],"buffers":[{{"byteLength":{14}}}]}})",
                n, low.x, low.y, low.z, high.x, high.y, high.z, indices.size() / 4, p, c, p + c, h, p + c + h,
                indices.size(), p + c + h + indices.size());
  std::string body;
  chunk(body, "JSON", json + data, ' ');
  if (!receivers.empty()) chunk(body, std::string("BIN\0", 4).c_str(), positions + colours + hours + indices, '\0');
  std::string out("glTF");
  append(out, std::uint32_t{2});
  append(out, static_cast<std::uint32_t>(body.size() + 12));
  return out + body;
}

}  // namespace umbrage::report::detail
