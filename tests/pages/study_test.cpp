#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "browser.hpp"
#include "support/test_data.hpp"

// The page of a verdict against the table that is written beside it.
namespace umbrage::pages_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// "h:mm:ss", as the page tells hours.
std::string told(double hours) {
  const auto seconds = std::llround(hours * 3600.0);
  std::ostringstream out;
  out << seconds / 3600 << (seconds / 60 % 60 < 10 ? ":0" : ":") << seconds / 60 % 60
      << (seconds % 60 < 10 ? ":0" : ":") << seconds % 60;
  return out.str();
}

/// The column "hours" of a verdict's table; its first two columns are quoted.
std::vector<double> hoursOf(const std::filesystem::path& table) {
  std::ifstream in(table);
  std::vector<double> hours;
  std::string line;
  std::getline(in, line);
  EXPECT_THAT(line, testing::StartsWith("group,requirement,x,y,z,nx,ny,nz,weight,from_site,passes,hours,"));
  while (std::getline(in, line)) {
    std::istringstream cells(line.substr(line.rfind('"') + 2));
    std::string cell;
    for (int column = 2; column <= 11 && std::getline(cells, cell, ','); ++column)
      if (column == 11) hours.push_back(std::stod(cell));
  }
  return hours;
}

class StudyPage : public PageTest {
 protected:
  /// Of the small town of the documentation.
  [[nodiscard]] int verify(const std::string& words) const {
    return umbrage("verify '" UMBRAGE_SOURCE_DIR "/docs/verify/plan.geojson' --date 2026-01-01 " + words +
                   " -o page.html");
  }
  [[nodiscard]] static std::string example(const char* name) {
    return std::string("'" UMBRAGE_SOURCE_DIR "/docs/verify/") + name + "' ";
  }
};

TEST_F(StudyPage, TellsWhatItsTableTells) {
  ASSERT_EQ(verify("--lat 52.37 --lon 4.9 --tz Europe/Amsterdam --preset tno-light --points " + example("windows.csv")),
            0);
  const auto page = opened("page.html");
  EXPECT_THAT(page.complaints, IsEmpty());
  EXPECT_THAT(page.dom, HasSubstr("<body data-ready"));
  EXPECT_THAT(page.dom, HasSubstr(">Passes</strong>"));
  const auto hours = hoursOf(file("page.csv"));
  ASSERT_EQ(hours.size(), 9u);
  for (const double value : hours) EXPECT_THAT(page.dom, HasSubstr(": " + told(value) + "</title>"));
  EXPECT_EQ(count(page.dom, "<g><title>"), hours.size()) << "a bar for each receiver";
  for (const auto* beside : {"page.geojson", "page.gif", "page.csv.ledger.txt"}) {
    EXPECT_TRUE(std::filesystem::exists(file(beside)));
    EXPECT_THAT(page.dom, HasSubstr(beside));
  }
}

TEST_F(StudyPage, ShowsADayByItsSlider) {
  ASSERT_EQ(verify("--lat 40.71 --lon -74 --tz=-05:00 --preset nyc-ceqr --baseline " + example("now.geojson") +
                   "--areas " + example("park.geojson")),
            1);
  const auto page = opened("page.html", R"(
    const shown = () => [...document.querySelectorAll('.show figure')].map((f) => getComputedStyle(f).display !== 'none').indexOf(true);
    const slider = document.querySelector('.controls input');
    const said = [];
    for (const place of [0, 3]) {
      slider.value = place;
      slider.dispatchEvent(new Event('input'));
      said.push(shown());
    }
    document.body.dataset.said = said.join(' ') + ' of ' + document.querySelectorAll('.show figure').length;
  )");
  EXPECT_THAT(page.complaints, IsEmpty());
  EXPECT_THAT(page.dom, HasSubstr(">Fails</strong>"));
  EXPECT_THAT(page.dom, HasSubstr("data-said=\"0 3 of "));
  EXPECT_THAT(page.dom, HasSubstr("<td>park</td><td>tower</td>")) << "whose new shadow it is";
}

TEST_F(StudyPage, OfATownIsSmallEnoughToSend) {
  const auto data = support::testData();
  if (data.empty()) GTEST_SKIP() << "no test data: set UMBRAGE_TEST_DATA";
  ASSERT_EQ(
      umbrage(
          "verify '" + (data / "city/delft.json").string() +
          "' --date 2026-01-01 --tz Europe/Amsterdam --preset tno-light --windows 'b1105d28c*' --grid 3 -o page.html"),
      1);
  const auto page = opened("page.html");
  EXPECT_THAT(page.complaints, IsEmpty());
  EXPECT_LT(std::filesystem::file_size(file("page.html")), std::uintmax_t{10} << 20);
  const auto hours = hoursOf(file("page.csv"));
  std::size_t passing = 0;
  for (const double value : hours) passing += value >= 2.0;
  std::ostringstream share;
  share.precision(1);
  share << std::fixed << 100.0 * double(passing) / double(hours.size()) << " % of " << hours.size()
        << " receivers pass";
  EXPECT_THAT(page.dom, HasSubstr(share.str()));
}

}  // namespace
}  // namespace umbrage::pages_test
