#include "umbrage/report/html.hpp"

#include <gmock/gmock.h>

#include "umbrage/report/gallery.hpp"

namespace umbrage::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Escaped, KeepsWhatMeansNothingToHtml) {
  EXPECT_EQ(escaped(""), "");
  EXPECT_EQ(escaped("Plain text, 12 m²\n\tand more"), "Plain text, 12 m²\n\tand more");
}

TEST(Escaped, MarksBecomeEntities) {
  EXPECT_EQ(escaped("<b a=\"x\" b='y'>&"), "&lt;b a=&quot;x&quot; b=&#39;y&#39;&gt;&amp;");
}

TEST(Escaped, WhatIsNoTextCannotBreakThePage) {
  EXPECT_EQ(escaped(std::string_view("a\0b\x1b", 4)), "a?b?");
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped("\xff"), unknown);
  EXPECT_EQ(escaped("a\xc3"), "a" + unknown) << "a letter that is cut off";
  EXPECT_EQ(escaped("\xc0\xaf"), unknown + unknown) << "a longer form of '/'";
  EXPECT_EQ(escaped("\xed\xa0\x80"), unknown + unknown + unknown) << "half of a pair";
  EXPECT_EQ(escaped("\xf4\x90\x80\x80"), unknown + unknown + unknown + unknown) << "beyond Unicode";
  EXPECT_EQ(escaped("\xf0\x9f\x8c\x9e"), "\xf0\x9f\x8c\x9e");
}

TEST(PageText, IsOnePageByItself) {
  const auto text =
      pageText({.title = "A <title>", .kind = "umbrage test", .style = "p{}", .script = "1;", .body = "<p>Body</p>\n"});
  EXPECT_THAT(text, testing::StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(text, HasSubstr("<title>A &lt;title&gt;</title>"));
  EXPECT_THAT(text, HasSubstr("content=\"umbrage test\""));
  EXPECT_THAT(text, HasSubstr("<p>Body</p>"));
  EXPECT_THAT(text, Not(HasSubstr("http"))) << "nothing is fetched from anywhere";
}

Gallery twoTechniques() {
  Gallery gallery{.title = "Shadows of a <box>",
                  .facts = {{"scene", "12 triangles"}},
                  .command = "umbrage gallery box.off -o out",
                  .entries = {}};
  gallery.entries.push_back(
      {.name = "truth", .summary = "By rays", .picture = "truth.png", .mask = "truth-mask.png", .frameMs = 10.0});
  gallery.entries.push_back({.name = "other",
                             .summary = "Otherwise",
                             .picture = "other.png",
                             .mask = "other-mask.png",
                             .difference = "other-difference.png",
                             .error = GalleryError{.truth = "truth", .differing = 7, .covered = 1000, .rms = 0.0837},
                             .frameMs = 25.0});
  gallery.entries.push_back({.name = "absent", .summary = "Elsewhere", .obstacle = "no <graphics>"});
  return gallery;
}

TEST(GalleryPage, TellsErrorsAndCosts) {
  const auto page = galleryPage(twoTechniques());
  EXPECT_THAT(page, HasSubstr("<title>Shadows of a &lt;box&gt;</title>"));
  EXPECT_THAT(
      page,
      HasSubstr("7 of 1000 pixels differ from truth (0.70 %), RMS error 0.0837; none of them away from an edge."));
  EXPECT_THAT(page, HasSubstr("data-value=\"2.5\">2.50<")) << "the frame as a ratio to the truth's";
  EXPECT_THAT(page, HasSubstr("What it shows is taken as the truth."));
  EXPECT_THAT(page, HasSubstr("Not shown: no &lt;graphics&gt;"));
}

TEST(GalleryPage, PixelsAwayFromEdgesAreCalledWrong) {
  auto gallery = twoTechniques();
  gallery.entries[1].error->astray = 3;
  EXPECT_THAT(galleryPage(gallery), HasSubstr("<p class=\"bad\">7 of 1000 pixels differ"));
  gallery.entries[1].error = GalleryError{.truth = "truth", .covered = 1000};
  EXPECT_THAT(galleryPage(gallery), HasSubstr("Every pixel equals truth."));
}

TEST(GalleryPage, OnlyWhatHasPicturesShowsThem) {
  const auto page = galleryPage(twoTechniques());
  EXPECT_THAT(page, Not(HasSubstr("data-name=\"absent\"")));
  EXPECT_THAT(page, Not(HasSubstr("src=\"\"")));
}

TEST(GalleryPage, OfNothingIsAPageToo) { EXPECT_THAT(galleryPage({}), HasSubstr("</html>")); }

}  // namespace
}  // namespace umbrage::report
