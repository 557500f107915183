// Source: Autodesk, AutoCAD Release 12 DXF reference, 1992: the version that every program reads.
#include <fmt/format.h>

#include <cctype>
#include <iterator>
#include <set>

#include "umbrage/base/file.hpp"
#include "umbrage/report/vector_map.hpp"

namespace umbrage::report {
namespace {

using outline::Ring;

constexpr std::size_t kLongestName = 31;
constexpr std::size_t kLongestComment = 240;

// Group codes and values, a line each.
class Groups {
 public:
  Groups& text(int code, const std::string& value) {
    fmt::format_to(std::back_inserter(out_), "{:3}\n{}\n", code, value);
    return *this;
  }
  Groups& number(int code, double value) {
    fmt::format_to(std::back_inserter(out_), "{:3}\n{:.9f}\n", code, value);
    return *this;
  }
  Groups& whole(int code, long value) {
    fmt::format_to(std::back_inserter(out_), "{:3}\n{:6}\n", code, value);
    return *this;
  }
  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

// Letters, digits and underscores; names that become the same are told apart by a number.
std::vector<std::string> layerNames(const VectorMap& map) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const MapLayer& layer : map.layers) {
    std::string name;
    for (const char c : layer.name.substr(0, kLongestName - 4))
      name += std::isalnum(static_cast<unsigned char>(c))
                  ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                  : '_';
    std::string unique = name;
    for (int n = 2; !taken.insert(unique).second; ++n) unique = fmt::format("{}_{}", name, n);
    names.push_back(unique);
  }
  return names;
}

void addRing(Groups& out, const Ring& ring, const std::string& layer, double height) {
  out.text(0, "POLYLINE").text(8, layer).whole(66, 1).number(10, 0).number(20, 0).number(30, height).whole(70, 1);
  for (const Vec2& p : ring) out.text(0, "VERTEX").text(8, layer).number(10, p.x).number(20, p.y).number(30, height);
  out.text(0, "SEQEND").text(8, layer);
}

void addHeader(Groups& out, const VectorMap& map) {
  Vec2 low(0.0), high(0.0);
  bool first = true;
  for (const MapFeature& feature : map.features)
    for (const auto& polygon : feature.region.polygons)
      for (const Vec2& p : polygon.outer) {
        low = first ? p : glm::min(low, p);
        high = first ? p : glm::max(high, p);
        first = false;
      }
  out.text(999, map.title);
  for (const auto& line : map.ledger) out.text(999, (line.subject + ": " + line.text).substr(0, kLongestComment));
  out.text(0, "SECTION").text(2, "HEADER").text(9, "$ACADVER").text(1, "AC1009");
  out.text(9, "$EXTMIN").number(10, low.x).number(20, low.y).number(30, map.height);
  out.text(9, "$EXTMAX").number(10, high.x).number(20, high.y).number(30, map.height);
  out.text(0, "ENDSEC");
}

void addLayers(Groups& out, const std::vector<std::string>& names) {
  out.text(0, "SECTION").text(2, "TABLES").text(0, "TABLE").text(2, "LAYER").whole(70, static_cast<long>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    out.text(0, "LAYER").text(2, names[i]).whole(70, 0).whole(62, 1 + static_cast<long>(i % 6)).text(6, "CONTINUOUS");
  out.text(0, "ENDTAB").text(0, "ENDSEC");
}

}  // namespace

Result<void> writeDxf(const VectorMap& map, const std::filesystem::path& path) {
  Groups out;
  const auto names = layerNames(map);
  addHeader(out, map);
  addLayers(out, names);
  out.text(0, "SECTION").text(2, "ENTITIES");
  for (const MapFeature& feature : map.features)
    for (const auto& polygon : feature.region.polygons) {
      addRing(out, polygon.outer, names[feature.layer], map.height);
      for (const Ring& hole : polygon.holes) addRing(out, hole, names[feature.layer], map.height);
    }
  out.text(0, "ENDSEC").text(0, "EOF");
  return writeFile(path, out.take());
}

}  // namespace umbrage::report
