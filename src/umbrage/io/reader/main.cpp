// umbrage-reader FD MEMORY HANDOVER SECONDS FILE [LOD]
//
// Reads one scene file with parsers that may crash, hang or eat memory on a hostile one, and hands a flat scene, or the reason
// why there is none, over through descriptor FD. The library starts it (umbrage/io/load.hpp); it is of no use by hand.
#include "umbrage/io/reader/run.hpp"

int main(int argc, char** argv) { return umbrage::io::reader::runReader(argc, argv, umbrage::io::reader::read); }
