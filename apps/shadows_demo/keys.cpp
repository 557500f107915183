#include "keys.hpp"

#include <fmt/format.h>
#include <Qt>

#include <algorithm>
#include <iterator>

#include "demo.hpp"

namespace umbrage::demo {
namespace {

constexpr float kStep = 0.25f, kZoom = 1.1f, kIntensityStep = 0.1f, kAmbientStep = 0.1f;

template <std::size_t lamp>
Said toggleLamp(Demo& demo) {
  return demo.toggleLamp(lamp);
}

// A row of the help begins where the help is not empty and takes the names that follow along.
constexpr Key kKeys[] = {
    {Qt::Key_F1, "F1", "shadows on, off", false, false, [](Demo& d) { return d.toggleShadows(); }},
    {Qt::Key_F2, "F2", "z-fail, z-pass", false, false, [](Demo& d) { return d.toggleMethod(); }},
    {Qt::Key_F3, "F3", "sensors on, off: off, Coin is not told that an object moved, and the picture waits", false,
     false, [](Demo& d) { return d.toggleSensors(); }},
    {Qt::Key_F4, "F4", "shadow volumes shown, hidden", false, false, [](Demo& d) { return d.toggleVolumes(); }},
    {Qt::Key_F5, "F5", "object 1 twice, half the size", false, false, [](Demo& d) { return d.scale(2.0f); }},
    {Qt::Key_F6, "F6", "", false, false, [](Demo& d) { return d.scale(0.5f); }},
    {Qt::Key_F7, "F7", "object 1 a little larger, smaller", true, false, [](Demo& d) { return d.scale(kZoom); }},
    {Qt::Key_F8, "F8", "", true, false, [](Demo& d) { return d.scale(1.0f / kZoom); }},
    {Qt::Key_F9, "F9", "light 1 on, off", false, false, [](Demo& d) { return d.toggleFirstLamp(); }},
    {Qt::Key_F11, "F11", "ambient light more, less", true, false, [](Demo& d) { return d.brighten(kAmbientStep); }},
    {Qt::Key_F12, "F12", "", true, false, [](Demo& d) { return d.brighten(-kAmbientStep); }},
    {Qt::Key_BraceLeft, "{", "light 1 brighter, darker", true, false,
     [](Demo& d) { return d.intensify(kIntensityStep); }},
    {Qt::Key_BraceRight, "}", "", true, false, [](Demo& d) { return d.intensify(-kIntensityStep); }},
    {Qt::Key_1, "1", "point lights come, go", false, false, toggleLamp<0>},
    {Qt::Key_2, "2", "", false, false, toggleLamp<1>},
    {Qt::Key_3, "3", "", false, false, toggleLamp<2>},
    {Qt::Key_4, "4", "", false, false, toggleLamp<3>},
    {Qt::Key_5, "5", "the directional light comes, goes", false, false, toggleLamp<4>},
    {Qt::Key_6, "6", "the spot light comes, goes", false, false, toggleLamp<5>},
    {Qt::Key_O, "O", "the second object comes, goes", false, false, [](Demo& d) { return d.toggleSecond(); }},
    {Qt::Key_V, "V", "shadow volumes into ShadowVolumes.iv", false, false, [](Demo& d) { return d.exportVolumes(); }},
    {Qt::Key_X, "X", "the scene with its volumes into SceneRoot.iv", false, false,
     [](Demo& d) { return d.exportScene(); }},
    {Qt::Key_Left, "Left", "object 1 to the sides (action mode)", true, true,
     [](Demo& d) { return d.move(-kStep, 0, 0); }},
    {Qt::Key_Right, "Right", "", true, true, [](Demo& d) { return d.move(kStep, 0, 0); }},
    {Qt::Key_Up, "Up", "object 1 up, down (action mode)", true, true, [](Demo& d) { return d.move(0, kStep, 0); }},
    {Qt::Key_Down, "Down", "", true, true, [](Demo& d) { return d.move(0, -kStep, 0); }},
    {Qt::Key_PageUp, "PageUp", "object 1 away, nearer (action mode)", true, true,
     [](Demo& d) { return d.move(0, 0, -kStep); }},
    {Qt::Key_PageDown, "PageDown", "", true, true, [](Demo& d) { return d.move(0, 0, kStep); }},
};

}  // namespace

const Key* keyOf(int code) {
  const auto found = std::ranges::find(kKeys, code, &Key::code);
  return found != std::end(kKeys) ? &*found : nullptr;
}

const Key* keyNamed(const std::string& name) {
  const auto found = std::ranges::find_if(kKeys, [&](const Key& key) { return name == key.name; });
  return found != std::end(kKeys) ? &*found : nullptr;
}

std::string keyHelp() {
  std::string text =
      "ESC changes the mode. Viewer: the mouse moves the camera; S, then a click, goes to what is clicked.\n"
      "Action: the mouse drags the lights, the arrows move the object.\nKeys:\n";
  for (const Key* key = std::begin(kKeys); key != std::end(kKeys);) {
    const char* help = key->help;
    std::string names = key->name;
    for (++key; key != std::end(kKeys) && *key->help == '\0'; ++key) names += fmt::format(" {}", key->name);
    text += fmt::format("  {:<16} {}\n", names, help);
  }
  return text;
}

}  // namespace umbrage::demo
