// Frames of the staged scenes by everybody who can draw them, in one run: each round every contestant draws one frame, in an order
// that turns from round to round, so that whatever disturbs the machine disturbs all alike. Times are compared round by round.
//   umbrage_frames OUT.json [rounds=N] [shot=PART-OF-A-NAME] [only=CONTESTANT] [fact:NAME=VALUE ..] [peer:NAME=COMMAND ..]
// Scenes (for peers) and pictures are written beside OUT.json. `fact` goes into the file as it is.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "all_techniques.hpp"
#include "contestant.hpp"
#include "median.hpp"
#include "umbrage/base/file.hpp"
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
#include "umbrage/gl/context.hpp"
#endif

namespace umbrage::benchmarks {
namespace {

struct Options {
  std::filesystem::path out;
  int rounds = 15;
  std::string shot;
  nlohmann::ordered_json facts = nlohmann::ordered_json::object();
  std::vector<Entry> entries;
};

// What this program knows of its own making.
void addOwnFacts(nlohmann::ordered_json& facts) {
  facts["Embree"] = RTC_VERSION_STRING;
  facts["compiler"] = __VERSION__;
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
  if (const auto context = gl::Context::createHeadless()) facts["OpenGL"] = (*context)->renderer();
#endif
}

// One contestant's row of a shot.
struct Row {
  std::string name;
  std::unique_ptr<Contestant> contestant;
  std::vector<double> times;
};

std::vector<Row> enter(const std::vector<Entry>& entries, const Stage& stage, const Shot& shot) {
  std::vector<Row> rows;
  for (const Entry& entry : entries) {
    auto contestant = entry.enter(stage, shot);
    for (int i = 0; contestant && i < 2; ++i)  // shaders compile in the first frames
      if (auto warm = (*contestant)->frame(0.0); !warm) contestant = tl::unexpected(warm.error());
    if (contestant)
      rows.push_back({entry.name, std::move(*contestant), {}});
    else
      std::cerr << entry.name << " does not take part in " << shot.name << ": " << contestant.error().text() << "\n";
  }
  return rows;
}

void race(std::vector<Row>& rows, int rounds) {
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Row& row = rows[(i + static_cast<std::size_t>(round)) % rows.size()];
      // The light moves a little, so that nobody lives on the silhouette of the frame before.
      const auto time = row.contestant->frame(round % 2 == 0 ? 0x1p-10 : 0.0);
      if (time) row.times.push_back(*time);
    }
}

nlohmann::ordered_json json(const Stage& stage, const Shot& shot, const std::vector<Row>& rows) {
  nlohmann::ordered_json contestants = nlohmann::ordered_json::array();
  for (const Row& row : rows)
    contestants.push_back({{"name", row.name}, {"ms", row.times}, {"phases", row.contestant->phases()}});
  return {{"scene", stage.staged.name},
          {"shot", shot.name},
          {"triangles", stage.geometry->surfaces.triangles.size()},
          {"width", shot.camera.width},
          {"height", shot.camera.height},
          {"contestants", contestants}};
}

Result<nlohmann::ordered_json> take(const Stage& stage, const Shot& shot, const Options& options) {
  auto rows = enter(options.entries, stage, shot);
  race(rows, options.rounds);
  for (Row& row : rows) {
    const auto path = options.out.parent_path() / (shot.name + "-" + row.name + ".png");
    if (auto done = row.contestant->picture(path); !done) return tl::unexpected(done.error());
    std::cerr << fmt::format("{:<14} {:<14} {:8.1f} ms\n", shot.name, row.name, median(row.times));
  }
  return json(stage, shot, rows);
}

Result<void> run(const Options& options) {
  nlohmann::ordered_json result{
      {"facts", options.facts}, {"rounds", options.rounds}, {"shots", nlohmann::ordered_json::array()}};
  for (StagedScene& staged : stagedScenes()) {
    auto geometry = shadow::makeGeometry(staged.scene);
    const auto file = options.out.parent_path() / (staged.name + ".stage");
    const Stage stage{std::move(staged), std::move(geometry), file};
    if (auto done = writeFile(file, exported(stage.staged)); !done) return done;
    for (const Shot& shot : stage.staged.shots) {
      if (shot.name.find(options.shot) == std::string::npos) continue;
      auto taken = take(stage, shot, options);
      if (!taken) return tl::unexpected(taken.error());
      result["shots"].push_back(std::move(*taken));
    }
  }
  return writeFile(options.out, result.dump(1) + "\n");
}

bool apply(Options& o, const std::string& name, const std::string& value) {
  if (name == "rounds") return o.rounds = std::atoi(value.c_str()), o.rounds > 0;
  if (name == "shot") return o.shot = value, true;
  if (name == "only")
    return std::erase_if(o.entries, [&](const Entry& e) { return e.name != value; }), !o.entries.empty();
  if (name.starts_with("fact:")) return o.facts[name.substr(5)] = value, true;
  if (name.starts_with("peer:")) return o.entries.push_back(peerEntry(name.substr(5), value)), true;
  return false;
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  using namespace umbrage::benchmarks;
  Options options;
  for (const auto& technique : allTechniques()) {
    options.entries.push_back(techniqueEntry(technique));
    if (technique.traits.name == "zpass_cpu") options.entries.push_back(techniqueEntry(technique, true));
  }
  options.entries.push_back(bareRaysEntry());
  bool good = argc >= 2;
  for (int i = 2; i < argc; ++i) {
    const std::string text = argv[i];
    const auto split = text.find('=');
    good = good && split != std::string::npos && apply(options, text.substr(0, split), text.substr(split + 1));
  }
  if (!good) {
    std::cerr << "usage: umbrage_frames OUT.json [rounds=N] [shot=..] [only=..] [fact:NAME=VALUE ..] "
                 "[peer:NAME=COMMAND ..]\n";
    return 2;
  }
  options.out = argv[1];
  addOwnFacts(options.facts);
  if (auto done = run(options); !done) {
    std::cerr << done.error().text() << "\n";
    return EXIT_FAILURE;
  }
}
