#include "umbrage/report/study_page.hpp"

#include <gmock/gmock.h>

namespace umbrage::report {
namespace {

using testing::HasSubstr;
using testing::Not;

StudyPage small() {
  StudyPage page;
  page.title = "Sun at the <school>";
  page.passes = false;
  page.verdict = "1 of 2 windows has too little sun";
  page.criteria = {{"2 h of sun", "1 of 2", "all", "-12 min", false}};
  page.whyOtherwise = "The margin is small.";
  page.otherwise = {{"refraction", "none", "standard", "+1 min", true}};
  page.charts = {{.title = "Windows",
                  .axis = {8.0, 16.0},
                  .counts = {{9.0, 15.0}},
                  .shown = "sun",
                  .bars = {{"west & east", "2 h 00 min", true, {{10.0, 12.0}}}, {"north", "0 h", false, {}}}}};
  page.tables = {{.title = "A table", .note = "", .columns = {"a", "b"}, .rows = {{"1", "<2>"}}}};
  page.ledger = {{"clock", "true solar time"}};
  page.evidence = {"evidence.csv"};
  page.command = "umbrage verify";
  return page;
}

TEST(StudyPage, TellsTheVerdictFirst) {
  const auto text = studyPage(small());
  EXPECT_THAT(text, HasSubstr("<title>Sun at the &lt;school&gt;</title>"));
  EXPECT_THAT(text, HasSubstr("<div class=\"verdict bad\"><strong class=\"bad\">Fails</strong><span>1 of 2 windows"));
  EXPECT_LT(text.find("<div class=\"verdict bad"), text.find("2 h of sun"));
  EXPECT_THAT(
      text,
      HasSubstr("<td>refraction</td><td>none</td><td>standard</td><td>+1 min</td><td class=\"good\">passes</td>"));
  EXPECT_THAT(text, HasSubstr("<td>&lt;2&gt;</td>"));
  EXPECT_THAT(text, HasSubstr("<dt>clock</dt><dd>true solar time</dd>"));
}

TEST(StudyPage, NothingJudgedHasNoVerdict) {
  auto page = small();
  page.passes.reset();
  EXPECT_THAT(studyPage(page), HasSubstr("<div class=\"verdict\"><span>"));
  page.verdict.clear();
  EXPECT_THAT(studyPage(page), Not(HasSubstr("<div class=\"verdict")));
}

// The bars stand where their hours are: 620 units for 8 hours, from 250 on.
TEST(StudyPage, BarsStandAtTheirHours) {
  const auto text = studyPage(small());
  EXPECT_THAT(text, HasSubstr("<rect class=\"part\" x=\"405.00\" y=\"28.00\" width=\"155.00\""));
  EXPECT_THAT(text, HasSubstr("<rect class=\"out\" x=\"250.00\" y=\"20.00\" width=\"77.50\""))
      << "8 to 9 does not count";
  EXPECT_THAT(text, HasSubstr("<rect class=\"out\" x=\"792.50\" y=\"20.00\" width=\"77.50\"")) << "nor 15 to 16";
  EXPECT_THAT(text, HasSubstr(">west &amp; east</text>"));
}

TEST(StudyPage, PicturesStandInsideAsBase64) {
  auto page = small();
  page.pictures = {{"09:00", {'M'}}, {"10:00", {'M', 'a'}}, {"11:00", {'M', 'a', 'n'}}};
  const auto text = studyPage(page);
  for (const auto* coded : {"base64,TQ==\"", "base64,TWE=\"", "base64,TWFu\""}) EXPECT_THAT(text, HasSubstr(coded));
  EXPECT_THAT(text, HasSubstr("max=\"2\""));
}

TEST(StudyPage, LongNamesAreCutBetweenLetters) {
  auto page = small();
  page.charts[0].bars[0].name.clear();
  for (int i = 0; i < 60; ++i) page.charts[0].bars[0].name += "\xC3\xA4";
  const auto text = studyPage(page);
  EXPECT_THAT(text, HasSubstr("\xC3\xA4\xE2\x80\xA6</text>"));
  EXPECT_THAT(text, Not(HasSubstr("\xEF\xBF\xBD"))) << "no letter is cut in two";
}

TEST(StudyPage, OfNothingIsAPageToo) { EXPECT_THAT(studyPage({}), HasSubstr("</html>")); }

}  // namespace
}  // namespace umbrage::report
