#include "umbrage/shadow/technique.hpp"

namespace umbrage::shadow {

std::string_view name(CasterChoice choice) {
  switch (choice) {
    case CasterChoice::zPass: return "zpass";
    case CasterChoice::zFail:
    case CasterChoice::zFailTouched:
    case CasterChoice::zFailBetween: return "zfail";
    case CasterChoice::hidden:
    case CasterChoice::noReceiver: return "left out";
  }
  return "?";
}

std::string_view reason(CasterChoice choice) {
  switch (choice) {
    case CasterChoice::zPass: return "no caps needed, since the count at the eye is known";
    case CasterChoice::zFail: return "right for every eye";
    case CasterChoice::zFailTouched: return "the eye touches the caster or a side of its volume";
    case CasterChoice::zFailBetween: return "it may lie between the eye and the light";
    case CasterChoice::hidden: return "it lies wholly in the shadow of a convex solid";
    case CasterChoice::noReceiver: return "its volume holds no surface that is seen and faces the light";
  }
  return "?";
}

}  // namespace umbrage::shadow
