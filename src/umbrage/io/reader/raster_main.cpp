// umbrage-raster-reader: umbrage-reader for height rasters. A program of its own, so that other scenes do not wait for GDAL's hundred libraries.
#include "umbrage/io/reader/run.hpp"

int main(int argc, char** argv) { return umbrage::io::reader::runReader(argc, argv, umbrage::io::reader::readRaster); }
