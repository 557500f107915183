#pragma once

#include <geos_c.h>

#include <memory>
#include <type_traits>

// Owners of GEOS's C objects.
namespace umbrage::io::reader {

struct EndGeos {
  void operator()(GEOSContextHandle_t context) const { GEOS_finish_r(context); }
};
using GeosContext = std::unique_ptr<std::remove_pointer_t<GEOSContextHandle_t>, EndGeos>;

struct DestroyGeometry {
  GEOSContextHandle_t context;
  void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
};
using GeosGeometry = std::unique_ptr<GEOSGeometry, DestroyGeometry>;

}  // namespace umbrage::io::reader
