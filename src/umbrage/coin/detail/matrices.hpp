#pragma once

#include <Inventor/SbMatrix.h>
#include <Inventor/SbVec3f.h>

#include "umbrage/math/vec.hpp"

namespace umbrage::coin::detail {

inline Vec3 vectorOf(const SbVec3f& v) { return {v[0], v[1], v[2]}; }

/// Coin multiplies row vectors from the left, glm column vectors from the right: the storage is the same.
inline Mat4 matrixOf(const SbMatrix& given) {
  Mat4 m;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) m[i][k] = given[i][k];
  return m;
}

inline SbMatrix coinMatrixOf(const Mat4& given) {
  SbMatrix m;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) m[i][k] = static_cast<float>(given[i][k]);
  return m;
}

}  // namespace umbrage::coin::detail
