// A host that loads scene files: no foreign parser is linked into it; the installed reader process does the parsing.
#include <umbrage/io/load.hpp>

#include <cstdio>
#include <fstream>

int main() {
  using namespace umbrage;
  std::ofstream("square.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  const auto scene = io::loadScene("square.obj");
  if (!scene) std::fprintf(stderr, "%s\n", scene.error().text().c_str());
  return scene && scene::triangleCount(*scene) == 2 ? 0 : 1;
}
