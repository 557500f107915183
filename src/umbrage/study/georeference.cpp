#include "umbrage/study/georeference.hpp"

#include "umbrage/geo/projection.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::study {

Result<Georeference> georeferenceOf(const scene::Scene& scene) {
  if (scene.crs.empty()) return fail(ErrorCode::input, "has no georeference", scene.source);
  const Box3 box = scene::bounds(scene);
  if (box.empty()) return fail(ErrorCode::input, "is empty, so that it stands nowhere", scene.source);
  const auto projection = geo::Projection::make(scene.crs);
  if (!projection) return fail(projection.error().code, projection.error().message, scene.source);
  const Vec2 middle = mapPoint(box.centre(), scene.up);
  const auto degrees = projection->toDegrees(middle);
  const auto north = projection->trueNorth(middle);
  if (!degrees || !north || projection->isGeographic())
    return fail(ErrorCode::input, "does not lie where its reference system " + scene.crs + " does", scene.source);
  const auto place = sun::makePlace(degrees->latitude, degrees->longitude);
  if (!place) return tl::unexpected(place.error());
  return Georeference{*place, *north, box.radius() * scene.metresPerUnit};
}

}  // namespace umbrage::study
