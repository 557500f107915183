#include <fmt/format.h>

#include <iterator>
#include <optional>

#include "umbrage/base/file.hpp"
#include "umbrage/geo/projection.hpp"
#include "umbrage/report/vector_map.hpp"

namespace umbrage::report {
namespace {

using outline::Polygon;
using outline::Ring;

// Names are UTF-8 as they come from io::loadScene; control characters have no place in them.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

// Without the zeros that a fixed number of digits ends in.
void appendNumber(std::string& out, double value, int digits) {
  fmt::format_to(std::back_inserter(out), "{:.{}f}", value, digits);
  if (digits == 0) return;
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
}

class Writer {
 public:
  explicit Writer(const geo::Projection* projection) : projection_(projection) {}

  void addFeature(const MapFeature& feature, const MapLayer& layer) {
    out_ += out_.empty() ? "\n" : ",\n";
    out_ += R"({"type":"Feature","properties":{"layer":)" + quoted(layer.name);
    for (const auto& [name, value] : feature.properties) {
      out_ += "," + quoted(name) + ":";
      if (const auto* text = std::get_if<std::string>(&value))
        out_ += quoted(*text);
      else
        fmt::format_to(std::back_inserter(out_), "{}", std::get<double>(value));
    }
    out_ += "},\"geometry\":";
    const auto& polygons = feature.region.polygons;
    if (polygons.size() == 1) {
      out_ += R"({"type":"Polygon","coordinates":)";
      addPolygon(polygons[0]);
    } else {
      out_ += R"({"type":"MultiPolygon","coordinates":[)";
      for (std::size_t i = 0; i < polygons.size(); ++i) {
        if (i > 0) out_ += ",";
        addPolygon(polygons[i]);
      }
      out_ += "]";
    }
    out_ += "}}";
  }
  [[nodiscard]] std::string take() { return std::move(out_); }
  [[nodiscard]] bool complete() const { return complete_; }

 private:
  void addPolygon(const Polygon& polygon) {
    out_ += "[";
    addRing(polygon.outer);
    for (const Ring& hole : polygon.holes) {
      out_ += ",";
      addRing(hole);
    }
    out_ += "]";
  }
  void addRing(const Ring& ring) {
    out_ += "[";
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      if (i > 0) out_ += ",";
      addPosition(ring[i % ring.size()]);
    }
    out_ += "]";
  }
  void addPosition(const Vec2& p) {
    out_ += "[";
    if (projection_ == nullptr) {
      fmt::format_to(std::back_inserter(out_), "{},{}", p.x, p.y);
    } else {
      const auto place = projection_->toDegrees(p);
      complete_ = complete_ && place;
      appendNumber(out_, place ? place->longitude : 0.0, 12);
      out_ += ",";
      appendNumber(out_, place ? place->latitude : 0.0, 12);
    }
    out_ += "]";
  }

  const geo::Projection* projection_;
  std::string out_;
  bool complete_ = true;
};

std::string header(const VectorMap& map, bool degrees) {
  std::string ledger =
      " \"Coordinates\":" + quoted(degrees ? "longitude and latitude in degrees on WGS84, projected from " + map.crs
                                           : "the scene's own: x east, y north, in its unit; no georeference");
  for (const auto& line : map.ledger) ledger += ",\n " + quoted(line.subject) + ":" + quoted(line.text);
  std::string text = "{\"type\":\"FeatureCollection\",\n\"name\":" + quoted(map.title) + ",\n";
  if (!degrees) text += "\"crs\":null,\n";
  return text + "\"umbrage\":{\n" + ledger + "\n},\n\"features\":[";
}

}  // namespace

Result<void> writeGeoJson(const VectorMap& map, const std::filesystem::path& path) {
  std::optional<geo::Projection> projection;
  if (!map.crs.empty()) {
    auto made = geo::Projection::make(map.crs);
    if (!made) return fail(made.error().code, "the scene " + made.error().message, path.string());
    projection = std::move(*made);
  }
  Writer writer(projection ? &*projection : nullptr);
  for (const MapFeature& feature : map.features)
    if (!feature.region.polygons.empty()) writer.addFeature(feature, map.layers[feature.layer]);
  if (!writer.complete())
    return fail(ErrorCode::input, "reaches beyond where its reference system " + map.crs + " does", path.string());
  return writeFile(path, header(map, projection.has_value()) + writer.take() + "\n]}\n");
}

}  // namespace umbrage::report
