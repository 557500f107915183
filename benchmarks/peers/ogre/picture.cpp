#include "picture.hpp"

#include <Ogre.h>

#include <algorithm>
#include <chrono>

namespace umbrage::peers {
namespace {

// Shadow volumes double the corners, and their indices have 16 bits.
constexpr std::size_t kMostCorners = 32767;
constexpr const char* kMaterial = "grey";

Ogre::Vector3 vector(const Point& p) { return {Ogre::Real(p[0]), Ogre::Real(p[1]), Ogre::Real(p[2])}; }

std::vector<Ogre::Vector3> normals(const Part& part) {
  std::vector<Ogre::Vector3> sums(part.corners.size(), Ogre::Vector3::ZERO);
  for (const auto& t : part.triangles) {
    const Ogre::Vector3 a = vector(part.corners[t[0]]);
    const Ogre::Vector3 n = (vector(part.corners[t[1]]) - a).crossProduct(vector(part.corners[t[2]]) - a);
    for (unsigned corner : t) sums[corner] += n;
  }
  for (auto& n : sums) n.normalise();
  return sums;
}

Ogre::MeshPtr makeMesh(Ogre::SceneManager& scenes, const std::string& name, const Part& part) {
  Ogre::ManualObject* object = scenes.createManualObject(name);
  object->begin(kMaterial, Ogre::RenderOperation::OT_TRIANGLE_LIST);
  const auto normal = normals(part);
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    object->position(vector(part.corners[i]));
    object->normal(normal[i]);
  }
  for (const auto& t : part.triangles) object->triangle(t[0], t[1], t[2]);
  object->end();
  Ogre::MeshPtr mesh = object->convertToMesh(name);
  scenes.destroyManualObject(object);
  if (part.casts) mesh->buildEdgeList();
  return mesh;
}

Ogre::Real farthest(const Stage& stage, const Ogre::Vector3& from) {
  Ogre::Real distance = 0;
  for (const Part& part : stage.parts)
    for (const Point& p : part.corners) distance = std::max(distance, from.distance(vector(p)));
  return distance;
}

void makeMaterial() {
  auto material = Ogre::MaterialManager::getSingleton().create(kMaterial, Ogre::RGN_DEFAULT);
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  pass->setAmbient(0.8f, 0.8f, 0.8f);
  pass->setDiffuse(0.8f, 0.8f, 0.8f, 1.0f);
}

}  // namespace

struct Picture::State {
  Settings settings;
  std::unique_ptr<Ogre::LogManager> log = std::make_unique<Ogre::LogManager>();
  std::unique_ptr<Ogre::Root> root;
  Ogre::RenderWindow* window = nullptr;
  Ogre::SceneManager* scenes = nullptr;
  Ogre::SceneNode* light = nullptr;
  Ogre::Vector3 lightAt;
  Ogre::Real range = 0;  ///< the scene's farthest corner from the light, and a little more
  std::size_t entities = 0;

  void open();
  void prepareShadows();
  void addGeometry(const Stage& stage);
  void addLight(const Point& at);
  void addCamera(const StageShot& shot);
};

void Picture::State::open() {
  log->createLog("ogre.log", true, false, true);
  root = std::make_unique<Ogre::Root>("", "", "");
  root->loadPlugin(std::string(OGRE_PEER_PLUGINS) + "/" + settings.system);
  root->setRenderSystem(root->getAvailableRenderers().front());
  root->initialise(false);
  const Ogre::NameValuePairList options{{"vsync", "false"}, {"FSAA", "0"}};
  window = root->createRenderWindow("peer", static_cast<unsigned>(settings.width),
                                    static_cast<unsigned>(settings.height), false, &options);
  auto& resources = Ogre::ResourceGroupManager::getSingleton();
  resources.addResourceLocation(std::string(OGRE_PEER_MEDIA) + "/ShadowVolume", "FileSystem", Ogre::RGN_INTERNAL);
  resources.initialiseAllResourceGroups();
  scenes = root->createSceneManager();
}

void Picture::State::prepareShadows() {
  scenes->setAmbientLight(Ogre::ColourValue(0.25f, 0.25f, 0.25f));
  if (!settings.shadows) return;
  scenes->setShadowTechnique(settings.additive ? Ogre::SHADOWTYPE_STENCIL_ADDITIVE
                                               : Ogre::SHADOWTYPE_STENCIL_MODULATIVE);
  scenes->setShadowUseInfiniteFarPlane(settings.infinite);
  scenes->setShadowFarDistance(0);  // no caster is left out for being far away
  if (settings.indices > 0) scenes->setShadowIndexBufferSize(settings.indices);
}

void Picture::State::addGeometry(const Stage& stage) {
  for (const Part& part : merged(stage.parts, settings.tile, kMostCorners)) {
    const std::string name = "part" + std::to_string(entities++);
    Ogre::Entity* entity = scenes->createEntity(name, makeMesh(*scenes, name, part));
    entity->setCastShadows(part.casts);
    scenes->getRootSceneNode()->createChildSceneNode()->attachObject(entity);
  }
}

void Picture::State::addLight(const Point& at) {
  Ogre::Light* lamp = scenes->createLight("light");
  lamp->setType(Ogre::Light::LT_POINT);
  lamp->setAttenuation(range, 1.0f, 0.0f, 0.0f);
  lamp->setCastShadows(settings.shadows);
  lightAt = vector(at);
  light = scenes->getRootSceneNode()->createChildSceneNode(lightAt);
  light->attachObject(lamp);
}

void Picture::State::addCamera(const StageShot& shot) {
  Ogre::Camera* camera = scenes->createCamera("camera");
  Ogre::SceneNode* node = scenes->getRootSceneNode()->createChildSceneNode(vector(shot.eye));
  node->attachObject(camera);
  node->setFixedYawAxis(true, Ogre::Vector3::UNIT_Z);
  node->lookAt(vector(shot.target), Ogre::Node::TS_WORLD);
  camera->setNearClipDistance(0.5f);
  camera->setFarClipDistance(settings.infinite ? 0.0f : 2 * range);
  camera->setFOVy(Ogre::Radian(Ogre::Real(shot.fovY)));
  camera->setAspectRatio(Ogre::Real(settings.width) / Ogre::Real(settings.height));
  window->addViewport(camera)->setBackgroundColour(Ogre::ColourValue(0.86f, 0.9f, 0.93f));
}

Picture::Picture(const Stage& stage, const StageShot& shot, const Settings& settings) : state_(new State) {
  state_->settings = settings;
  state_->range = 1.25f * farthest(stage, vector(shot.light));
  state_->open();
  makeMaterial();
  state_->prepareShadows();
  state_->addLight(shot.light);
  state_->addGeometry(stage);
  state_->addCamera(shot);
}

Picture::~Picture() = default;

double Picture::frame(double shift) {
  using Clock = std::chrono::steady_clock;
  State& s = *state_;
  s.light->setPosition(s.lightAt + Ogre::Vector3(Ogre::Real(shift), 0, 0));
  const auto start = Clock::now();
  s.root->_fireFrameStarted();
  s.window->update(false);
  std::uint8_t one[4];
  s.window->copyContentsToMemory({0, 0, 1, 1}, Ogre::PixelBox(1, 1, 1, Ogre::PF_BYTE_RGBA, one),
                                 Ogre::RenderTarget::FB_BACK);
  s.root->_fireFrameEnded();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<std::uint8_t> Picture::pixels() const {
  const auto width = static_cast<std::uint32_t>(state_->settings.width);
  const auto height = static_cast<std::uint32_t>(state_->settings.height);
  std::vector<std::uint8_t> out(std::size_t(3) * width * height);
  state_->window->copyContentsToMemory({0, 0, width, height},
                                       Ogre::PixelBox(width, height, 1, Ogre::PF_BYTE_RGB, out.data()),
                                       Ogre::RenderTarget::FB_BACK);
  return out;
}

std::size_t Picture::entities() const { return state_->entities; }
std::size_t Picture::batches() const { return state_->window->getStatistics().batchCount; }

}  // namespace umbrage::peers
