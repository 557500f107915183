// Linked into every test of a build with sanitizers: what foreign libraries keep until the process ends is no leak of ours.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";  // its cache of fonts
}
