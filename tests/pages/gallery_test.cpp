#include <gmock/gmock.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include "browser.hpp"

namespace umbrage::pages_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

class GalleryPage : public PageTest {
 protected:
  [[nodiscard]] Json figures() const {
    std::ifstream in(file("out/gallery.json"));
    return Json::parse(in);
  }
};

TEST_F(GalleryPage, OpensWithEveryPictureAndNoComplaint) {
  ASSERT_EQ(umbrage("gallery sample:tower --ground --size 320x200 --frames 1 -o out"), 0);
  const auto page = opened("out/index.html");
  EXPECT_THAT(page.complaints, IsEmpty());
  std::size_t shown = 0;
  const Json told = figures();
  for (const auto& technique : told["techniques"]) {
    const bool runs = technique["obstacle"].is_null();
    shown += runs;
    EXPECT_EQ(count(page.dom, "id=\"" + technique["name"].get<std::string>() + "\""), 1u) << technique;
    if (runs && !technique["error"].is_null()) {
      EXPECT_THAT(page.dom,
                  HasSubstr("data-value=\"" + std::to_string(technique["error"]["differing"].get<int>()) + "\""))
          << technique;
    }
  }
  EXPECT_GE(shown, 7u);
  EXPECT_EQ(count(page.dom, "data-ready"), shown + 1) << "every card's pictures are there (and once in the script)";
}

// The same as a reader does: another tab, another place of the slider, the table by costs and the other way round.
TEST_F(GalleryPage, CanBeUsed) {
  ASSERT_EQ(umbrage("gallery sample:tower --ground --size 160x100 --frames 1 --technique zpass_cpu --technique "
                    "hybrid_cpu -o out"),
            0);
  const auto page = opened("out/index.html", R"(
    const card = document.querySelector('.card[data-name="zpass_cpu"]');
    const tabs = card.querySelectorAll('.tabs button');
    const slider = card.querySelector('.slider');
    slider.value = 20;
    slider.dispatchEvent(new Event('input'));
    const said = ['cut ' + card.querySelector('.stage').style.getPropertyValue('--cut')];
    tabs[2].click();
    said.push(tabs[2].textContent + ' ' + card.querySelector('.over').getAttribute('src') + ' ' + slider.hidden);
    tabs[0].click();
    said.push(tabs[0].textContent + ' ' + card.querySelector('.over').getAttribute('src') + ' ' + slider.hidden);
    const column = 5, heading = document.querySelectorAll('th.sorts')[column];
    const values = () => [...document.querySelectorAll('tbody tr')].map((row) => Number(row.children[column].dataset.value));
    const sorted = (sign) => values().every((value, i, all) => i === 0 || sign * (value - all[i - 1]) >= 0);
    heading.click();
    said.push('up ' + sorted(1) + ' ' + heading.getAttribute('aria-sort'));
    heading.click();
    said.push('down ' + sorted(-1) + ' ' + heading.getAttribute('aria-sort'));
    document.body.dataset.said = said.join('; ');
  )");
  EXPECT_THAT(page.complaints, IsEmpty());
  EXPECT_THAT(page.dom, HasSubstr("cut 20%; difference zpass_cpu-difference.png true; picture zpass_cpu.png false; up "
                                  "true ascending; down true descending"));
}

TEST_F(GalleryPage, NamesFromFilesStayText) {
  std::ofstream(file("<img src=x onerror=alert(1)>.off"))
      << "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 1\n3 0 1 2\n3 0 2 3\n";
  ASSERT_EQ(umbrage("gallery '<img src=x onerror=alert(1)>.off' --size 64x48 --frames 1 --technique zpass_cpu -o out"),
            0);
  const auto page = opened("out/index.html");
  EXPECT_THAT(page.complaints, IsEmpty());
  EXPECT_EQ(count(page.dom, "<img src=\"x\""), 0u);
}

}  // namespace
}  // namespace umbrage::pages_test
