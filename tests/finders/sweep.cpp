// Every silhouette finder on every loadable model below the given folders:  sweep DIR..
// Ends with 'N passed, N failed', and with exit code 1 when finders disagree.
#include <cstdio>

#include "conformance/models.hpp"
#include "finders/agreement.hpp"

int main(int count, char** words) {
  std::size_t passed = 0, failed = 0, skipped = 0;
  for (int i = 1; i < count; ++i) {
    for (const auto& path : umbrage::conformance::modelFiles(words[i])) {
      const auto verdict = umbrage::finders::judge(path);
      if (!verdict) {
        ++skipped;
        continue;
      }
      const bool good = verdict->disagreement.empty();
      ++(good ? passed : failed);
      std::printf("%-44s %8zu triangles %8zu edges %3zu lights %9zu found  %s\n", path.filename().c_str(),
                  verdict->triangles, verdict->edges, verdict->lights, verdict->found,
                  good ? "ok" : verdict->disagreement.c_str());
      std::fflush(stdout);
    }
  }
  std::printf("%zu not loadable\n%zu passed, %zu failed\n", skipped, passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}
