#include "umbrage/rules/rule_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace umbrage::rules {
namespace {

using testing::HasSubstr;

const std::string kGood = R"({"name":"mine","title":"My town","source":"its plan","receivers":{"kind":"points"},
  "requirements":[{"name":"2 h","days":{"dates":["03-21"]},"window":{"clock":"solar","from":"08:00","to":"16:00"},
                   "statistic":"sun","at_least_hours":2}]})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(RuleFile, readsAllOfIt) {
  const auto rule = parseRule(kGood, "mine.json");
  ASSERT_TRUE(rule) << rule.error().text();
  EXPECT_EQ(rule->name, "mine");
  ASSERT_EQ(rule->requirements.size(), 1u);
  const Measure& m = rule->requirements[0].anyOf.at(0);
  EXPECT_EQ(m.threshold, std::chrono::hours(2));
  EXPECT_EQ(m.window.to, std::chrono::hours(16));
  EXPECT_EQ(m.days.dates.at(0), std::chrono::March / 21);
  EXPECT_FALSE(needsBaseline(*rule));
}

TEST(RuleFile, contradictionsAndSlipsAreNamed) {
  const std::tuple<std::string, const char*> wrong[] = {
      {"{", "is not JSON"},
      {"[]", "an object"},
      {std::string(200, '['), "nested deeper than 64 levels"},
      {with("\"08:00\"", "\"17:00\""), "requirements[0].window: the window is empty"},
      {with("\"08:00\"", "\"8 h\""), "requirements[0].window.from"},
      {with("\"clock\":\"solar\",", ""), "window.clock: is missing"},
      {with("\"clock\":\"solar\"", "\"clock\":\"sundial\""), "one of solar, zone, standard"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":9"), "9 h are wanted of a window of 8 h"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":-1"), "a number from 0 to 24"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":0"), "always there"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"at_most_hours\":3"), "exactly one of"},
      {with(",\"at_least_hours\":2", ""), "exactly one of"},
      {with("\"at_least_hours\":2", "\"at_most_hours\":2"), "sun wants at_least_hours"},
      {with("\"statistic\":\"sun\"", "\"statistic\":\"shadow\""), "shadow wants at_most_hours"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"at_leest\":3"), "requirements[0].at_leest: no such member"},
      {with("\"03-21\"", "\"02-30\""), "'02-30' is no day"},
      {with("{\"dates\":[\"03-21\"]}", "{\"dates\":[\"03-21\"],\"solar_longitudes\":[0]}"), "exclude each other"},
      {with("{\"dates\":[\"03-21\"]}", "{}"), "is wanted"},
      {with("{\"dates\":[\"03-21\"]}", "{\"from\":\"02-01\"}"), "belong together"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"share\":0"), "a share above 0"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"metres_from_site\":{\"from\":5}"),
       "receivers of kind site"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"least_run_minutes\":\"5\""), "least_run_minutes"},
      {with("\"kind\":\"points\"},\n  \"requirements\":[{", "\"kind\":\"site\"},\n  \"requirements\":[{\"share\":0.5,"),
       "wants an end"},
      {with("\"name\":\"mine\"", "\"name\":\"mine\",\"checked\":\"the act\""), "checked: a list of texts is wanted"},
      {with("\"name\":\"mine\"", "\"name\":\"mine\",\"checked\":[\"the act\",1]"), "checked[1]: a text is wanted"},
      {with("\"name\":\"mine\"", "\"name\":\"mine\",\"uncertain\":\"all\""), "uncertain: a list of texts is wanted"},
      {with("\"name\":\"mine\"", "\"name\":\"mine\",\"cheked\":[]"), "cheked: no such member"},
      {with("\"kind\":\"points\"", "\"kind\":\"windows\""), "one of points, areas, site"},
      {with("\"kind\":\"points\"", "\"kind\":\"points\",\"height\":2"), "points lie where they are"},
      {with("\"name\":\"mine\",", ""), "name: is missing"},
      {with("\"requirements\":[", "\"requirements\":[],\"other\":["), "requirements: is missing or empty"},
      {with("\"at_least_hours\":2", "\"at_most_new_share\":0.1,\"share\":0.5"), "stands alone"},
      // The same member twice: nobody knows which is meant.
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"at_least_hours\":3"),
       "requirements[0].at_least_hours: is there twice"},
      {with("\"name\":\"mine\"", "\"name\":\"mine\",\"name\":\"yours\""), "name: is there twice"},
      {with("\"clock\":\"solar\"", "\"clock\":\"solar\",\"clock\":\"zone\""), "requirements[0].window.clock: is there"},
      // Numbers that are none, too large, or no whole ones.
      {with("\"at_least_hours\":2", "\"at_least_hours\":1e999"),
       "requirements[0].at_least_hours: the number is too large"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":NaN"), "in requirements[0].at_least_hours"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":24.5"),
       "requirements[0].at_least_hours: a number from 0 to 24"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":\"2\""), "requirements[0].at_least_hours: a number"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":true"), "requirements[0].at_least_hours: a number"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"share\":1.5"),
       "requirements[0].share: a number from 0 to 1"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"or_former_times\":-0.1"),
       "requirements[0].or_former_times: "},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"least_sun_altitude\":90"), "least_sun_altitude: a number"},
      {with("\"at_least_hours\":2", "\"more_than_hours\":8"), "more than 8 h are wanted of a window of 8 h"},
      {with("{\"dates\":[\"03-21\"]}", R"({"from":"02-01","to":"03-21","every":1.7})"),
       "requirements[0].days.every: a whole number from 1 to 366"},
      {with("{\"dates\":[\"03-21\"]}", R"({"from":"02-01","to":"03-21","every":0})"), "a whole number from 1 to 366"},
      {with("{\"dates\":[\"03-21\"]}", R"({"dates":["03-21"],"every":7})"), "every: belongs to from and to"},
      {with("{\"dates\":[\"03-21\"]}", R"({"dates":["03-21",5]})"), "requirements[0].days.dates[1]: a text"},
      {with("{\"dates\":[\"03-21\"]}", R"({"solar_longitudes":[0,361]})"), "days.solar_longitudes[1]: a number"},
      // Which days are meant must be said.
      {with("\"days\":{\"dates\":[\"03-21\"]},", ""), "requirements[0].days: is missing"},
      {with("{\"dates\":[\"03-21\"]}", "[]"), "requirements[0].days: an object"},
      {with("{\"dates\":[\"03-21\"]}", "{\"dates\":[]}"), "requirements[0].days.dates: is empty"},
      {with("{\"dates\":[\"03-21\"]}", "{\"solar_longitudes\":[]}"), "requirements[0].days.solar_longitudes: is empty"},
      {with("{\"dates\":[\"03-21\"]}", "{\"given\":false}"), "given: true is wanted"},
      {with("{\"dates\":[\"03-21\"]}", R"({"dates":["03-21"],"given":true})"), "exclude each other"},
      {with("{\"dates\":[\"03-21\"]}", R"({"dates":["03-21"],"givn":true})"),
       "there are dates, solar_longitudes, from"},
      // What always holds, or never.
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"statistic\":\"shadow\",\"at_most_hours\":10"),
       "requirements[0].at_most_hours: always holds: the window has 8 h"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"statistic\":\"shadow\",\"at_most_hours\":8"),
       "requirements[0].at_most_hours: always holds"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"statistic\":\"new_shadow\",\"less_than_hours\":24"),
       "requirements[0].less_than_hours: always holds"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"at_most_new_share\":1"),
       "requirements[0].at_most_new_share: always holds"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"or_former_times\":0"),
       "requirements[0].or_former_times: always holds"},
      {with("\"at_least_hours\":2", "\"at_least_hours\":2,\"least_run_minutes\":720"),
       "requirements[0].least_run_minutes: never holds: the window has 8 h"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2",
            "\"any\":[{\"at_least_hours\":2},{\"statistic\":\"shadow\",\"at_most_hours\":8}]"),
       "requirements[0].any[1].at_most_hours: always holds"},
      {with("\"from\":\"08:00\",\"to\":\"16:00\"", "\"after_sunrise_minutes\":720,\"before_sunset_minutes\":720"),
       "requirements[0].window: the window is empty"},
      // The same twice.
      {with("{\"dates\":[\"03-21\"]}", R"({"dates":["03-21","12-21","03-21"]})"),
       "requirements[0].days.dates: '03-21' is there twice"},
      {with("{\"dates\":[\"03-21\"]}", R"({"solar_longitudes":[270,270]})"),
       "requirements[0].days.solar_longitudes: 270 is there twice"},
      {with("\"requirements\":[{", R"("requirements":[{"name":"2 h","days":{"given":true},"at_least_hours":1},{)"),
       "requirements[1].name: another requirement has it, too"},
      // A share of new shadow has no measure of its own.
      {with("\"at_least_hours\":2", "\"at_most_new_share\":0.1"), "requirements[0].statistic: at_most_new_share is of"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"at_most_new_share\":0.1,\"least_run_minutes\":5"),
       "requirements[0].least_run_minutes: at_most_new_share stands alone"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"at_most_new_share\":0.1,\"any\":[]"),
       "any: at_most_new_share"},
      {with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"at_most_new_share\":0.1,\"at_most_hours\":1"),
       "requirements[0].at_most_hours: at_most_new_share stands alone"},
      {with("\"statistic\":\"sun\",", "\"any\":[{\"at_least_hours\":3}],"), "at_least_hours: each of any has"},
      {with("\"source\":\"its plan\"", "\"source\":\"its plan\",\"least_sun_altitude_by_country\":{}"),
       "least_sun_altitude_by_country: is empty"},
  };
  for (const auto& [text, says] : wrong) {
    const auto rule = parseRule(text, "mine.json");
    ASSERT_FALSE(rule) << says;
    EXPECT_EQ(rule.error().code, ErrorCode::input);
    EXPECT_EQ(rule.error().where, "mine.json");
    EXPECT_THAT(rule.error().message, HasSubstr(says));
  }
}

TEST(RuleFile, whatMayBeLeftOut) {
  // Whole numbers as other programs write them, the day of the command, and alternatives with days of their own.
  const auto range = parseRule(with("{\"dates\":[\"03-21\"]}", R"({"from":"02-01","to":"03-21","every":7.0})"), "a");
  ASSERT_TRUE(range) << range.error().text();
  EXPECT_EQ(range->requirements[0].anyOf[0].days.every, 7);
  const auto given = parseRule(with("{\"dates\":[\"03-21\"]}", "{\"given\":true}"), "a");
  ASSERT_TRUE(given) << given.error().text();
  EXPECT_EQ(given->requirements[0].anyOf[0].days.kind, Days::Kind::given);
  const auto own =
      parseRule(with("\"days\":{\"dates\":[\"03-21\"]},\"window\":{\"clock\":\"solar\",\"from\":\"08:00\",\"to\":"
                     "\"16:00\"},\n                   \"statistic\":\"sun\",\"at_least_hours\":2",
                     R"("any":[{"days":{"given":true},"at_least_hours":2}])"),
                "a");
  ASSERT_TRUE(own) << own.error().text();
  const auto share = parseRule(
      with("\"statistic\":\"sun\",\"at_least_hours\":2", "\"statistic\":\"new_shadow\",\"at_most_new_share\":0.1"),
      "a");
  ASSERT_TRUE(share) << share.error().text();
  EXPECT_TRUE(needsBaseline(*share));
}

// As much as can be asked for without its holding always or never.
TEST(RuleFile, borderlinesOfSense) {
  const std::string sun = "\"statistic\":\"sun\",\"at_least_hours\":2";
  for (const char* measure :
       {R"("statistic":"sun","at_least_hours":8)", R"("statistic":"shadow","less_than_hours":8)",
        R"("statistic":"shadow","at_most_hours":7.99)", R"("statistic":"shadow","at_most_hours":0)",
        R"("at_least_hours":2,"least_run_minutes":480)", R"("at_least_hours":2,"or_former_times":0.01)",
        R"("at_most_new_share":0.999)"}) {
    const auto rule = parseRule(with(sun, measure), "a");
    EXPECT_TRUE(rule) << measure << ": " << (rule ? "" : rule.error().text());
  }
  EXPECT_TRUE(parseRule(
      with("\"from\":\"08:00\",\"to\":\"16:00\"", "\"after_sunrise_minutes\":720,\"before_sunset_minutes\":719"), "a"));
}

TEST(RuleFile, textsAreReadInTheirOrder) {
  const auto rule = parseRule(
      with("\"name\":\"mine\"", R"("name":"mine","checked":["the act","the city's page"],"uncertain":["the clock"])"),
      "");
  ASSERT_TRUE(rule) << rule.error().text();
  EXPECT_THAT(rule->checked, testing::ElementsAre("the act", "the city's page"));
  EXPECT_THAT(rule->uncertain, testing::ElementsAre("the clock"));
  const auto without = parseRule(kGood, "");
  EXPECT_TRUE(without && without->checked.empty());
}

TEST(RuleFile, alternativesShareWhatIsCommon) {
  const auto rule = findRule("korea");
  ASSERT_TRUE(rule);
  ASSERT_EQ(rule->requirements.at(0).anyOf.size(), 2u);
  for (const Measure& m : rule->requirements[0].anyOf) EXPECT_EQ(m.days.longitudes.at(0), Angle::degrees(270));
  EXPECT_EQ(rule->requirements[0].anyOf[1].statistic, Statistic::longestSun);
}

TEST(Presets, eachNamesItsSourceTheTextsItWasHeldAgainstAndWhatIsUncertain) {
  EXPECT_GE(presets().size(), 30u);
  for (const Rule& rule : presets()) {
    EXPECT_FALSE(rule.source.empty()) << rule.name;
    EXPECT_FALSE(rule.uncertain.empty()) << rule.name;
    EXPECT_FALSE(rule.checked.empty()) << rule.name;
    for (const std::string& text : rule.checked)
      EXPECT_THAT(text, testing::MatchesRegex(".+ [(].+, https?://[^ ]+, seen 20[0-9][0-9]-[01][0-9][)]: .+[.]"))
          << rule.name;
    EXPECT_FALSE(rule.where.empty()) << rule.name;
    EXPECT_TRUE(presetText(rule.name)) << rule.name;
  }
}

TEST(Presets, unknownNamesAreAnsweredWithNearOnes) {
  const auto rule = findRule("japan-9");
  ASSERT_FALSE(rule);
  EXPECT_EQ(rule.error().code, ErrorCode::usage);
  EXPECT_THAT(rule.error().message, HasSubstr("japan-4-2.5"));
  EXPECT_THAT(findRule("nowhere").error().message, HasSubstr("nyc-ceqr"));
  EXPECT_EQ(findRule("no-such-file.json").error().code, ErrorCode::input);
  EXPECT_THAT(withCountry(*findRule("en17037-high"), "XX").error().message, HasSubstr("DE"));
  EXPECT_FALSE(withCountry(*findRule("korea"), "KR"));
}

TEST(Presets, aPrintedPresetIsARuleFile) {
  const auto path = std::filesystem::temp_directory_path() / "umbrage_rule_file_test.json";
  std::ofstream(path) << *presetText("bre209");
  const auto rule = findRule(path.string());
  std::filesystem::remove(path);
  ASSERT_TRUE(rule);
  EXPECT_EQ(rule->name, "bre209");
  EXPECT_EQ(rule->requirements.at(0).former, 0.8);
}

}  // namespace
}  // namespace umbrage::rules
