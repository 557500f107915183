#include "umbrage/cut/detail/partition.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "umbrage/cut/detail/cover.hpp"

namespace umbrage::cut::detail {
namespace {

constexpr std::int32_t kLit = FaceCut::kLit, kDark = FaceCut::kDark;
// So many borders are weighed as the next line, against at most so many others.
constexpr std::size_t kTried = 8, kWeighed = 64;
// A border that the line cuts is worth so many on its wrong side.
constexpr int kCutCost = 4;
// Beside its borders and the casters over it, a polygon costs about so many steps.
constexpr std::int64_t kPolygonSteps = 32;

struct Task {
  Polygon polygon;
  std::vector<Border> borders;
  std::int32_t parent = -1;  ///< whose next[side] is to be set; -1: the root
  int side = 0;
};

double heightOf(const Vec3& line, const Vec2& p) { return line.x * p.x + line.y * p.y + line.z; }

class Partition {
 public:
  Partition(const Casters& casters, const Face& face, std::vector<Vec3> lines, Effort& effort)
      : casters_(casters), face_(face), lines_(std::move(lines)), effort_(effort) {}

  std::optional<FaceCut> run(std::vector<Border> borders, const ConeLines& cone) {
    Task whole;
    whole.polygon.assign(face_.frame.flatCorners.begin(), face_.frame.flatCorners.end());
    whole.borders = std::move(borders);
    throughCone(std::move(whole), cone);
    while (!open_.empty()) {
      Task task = std::move(open_.back());
      open_.pop_back();
      std::int64_t steps = kPolygonSteps + static_cast<std::int64_t>(task.borders.size());
      if (task.borders.size() > 1 && isCovered(casters_, face_, task.polygon, steps)) {
        close(task.parent, task.side, kDark);
      } else if (const auto line = nextLine(task)) {
        if (!effort_.spendPieces(1)) return std::nullopt;
        divide(std::move(task), *line);
      } else {
        close(task.parent, task.side, isHidden(casters_, face_, task.polygon, steps) ? kDark : kLit);
      }
      if (!effort_.spendSteps(steps)) return std::nullopt;
    }
    joinAlike();
    return FaceCut(face_.frame, face_.tolerance, std::move(nodes_), root_);
  }

 private:
  void close(std::int32_t parent, int side, std::int32_t what) {
    (parent < 0 ? root_ : nodes_[static_cast<std::size_t>(parent)].next[static_cast<std::size_t>(side)]) = what;
  }

  // What is outside of a spot's pyramid is dark, or what is inside of it.
  void throughCone(Task task, const ConeLines& cone) {
    for (const Vec3& line : cone.lines) {
      if (!split(task.polygon, line, face_.tolerance, below_, above_, side_)) {
        if (side_ > 0) continue;
        if (cone.insideIsLit) return close(task.parent, task.side, kDark);
        return open_.push_back(std::move(task));
      }
      const std::int32_t node = addNode(task.parent, task.side, line);
      auto [outside, inside] = dividedBorders(task.borders, line);
      if (cone.insideIsLit)
        close(node, 0, kDark);
      else
        open_.push_back({below_, std::move(outside), node, 0});
      task = {above_, std::move(inside), node, 1};
    }
    if (cone.lines.empty() || cone.insideIsLit)
      open_.push_back(std::move(task));
    else
      close(task.parent, task.side, kDark);
  }

  // The line to divide by next; none when no border crosses the polygon. Those that do not are taken out.
  std::optional<std::uint32_t> nextLine(Task& task) {
    while (!task.borders.empty()) {
      const std::size_t chosen = choose(task.borders);
      const std::uint32_t line = task.borders[chosen].line;
      task.borders[chosen] = task.borders.back();
      task.borders.pop_back();
      if (split(task.polygon, lines_[line], face_.tolerance, below_, above_, side_)) return line;
    }
    return std::nullopt;
  }

  // The one among some borders whose line has as many others on either side and cuts few.
  [[nodiscard]] std::size_t choose(const std::vector<Border>& borders) const {
    const std::size_t count = borders.size();
    if (count <= 2) return 0;
    const std::size_t tryStep = count / kTried + 1, weighStep = count / kWeighed + 1;
    std::size_t best = 0;
    int bestCost = 1 << 30;
    for (std::size_t i = tryStep / 2; i < count; i += tryStep) {
      const Vec3& line = lines_[borders[i].line];
      int below = 0, above = 0, cut = 0;
      for (std::size_t k = weighStep / 2; k < count; k += weighStep) {
        const double a = heightOf(line, borders[k].from), b = heightOf(line, borders[k].to);
        const bool goesBelow = std::min(a, b)<-face_.tolerance, goesAbove = std::max(a, b)> face_.tolerance;
        below += goesBelow, above += goesAbove, cut += goesBelow && goesAbove;
      }
      const int cost = std::abs(below - above) + kCutCost * cut;
      if (cost < bestCost) bestCost = cost, best = i;
    }
    return best;
  }

  void divide(Task task, std::uint32_t line) {
    const std::int32_t node = addNode(task.parent, task.side, lines_[line]);
    auto [below, above] = dividedBorders(task.borders, lines_[line]);
    open_.push_back({below_, std::move(below), node, 0});
    open_.push_back({above_, std::move(above), node, 1});
  }

  std::int32_t addNode(std::int32_t parent, int side, const Vec3& line) {
    const auto node = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({line, {kDark, kDark}});
    close(parent, side, node);
    return node;
  }

  // Those on the line itself bound both parts and divide neither.
  [[nodiscard]] std::pair<std::vector<Border>, std::vector<Border>> dividedBorders(const std::vector<Border>& borders,
                                                                                   const Vec3& line) const {
    std::pair<std::vector<Border>, std::vector<Border>> parts;
    for (const Border& b : borders) {
      const double from = heightOf(line, b.from), to = heightOf(line, b.to);
      const bool below = std::min(from, to)<-face_.tolerance, above = std::max(from, to)> face_.tolerance;
      if (below && above) {
        const Vec2 between = b.from + (from / (from - to)) * (b.to - b.from);
        (from < 0.0 ? parts.first : parts.second).push_back({b.from, between, b.line});
        (from < 0.0 ? parts.second : parts.first).push_back({between, b.to, b.line});
      } else if (below) {
        parts.first.push_back(b);
      } else if (above) {
        parts.second.push_back(b);
      }
    }
    return parts;
  }

  // Parts that came out alike were divided for nothing; nodes that are left keep their order.
  void joinAlike() {
    const auto joined = [&](std::int32_t at) {
      if (at < 0) return at;
      const auto& next = nodes_[static_cast<std::size_t>(at)].next;
      return next[0] < 0 && next[0] == next[1] ? next[0] : at;
    };
    for (std::size_t n = nodes_.size(); n-- > 0;)
      for (std::int32_t& next : nodes_[n].next) next = joined(next);
    root_ = joined(root_);
    if (root_ < 0) return nodes_.clear();
    // Children come after their parents.
    std::vector<std::uint8_t> isUsed(nodes_.size(), 0);
    isUsed[static_cast<std::size_t>(root_)] = 1;
    std::vector<std::int32_t> place(nodes_.size());
    std::int32_t count = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (isUsed[n] == 0) continue;
      place[n] = count++;
      for (const std::int32_t next : nodes_[n].next)
        if (next >= 0) isUsed[static_cast<std::size_t>(next)] = 1;
    }
    std::vector<FaceCut::Node> kept;
    kept.reserve(static_cast<std::size_t>(count));
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (isUsed[n] == 0) continue;
      for (std::int32_t& next : nodes_[n].next)
        if (next >= 0) next = place[static_cast<std::size_t>(next)];
      kept.push_back(nodes_[n]);
    }
    nodes_ = std::move(kept);
    root_ = 0;
  }

  const Casters& casters_;
  const Face& face_;
  const std::vector<Vec3> lines_;
  Effort& effort_;
  std::vector<FaceCut::Node> nodes_;
  std::int32_t root_ = kDark;
  std::vector<Task> open_;
  Polygon below_, above_;  ///< of the last split
  int side_ = 0;
};

}  // namespace

std::optional<FaceCut> partition(const Casters& casters, const Face& face, Borders borders, const ConeLines& cone,
                                 Effort& effort) {
  return Partition(casters, face, std::move(borders.lines), effort).run(std::move(borders.borders), cone);
}

}  // namespace umbrage::cut::detail
