#include "umbrage/io/reader/inventor_files.hpp"

#include <Inventor/SbImage.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/VRMLnodes/SoVRMLInline.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoMemoryError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/fields/SoSFTime.h>
#include <Inventor/lists/SbStringList.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/misc/SoProto.h>
#include <Inventor/nodes/SoFile.h>
#include <Inventor/nodes/SoWWWInline.h>

#include <algorithm>
#include <set>
#include <vector>

#include "umbrage/io/reader/files.hpp"

namespace umbrage::io::reader {
namespace {

constexpr int kMaxIncludeDepth = 16;
constexpr int kMaxIncludes = 1000;

// Coin's callbacks of its static kind carry no data of ours, and Coin itself is one per process; so is this.
struct Session {
  std::filesystem::path folder;
  Complaints* complaints = nullptr;
  int depth = 0;     // of includes within includes, now
  int includes = 0;  // in all
};
Session& session() {
  static Session only;
  return only;
}

void listen(const SoError* error, void*) {
  std::string text = error->getDebugString().getString();
  for (const std::string& noise :
       {session().folder.string() + "/", std::string("Coin read error: "), std::string("\t")})
    for (auto at = text.find(noise); at != std::string::npos; at = text.find(noise)) text.erase(at, noise.size());
  std::replace(text.begin(), text.end(), '\n', ' ');
  // Textures are not missed, nor are the scripts that would move things.
  if (text.find("texture file") != std::string::npos || text.find("script language") != std::string::npos) return;
  session().complaints->add(text);
}

// A pixel for every picture: textures do not matter here, and their decoders are one more thing that can break.
SbBool paintNothing(const SbString&, SbImage* image, void*) {
  const unsigned char white = 255;
  image->setValue(SbVec2s(1, 1), 1, &white);
  return TRUE;
}

SbString locate(const SbString& name) {
  return SoInput::searchForFile(name, SoInput::getDirectories(), SbStringList());
}

// Counts how deep includes are nested while it lives.
class Include {
 public:
  explicit Include(const SbString& name) : path_(locate(name)) {
    if (++session().depth > kMaxIncludeDepth || ++session().includes > kMaxIncludes)
      session().complaints->add("files include each other without end");
    else if (!isInside(session().folder, path_.getString()))
      session().complaints->add(std::string("left out, not found in the scene's folder: ") + name.getString());
    else
      allowed_ = true;
  }
  ~Include() { --session().depth; }
  Include(const Include&) = delete;
  Include& operator=(const Include&) = delete;
  [[nodiscard]] bool allowed() const { return allowed_; }
  [[nodiscard]] SoSeparator* read() const {
    SoInput in;
    return in.openFile(path_.getString()) ? SoDB::readAll(&in) : nullptr;
  }

 private:
  SbString path_;
  bool allowed_ = false;
};

class FolderFile : public SoFile {
 public:
  static void* make() { return new FolderFile; }

 protected:
  SbBool readNamedFile(SoInput* in) override {
    if (name.isDefault()) return TRUE;
    const Include include(name.getValue());
    return include.allowed() ? SoFile::readNamedFile(in) : TRUE;
  }
};

// Every node once, without recursion.
std::vector<SoNode*> nodesBelow(SoNode* root) {
  std::vector<SoNode*> nodes = {root};
  std::set<SoNode*> seen = {root};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const SoChildList* children = nodes[i]->getChildren())
      for (int k = 0; k < children->getLength(); ++k)
        if (seen.insert((*children)[k]).second) nodes.push_back((*children)[k]);
  return nodes;
}

void fillInlines(SoNode* root);

template <class Inline>
void fill(const SbString& url, Inline* node) {
  const Include include(url);
  SoSeparator* child = include.allowed() ? include.read() : nullptr;
  if (child == nullptr) return;
  fillInlines(child);
  node->setChildData(child);
}

void fillInlines(SoNode* root) {
  for (SoNode* node : nodesBelow(root)) {
    if (node->isOfType(SoWWWInline::getClassTypeId()))
      fill(static_cast<SoWWWInline*>(node)->name.getValue(), static_cast<SoWWWInline*>(node));
    else if (node->isOfType(SoVRMLInline::getClassTypeId()) && static_cast<SoVRMLInline*>(node)->url.getNum() > 0)
      fill(static_cast<SoVRMLInline*>(node)->url[0], static_cast<SoVRMLInline*>(node));
  }
}

SoProto* refuseProto(SoInput*, const SbString* urls, const int count, void*) {
  if (count > 0) session().complaints->add(std::string("external prototypes are not read: ") + urls[0].getString());
  return nullptr;
}

void startCoin() {
  SoDB::init();
  SoInteraction::init();
  SoError::setHandlerCallback(listen, nullptr);
  SoDebugError::setHandlerCallback(listen, nullptr);
  SoReadError::setHandlerCallback(listen, nullptr);
  SoMemoryError::setHandlerCallback(listen, nullptr);
  SbImage::addReadImageCB(paintNothing, nullptr);
  SoType::overrideType(SoFile::getClassTypeId(), FolderFile::make);
  // Inlines are read afterwards, by fillInlines.
  SoWWWInline::setReadAsSoFile(FALSE);
  SoVRMLInline::setReadAsSoFile(FALSE);
  SoProto::setFetchExternProtoCallback(refuseProto, nullptr);
  // Moving parts stand where they stand at time zero, so that the same file gives the same scene.
  SoDB::enableRealTimeSensor(FALSE);
  if (auto* clock = static_cast<SoSFTime*>(SoDB::getGlobalField("realTime"))) clock->setValue(SbTime::zero());
}

}  // namespace

SoSeparator* readInventorFile(const std::filesystem::path& file, Complaints& complaints) {
  session() = {file.parent_path(), &complaints};
  startCoin();
  SoInput::clearDirectories();
  SoInput::addDirectoryFirst(file.parent_path().c_str());
  SoInput in;
  if (!in.openFile(file.c_str())) return nullptr;
  SoSeparator* root = SoDB::readAll(&in);
  if (root != nullptr) fillInlines(root);
  return root;
}

}  // namespace umbrage::io::reader
