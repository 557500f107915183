#include "umbrage/coin/detail/extractor.hpp"

#include <Inventor/SbXfBox3f.h>
#include <Inventor/SoPath.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLLight.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/annex/FXViz/elements/SoShadowStyleElement.h>
#include <Inventor/annex/FXViz/nodes/SoShadowStyle.h>
#include <Inventor/caches/SoCache.h>
#include <Inventor/elements/SoCacheElement.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/elements/SoLightElement.h>
#include <Inventor/elements/SoMultiTextureImageElement.h>
#include <Inventor/elements/SoProjectionMatrixElement.h>
#include <Inventor/elements/SoShapeStyleElement.h>
#include <Inventor/elements/SoViewingMatrixElement.h>
#include <Inventor/elements/SoViewportRegionElement.h>
#include <Inventor/misc/SoState.h>
#include <Inventor/nodes/SoCamera.h>
#include <Inventor/nodes/SoLight.h>
#include <Inventor/nodes/SoShape.h>

#include <algorithm>
#include <glm/matrix.hpp>
#include <ranges>
#include <unordered_map>

#include "umbrage/coin/detail/clipping.hpp"
#include "umbrage/coin/detail/lights.hpp"
#include "umbrage/coin/detail/matrices.hpp"
#include "umbrage/coin/detail/special_shapes.hpp"
#include "umbrage/inventor/check.hpp"
#include "umbrage/inventor/full_path.hpp"

namespace umbrage::coin::detail {
namespace {

constexpr std::size_t kScansKept = 64;  ///< triangles that so many scans did not meet are forgotten

struct Uncache {
  void operator()(SoCache* cache) const { cache->unref(nullptr); }
};
using CacheRef = std::unique_ptr<SoCache, Uncache>;

/// How a shape's materials let light through.
struct Veil {
  bool counts = true;                 ///< false: Coin draws it opaque all the same
  std::vector<float> transparencies;  ///< per material; empty: none is transparent
  bool texture = false;               ///< its texture lets light through somewhere
  friend bool operator==(const Veil&, const Veil&) = default;
};

Veil veilAt(SoState* state) {
  Veil veil;
  veil.counts = SoShapeStyleElement::getTransparencyType(state) != SoGLRenderAction::NONE;
  if (!veil.counts) return veil;
  if (state->isElementEnabled(SoMultiTextureImageElement::getClassStackIndex()))
    veil.texture = SoMultiTextureImageElement::containsTransparency(state);
  const SoLazyElement* lazy = SoLazyElement::getInstance(state);
  const int count = lazy->isPacked() ? lazy->getNumDiffuse() : lazy->getNumTransparencies();
  for (int i = 0; i < count; ++i) veil.transparencies.push_back(SoLazyElement::getTransparency(state, i));
  const bool clear = std::ranges::all_of(veil.transparencies, [](float t) { return t <= 0.0f; });
  if (clear) veil.transparencies.clear();
  return veil;
}

// Coin does not note VRML's lights.
std::vector<const SoNode*> lightsAt(SoState* state) {
  std::vector<const SoNode*> nodes;
  if (!state->isElementEnabled(SoLightElement::getClassStackIndex())) return nodes;
  const SoNodeList& lights = SoLightElement::getLights(state);
  for (int i = 0; i < lights.getLength(); ++i) nodes.push_back(lights[i]);
  return nodes;
}

struct Entry {
  CacheRef cache;
  Veil veil;
  std::shared_ptr<const ShapeTriangles> triangles;
  std::size_t lastMet = 0;
};

}  // namespace

// Coin tells OpenGL to leave the transforms above a camera first and to go into the camera's own space then, but notes both in the other order.
std::optional<Sight> sightAt(SoState* state, const Mat4& cameraToWorld) {
  const SbMatrix& projection = SoProjectionMatrixElement::get(state);
  if (projection == SbMatrix::identity()) return std::nullopt;
  Sight sight{SoViewingMatrixElement::get(state), projection, SoViewportRegionElement::get(state)};
  if (cameraToWorld != Mat4(1.0))
    sight.viewing = coinMatrixOf(cameraToWorld * matrixOf(sight.viewing) * glm::inverse(cameraToWorld));
  return sight;
}

/// What is known of shapes, by node id: Coin gives a node another id whenever it changes, and no id twice.
class Extractor::Memory {
 public:
  std::size_t scans = 0, extractions = 0;

  Entry* find(const SoNode& shape, const SoState* state, const Veil& veil) {
    const auto known = entries_.find(shape.getNodeId());
    if (known == entries_.end()) return nullptr;
    for (Entry& entry : known->second)
      if (entry.veil == veil && entry.cache->isValid(state)) return &entry;
    return nullptr;
  }
  // A node that changed never has its old id again, and of what another state gave only the latest may come back.
  void add(const SoNode& shape, Entry entry) {
    const SbUniqueId id = shape.getNodeId();
    const auto before = ids_.find(&shape);
    if (before != ids_.end() && before->second != id) entries_.erase(before->second);
    ids_[&shape] = id;
    std::erase_if(entries_[id], [&](const Entry& known) { return known.lastMet + 1 < scans; });
    entries_[id].push_back(std::move(entry));
  }
  void drop(const SoNode& shape) { entries_.erase(shape.getNodeId()); }
  void tidy() {
    for (auto known = entries_.begin(); known != entries_.end();) {
      std::erase_if(known->second, [&](const Entry& entry) { return entry.lastMet + kScansKept < scans; });
      known = known->second.empty() ? entries_.erase(known) : std::next(known);
    }
    std::erase_if(ids_, [&](const auto& known) { return !entries_.contains(known.second); });
    std::erase_if(cuts_, [&](const auto& known) { return known.second.lastMet != scans; });
  }
  [[nodiscard]] std::size_t kept() const {
    std::size_t count = 0;
    for (const auto& [id, entries] : entries_) count += entries.size();
    return count;
  }

  /// What planes leave of a shape: the same object for as long as all are the same.
  std::shared_ptr<const ShapeTriangles> clip(const std::shared_ptr<const ShapeTriangles>& shape, const Mat4& toWorld,
                                             const std::vector<ClipPlane>& planes) {
    const auto [first, last] = cuts_.equal_range(shape.get());
    for (auto cut = first; cut != last; ++cut) {
      if (cut->second.toWorld != toWorld || cut->second.planes != planes) continue;
      cut->second.lastMet = scans;
      return cut->second.left;
    }
    auto left = clipped(shape, toWorld, planes);
    cuts_.insert({shape.get(), {shape, toWorld, planes, left, scans}});
    return left;
  }

 private:
  struct Cut {
    std::shared_ptr<const ShapeTriangles> shape;
    Mat4 toWorld;
    std::vector<ClipPlane> planes;
    std::shared_ptr<const ShapeTriangles> left;
    std::size_t lastMet;
  };
  std::unordered_map<SbUniqueId, std::vector<Entry>> entries_;
  std::unordered_map<const SoNode*, SbUniqueId> ids_;  ///< the last one of each, to be compared only
  std::unordered_multimap<const ShapeTriangles*, Cut> cuts_;
};

/// One walk through the graph.
class Extractor::Traversal {
 public:
  Traversal(Memory& memory, const ScanRequest& request, const std::vector<const SoNode*>& forgotten, bool last)
      : memory_(memory), request_(request), forgotten_(forgotten), last_(last) {}

  Scan run();
  [[nodiscard]] bool wantsAnother() const { return again_; }

 private:
  using Response = SoCallbackAction::Response;
  static Traversal& self(void* data) { return *static_cast<Traversal*>(data); }
  Response enter(SoCallbackAction* action, const SoNode* shape);
  void leave(SoCallbackAction* action, const SoNode* shape);
  void readInstead(SoCallbackAction* action, const SoNode* shape, const NodeRef& copy);
  void meetLight(SoCallbackAction* action, const SoNode* node);
  void addTriangle(SoCallbackAction* action, const SoPrimitiveVertex* const (&corners)[3]);
  void meetCamera(SoCallbackAction* action, const SoCamera* camera);
  void see(SoState* state);
  [[nodiscard]] bool isSeenOtherwise(SoCallbackAction* action);
  void receive(SoState* state, bool shadowed);
  [[nodiscard]] bool isInside(SoCallbackAction* action) const;
  void startReading(SoState* state, Veil veil);
  void place(SoCallbackAction* action, const SoNode& shape, std::shared_ptr<const ShapeTriangles> triangles);
  [[nodiscard]] bool isForgotten(const SoPath* path) const;
  [[nodiscard]] float transparencyAt(SoState* state, int index) const;
  [[nodiscard]] bool isInSpace(SoCallbackAction* action, const SbVec3f& point) const;

  Memory& memory_;
  const ScanRequest& request_;
  const std::vector<const SoNode*>& forgotten_;
  bool last_;  ///< what cannot be kept now never can
  bool again_ = false;
  Scan scan_;
  std::vector<const SoNode*> lightNodes_;
  struct Camera {
    SbMatrix viewing;
    Mat4 toWorld;
  };
  std::vector<Camera> cameras_;  ///< before the first shape
  SbMatrix viewing_;             ///< of the first shape, as Coin notes it
  // The shape that is being read:
  bool reading_ = false;
  const SoNode* instead_ = nullptr;  ///< a copy that it is read from
  Entry entry_;
  std::optional<inventor::LongBindings> bindings_;
  std::vector<Vec3> opaque_, veiled_;  ///< corners
  std::optional<SbXfBox3f> space_;     ///< where its triangles are worth anything; none: everywhere
  SbBool cacheWasOpen_ = FALSE, wasInvalid_ = FALSE;
};

Scan Extractor::Traversal::run() {
  SoCallbackAction action(request_.viewport);
  const auto enterShape = [](void* data, SoCallbackAction* a, const SoNode* n) { return self(data).enter(a, n); };
  const auto leaveShape = [](void* data, SoCallbackAction* a, const SoNode* n) {
    self(data).leave(a, n);
    return SoCallbackAction::CONTINUE;
  };
  const auto light = [](void* data, SoCallbackAction* a, const SoNode* n) {
    self(data).meetLight(a, n);
    return SoCallbackAction::CONTINUE;
  };
  const auto triangle = [](void* data, SoCallbackAction* a, const SoPrimitiveVertex* p, const SoPrimitiveVertex* q,
                           const SoPrimitiveVertex* r) {
    const SoPrimitiveVertex* const corners[3] = {p, q, r};
    self(data).addTriangle(a, corners);
  };
  action.addPreCallback(SoShape::getClassTypeId(), enterShape, this);
  action.addPostCallback(SoShape::getClassTypeId(), leaveShape, this);
  const auto style = [](void*, SoCallbackAction* a, const SoNode* n) {
    const auto* node = static_cast<const SoShadowStyle*>(n);
    SoShadowStyleElement::set(a->getState(), const_cast<SoNode*>(n), node->style.getValue());
    return SoCallbackAction::CONTINUE;
  };
  action.addPreCallback(SoShadowStyle::getClassTypeId(), style, nullptr);
  const auto camera = [](void* data, SoCallbackAction* a, const SoNode* n) {
    self(data).meetCamera(a, static_cast<const SoCamera*>(n));
    return SoCallbackAction::CONTINUE;
  };
  action.addPostCallback(SoCamera::getClassTypeId(), camera, this);
  action.addPreCallback(SoLight::getClassTypeId(), light, this);
  action.addPreCallback(SoVRMLLight::getClassTypeId(), light, this);
  action.addTriangleCallback(SoShape::getClassTypeId(), triangle, this);
  SoShapeStyleElement::setTransparencyType(action.getState(), request_.transparencyType);
  action.apply(const_cast<SoPath*>(request_.path));
  return std::move(scan_);
}

bool Extractor::Traversal::isForgotten(const SoPath* path) const {
  const inventor::FullPath full(*path);
  return std::ranges::any_of(forgotten_, [&](const SoNode* node) { return full.contains(node); });
}

Extractor::Traversal::Response Extractor::Traversal::enter(SoCallbackAction* action, const SoNode* shape) {
  if (instead_ != nullptr) return SoCallbackAction::CONTINUE;
  SoState* state = action->getState();
  if (!scan_.sight) see(state);
  if (isSeenOtherwise(action)) return SoCallbackAction::PRUNE;
  if (action->getDrawStyle() != SoDrawStyle::FILLED) return SoCallbackAction::PRUNE;
  const auto verdict = inventor::judge(action, shape);
  if (verdict == inventor::ShapeVerdict::broken) ++scan_.broken;
  const bool readable =
      verdict == inventor::ShapeVerdict::read || (verdict == inventor::ShapeVerdict::nurbs && request_.hasGlx);
  if (!readable) return SoCallbackAction::PRUNE;
  Veil veil = veilAt(state);
  if (!forgotten_.empty() && isForgotten(action->getCurPath())) memory_.drop(*shape);
  if (Entry* known = memory_.find(*shape, state, veil)) {
    known->lastMet = memory_.scans;
    place(action, *shape, known->triangles);
    return SoCallbackAction::PRUNE;
  }
  space_ = letterSpace(*action, *shape);
  startReading(state, std::move(veil));
  auto* own = const_cast<SoNode*>(shape);  // callbacks show nodes as const
  if (inventor::hasShortFaces(*shape)) {
    readInstead(action, shape, hold(own->copy()));
    return SoCallbackAction::PRUNE;
  }
  bindings_.emplace(own);
  return SoCallbackAction::CONTINUE;
}

// A copy whose faces Coin tells all, at the place and in the state of the shape.
void Extractor::Traversal::readInstead(SoCallbackAction* action, const SoNode* shape, const NodeRef& copy) {
  inventor::fillShortFaces(copy.get());
  bindings_.emplace(copy.get());
  instead_ = copy.get();
  copy->callback(action);
  instead_ = nullptr;
  leave(action, shape);
}

// Coin notes in an open cache which elements are read; the shape's triangles are the same for as long as those match.
void Extractor::Traversal::startReading(SoState* state, Veil veil) {
  reading_ = true;
  opaque_.clear();
  veiled_.clear();
  cacheWasOpen_ = state->isCacheOpen();
  wasInvalid_ = SoCacheElement::setInvalid(FALSE);
  state->push();
  SoCache* cache = new SoCache(state);
  cache->ref();
  entry_ = {CacheRef(cache), std::move(veil), nullptr, memory_.scans};
  SoCacheElement::set(state, cache);
  state->setCacheOpen(TRUE);
}

void Extractor::Traversal::leave(SoCallbackAction* action, const SoNode* shape) {
  if (!reading_ || instead_ != nullptr) return;
  reading_ = false;
  bindings_.reset();
  SoState* state = action->getState();
  state->setCacheOpen(cacheWasOpen_);
  state->pop();
  SoCacheElement::setInvalid(wasInvalid_);
  entry_.triangles = std::make_shared<const ShapeTriangles>(
      ShapeTriangles{meshOf(opaque_), meshOf(veiled_), std::max(reachOf(opaque_), reachOf(veiled_))});
  place(action, *shape, entry_.triangles);
  // A cache is invalid when a cache was made inside, of normals or of convex polygons, which then is there the next time.
  const bool keeps = entry_.cache->isValid(state);
  again_ = again_ || (!keeps && !last_);
  if (keeps || last_) ++memory_.extractions;
  if (keeps) memory_.add(*shape, std::move(entry_));
  entry_ = {};
}

void Extractor::Traversal::place(SoCallbackAction* action, const SoNode& shape,
                                 std::shared_ptr<const ShapeTriangles> triangles) {
  if (triangles->opaque == nullptr && triangles->veiled == nullptr) return;
  SoState* state = action->getState();
  const Mat4 toWorld = matrixOf(action->getModelMatrix());
  if (!(reachInWorld(triangles->reach, toWorld) <= kMostReach)) {
    ++scan_.beyond;
    return;
  }
  if (const auto planes = clipPlanesAt(state); !planes.empty()) {
    triangles = memory_.clip(triangles, toWorld, planes);
    if (triangles->opaque == nullptr && triangles->veiled == nullptr) return;
  }
  const bool styled = state->isElementEnabled(SoShadowStyleElement::getClassStackIndex()) != FALSE;
  const int style = styled ? SoShadowStyleElement::get(state) : SoShadowStyleElement::CASTS_SHADOW_AND_SHADOWED;
  receive(state, (style & SoShadowStyleElement::SHADOWED) != 0);
  const bool casts = (style & SoShadowStyleElement::CASTS_SHADOW) != 0 &&
                     request_.registry->casts(*action->getCurPath()) && !isHandle(*action->getCurPath());
  scan_.shapes.push_back({std::move(triangles), toWorld, casts, culledOf(state, shape)});
}

// Of the lights that shine on it Coin hands the first to OpenGL, and drops what is beyond.
void Extractor::Traversal::receive(SoState* state, bool shadowed) {
  auto lights = lightsAt(state);
  if (lights.size() > request_.mostLights) {
    scan_.lightsDropped = std::max(scan_.lightsDropped, lights.size() - request_.mostLights);
    lights.resize(request_.mostLights);
  }
  scan_.receivers.push_back({shadowed, std::move(lights)});
}

// Shapes under another camera than the first are no part of the same world; lit ones are told of, unless they are drawn when all else is.
bool Extractor::Traversal::isSeenOtherwise(SoCallbackAction* action) {
  if (!scan_.sight) return false;
  SoState* state = action->getState();
  if (SoViewingMatrixElement::get(state) == viewing_ &&
      SoProjectionMatrixElement::get(state) == scan_.sight->projection)
    return false;
  const bool lit = SoLazyElement::getLightModel(state) != SoLazyElement::BASE_COLOR;
  if (lit && !isAnnotation(*action->getCurPath())) ++scan_.otherwiseSeen;
  return true;
}

float Extractor::Traversal::transparencyAt(SoState* state, int index) const {
  // Of its own vertices, too, which are in the state only while the shape is read. Coin reads beyond its arrays for an index beyond them.
  const SoLazyElement* lazy = SoLazyElement::getInstance(state);
  const int count = lazy->isPacked() ? lazy->getNumDiffuse() : lazy->getNumTransparencies();
  return count > 0 ? SoLazyElement::getTransparency(state, std::clamp(index, 0, count - 1)) : 0.0f;
}

void Extractor::Traversal::addTriangle(SoCallbackAction* action, const SoPrimitiveVertex* const (&corners)[3]) {
  if (!reading_) return;
  float least = 1.0f, most = 0.0f;
  for (const SoPrimitiveVertex* corner : corners) {
    if (space_ && !isInSpace(action, corner->getPoint())) return;
    if (!entry_.veil.counts) continue;
    const float t = transparencyAt(action->getState(), corner->getMaterialIndex());
    least = std::min(least, t);
    most = std::max(most, t);
  }
  if (entry_.veil.counts && least >= 1.0f) return;
  auto& soup = most > 0.0f || entry_.veil.texture ? veiled_ : opaque_;
  for (const SoPrimitiveVertex* corner : corners) soup.push_back(vectorOf(corner->getPoint()));
}

bool Extractor::Traversal::isInSpace(SoCallbackAction* action, const SbVec3f& point) const {
  SbVec3f world;
  action->getModelMatrix().multVecMatrix(point, world);
  return space_->intersect(world) != FALSE;
}

bool Extractor::Traversal::isInside(SoCallbackAction* action) const {
  return inventor::FullPath(*action->getCurPath()).contains(inventor::FullPath(*request_.path).tail());
}

void Extractor::Traversal::meetCamera(SoCallbackAction* action, const SoCamera* camera) {
  if (scan_.sight) return;
  cameras_.push_back({action->getViewingMatrix(), matrixOf(action->getModelMatrix())});
  if (!isInside(action)) return;
  scan_.ownCamera = true;
  scan_.ownStereo = camera->getStereoMode() != SoCamera::MONOSCOPIC;
}

// By the camera that says what the state says: those in separators that have ended do not.
void Extractor::Traversal::see(SoState* state) {
  viewing_ = SoViewingMatrixElement::get(state);
  const auto camera = std::ranges::find(std::views::reverse(cameras_), viewing_, &Camera::viewing);
  if (camera != cameras_.rend()) scan_.cameraToWorld = camera->toWorld;
  scan_.sight = sightAt(state, scan_.cameraToWorld);
}

void Extractor::Traversal::meetLight(SoCallbackAction* action, const SoNode* node) {
  if (!isInside(action) || !request_.registry->shadows(*node)) return;
  const auto light = lightOf(*node, matrixOf(action->getModelMatrix()));
  if (!light) return;
  // Callbacks show nodes as const; the caller, who has the path, may change them.
  auto* own = const_cast<SoNode*>(node);
  const bool again = std::ranges::find(lightNodes_, node) != lightNodes_.end();
  lightNodes_.push_back(node);
  if (!again) {
    scan_.lights.push_back({own, *light});
  } else if (std::ranges::find(scan_.manifold, own) == scan_.manifold.end()) {
    scan_.manifold.push_back(own);
    std::erase_if(scan_.lights, [&](const PlacedLight& known) { return known.node == own; });
  }
}

Extractor::Extractor() : memory_(std::make_unique<Memory>()) {}
Extractor::~Extractor() = default;

Scan Extractor::scan(const ScanRequest& request) {
  ++memory_->scans;
  Traversal first(*memory_, request, forgotten_, false);
  Scan scan = first.run();
  forgotten_.clear();
  if (first.wantsAnother()) scan = Traversal(*memory_, request, forgotten_, true).run();
  memory_->tidy();
  return scan;
}

void Extractor::forget(const SoNode* node) { forgotten_.push_back(node); }

std::size_t Extractor::extractions() const { return memory_->extractions; }
std::size_t Extractor::kept() const { return memory_->kept(); }

}  // namespace umbrage::coin::detail
