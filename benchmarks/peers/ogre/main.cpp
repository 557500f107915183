// Ogre's stencil shadows on an exported scene (scenes/staged_scene.hpp).
//   umbrage_ogre_peer SCENE SHOT [SETTING=VALUE ..]
// Settings: frames (0: obey "frame SHIFT" lines on the standard input, each answered with a line of milliseconds), picture (a .ppm
// of the last frame), system, shadows (additive, modulative, none), volumes (infinite, finite), indices, tile.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "picture.hpp"

#include <OgrePrerequisites.h>

namespace umbrage::peers {
namespace {

struct Options {
  Settings settings;
  int frames = 9;
  std::string picture;
};

bool apply(Options& o, const std::string& name, const std::string& value) {
  Settings& s = o.settings;
  if (name == "frames") return o.frames = std::atoi(value.c_str()), true;
  if (name == "picture") return o.picture = value, true;
  if (name == "system") return s.system = value, true;
  if (name == "shadows") return s.additive = value == "additive", s.shadows = value != "none", true;
  if (name == "volumes") return s.infinite = value == "infinite", true;
  if (name == "indices") return s.indices = std::strtoull(value.c_str(), nullptr, 10), true;
  if (name == "tile") return s.tile = std::atof(value.c_str()), true;
  return false;
}

bool writePpm(const std::string& path, const Picture& picture, const Settings& s) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  const auto pixels = picture.pixels();
  std::fprintf(file, "P6\n%d %d\n255\n", s.width, s.height);
  const bool whole = std::fwrite(pixels.data(), 1, pixels.size(), file) == pixels.size();
  return std::fclose(file) == 0 && whole;
}

void obey(Picture& picture) {
  std::cout << "ready Ogre " << OGRE_VERSION_MAJOR << "." << OGRE_VERSION_MINOR << "." << OGRE_VERSION_PATCH
            << std::endl;
  double shift = 0.0;
  for (std::string word; std::cin >> word >> shift && word == "frame";) std::cout << picture.frame(shift) << std::endl;
}

void measure(Picture& picture, const std::string& shot, int frames) {
  for (int i = 0; i < 2; ++i) (void)picture.frame(0);  // shaders compile in the first frames
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(picture.frame(i % 2 * 0x1p-10));
  std::sort(times.begin(), times.end());
  std::printf("{\"view\": \"%s\", \"entities\": %zu, \"batches\": %zu, \"median_ms\": %.2f, \"min_ms\": %.2f}\n",
              shot.c_str(), picture.entities(), picture.batches(), times[times.size() / 2], times.front());
}

int run(const std::string& file, const std::string& name, const Options& options) {
  const auto stage = readStage(file);
  const StageShot* shot = stage ? stage->shot(name) : nullptr;
  if (shot == nullptr) {
    std::fprintf(stderr, "%s: no scene, or no shot %s in it\n", file.c_str(), name.c_str());
    return EXIT_FAILURE;
  }
  Picture picture(*stage, *shot, options.settings);
  if (options.frames == 0)
    obey(picture);
  else
    measure(picture, name, options.frames);
  return options.picture.empty() || writePpm(options.picture, picture, options.settings) ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace umbrage::peers

int main(int argc, char** argv) {
  umbrage::peers::Options options;
  bool good = argc >= 3;
  for (int i = 3; i < argc; ++i) {
    const std::string text = argv[i];
    const auto split = text.find('=');
    good = good && split != std::string::npos && apply(options, text.substr(0, split), text.substr(split + 1));
  }
  if (!good) {
    std::fprintf(stderr, "usage: umbrage_ogre_peer SCENE SHOT [SETTING=VALUE ..]\n");
    return 2;
  }
  try {
    return umbrage::peers::run(argv[1], argv[2], options);
  } catch (const std::exception& e) {  // Ogre throws
    std::fprintf(stderr, "Ogre: %s\n", e.what());
    return EXIT_FAILURE;
  }
}
