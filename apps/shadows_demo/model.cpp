#include "model.hpp"

#include <Inventor/SoDB.h>
#include <Inventor/SoFullPath.h>
#include <Inventor/SoInput.h>
#include <Inventor/VRMLnodes/SoVRMLLight.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoCamera.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoLight.h>
#include <Inventor/nodes/SoSeparator.h>

#include "umbrage/inventor/check.hpp"

namespace umbrage::demo {
namespace {

/// While it lives, what Coin has against a file is kept instead of printed.
class ReadErrors {
 public:
  ReadErrors() : former_(SoReadError::getHandlerCallback()), formerData_(SoReadError::getHandlerData()) {
    SoReadError::setHandlerCallback(note, this);
  }
  ReadErrors(const ReadErrors&) = delete;
  ReadErrors& operator=(const ReadErrors&) = delete;
  ~ReadErrors() { SoReadError::setHandlerCallback(former_, formerData_); }

  [[nodiscard]] const std::string& first() const { return first_; }

 private:
  static void note(const SoError* error, void* self) {
    std::string& first = static_cast<ReadErrors*>(self)->first_;
    if (first.empty()) first = error->getDebugString().getString();
  }
  SoErrorCB* former_;
  void* formerData_;
  std::string first_;
};

// The first node of a type, taken out of its parent; false where there is none that can be.
bool removeFirst(SoGroup* root, const SoType& type) {
  SoSearchAction search;
  search.setType(type);
  search.setInterest(SoSearchAction::FIRST);
  search.setSearchingAll(TRUE);
  search.apply(root);
  if (search.getPath() == nullptr) return false;
  auto* path = static_cast<SoFullPath*>(search.getPath());
  SoNode* parent = path->getNodeFromTail(1);
  if (!parent->isOfType(SoGroup::getClassTypeId())) return false;
  static_cast<SoGroup*>(parent)->removeChild(path->getTail());
  return true;
}

}  // namespace

Result<Ref<SoSeparator>> readModel(const std::filesystem::path& file) {
  const ReadErrors errors;
  SoInput input;
  if (!input.openFile(file.c_str(), TRUE)) return fail(ErrorCode::input, "cannot be opened", file);
  SoSeparator* read = SoDB::readAll(&input);
  if (read == nullptr)
    return fail(ErrorCode::input, "is no Inventor or VRML file that Coin can read: " + errors.first(), file);
  Ref<SoSeparator> model = hold(read);
  if (const auto fine = inventor::checkGraph(read); !fine) return fail(ErrorCode::input, fine.error().message, file);
  for (const SoType& type : {SoCamera::getClassTypeId(), SoLight::getClassTypeId(), SoVRMLLight::getClassTypeId()})
    while (removeFirst(read, type)) {
    }
  return model;
}

}  // namespace umbrage::demo
