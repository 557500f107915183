// Linked into every test of a build with sanitizers: what foreign libraries do is no fault of ours.
// What they keep until the process ends:
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n"                         // its cache of fonts
         "leak:libdbus-1\n"                             // Qt's way to screen readers
         "leak:SoShadowStyleElement::createInstance\n"  // what Coin makes once for a class and for its clock
         "leak:SoGLShadowCullingElement::createInstance\n"
         "leak:SoSFTime::createInstance\n"
         "leak:cc_glglue_instance\n";  // one a context, also when it is told that the context goes
}

// Embree and TBB are not instrumented, so what they do in their own threads looks unordered.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libembree3.so\ncalled_from_lib:libtbb.so\nrace:libembree3.so\nrace:libtbb.so\n";
}
