#pragma once

#include "umbrage/base/error.hpp"
#include "umbrage/io/detail/hints.hpp"
#include "umbrage/io/reader/json_access.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io::reader {

/// True for a FeatureCollection, a Feature or a bare Polygon or MultiPolygon.
[[nodiscard]] bool isGeoJson(const Json& document);

/// Footprints with heights as closed prisms, up Z, the ground at 0; see readGeoJson.
[[nodiscard]] Result<scene::Scene> sceneOfGeoJson(const Json& document, const detail::Hints& hints);

}  // namespace umbrage::io::reader
