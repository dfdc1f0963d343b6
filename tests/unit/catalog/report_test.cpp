// SPDX-License-Identifier: GPL-3.0-or-later
// What people and build servers read of a run.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "catalog_scratch.hpp"

using ::testing::HasSubstr;
using ::testing::Not;
using namespace vitrine;
namespace fs = std::filesystem;

class Report : public CatalogScratch {
 protected:
  static ItemOutcome convert(const CatalogItem& item, const std::string& dir) {
    if (item.sku == "bad") {
      const nlohmann::json why{{"code", "LOW<CONTRAST"},
                               {"message", "<script>alert('\"&')</script>\x01"},
                               {"remedy", "</article>\" onload=\"alert(1)"}};
      return {65, why.dump()};
    }
    if (item.sku == "lost") std::abort();
    std::ofstream(fs::path(dir) / "thumb.jpg", std::ios::binary) << "Man";
    return {0, "{}", false, R"({"sewing":12.5})"};
  }
  void SetUp() override {
    CatalogScratch::SetUp();
    list = items({"good", "bad", "lost"});
    list[0].title = "Vest <b>\"one\"</b> & 'two'";
    list[2].garment = "sk<irt";
    run(list, convert);
  }
  std::string file(const char* name) const { return read(root / "out" / name); }
  std::vector<CatalogItem> list;
};

TEST_F(Report, text_of_the_shop_is_text_and_never_markup) {
  for (const char* name : {"report.html", "junit.xml"}) {
    const std::string text = file(name);
    EXPECT_THAT(text, HasSubstr("&lt;script&gt;alert(&#39;&quot;&amp;&#39;)&lt;/script&gt;\xEF\xBF\xBD")) << name;
    EXPECT_THAT(text, HasSubstr("LOW&lt;CONTRAST")) << name;
    EXPECT_THAT(text, HasSubstr("sk&lt;irt")) << name;
    for (const char* raw : {"<script>alert", "<b>\"one", "onload=\"", "sk<irt", "\x01"})
      EXPECT_THAT(text, Not(HasSubstr(raw))) << name;
  }
  EXPECT_THAT(file("report.html"), HasSubstr("Vest &lt;b&gt;&quot;one&quot;&lt;/b&gt; &amp; &#39;two&#39;"));
}

TEST_F(Report, the_page_carries_its_thumbnails_and_asks_nobody_for_anything) {
  const std::string page = file("report.html");
  EXPECT_THAT(page, HasSubstr("src=\"data:image/jpeg;base64,TWFu\""));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* outside : {"http://", "https://", "src=\"//"}) EXPECT_THAT(page, Not(HasSubstr(outside)));
  EXPECT_LT(page.find("data-status=\"refused\""), page.find("data-status=\"ok\""))
      << "what wants looking at comes first";
  EXPECT_THAT(page, HasSubstr("href=\"quarantine/bad/\""));
  EXPECT_THAT(page, HasSubstr("href=\"good/\""));
}

TEST_F(Report, the_summary_counts_by_status_garment_and_reason) {
  const auto summary = nlohmann::json::parse(file("summary.json"));
  EXPECT_EQ(summary.at("total"), 3);
  EXPECT_EQ(summary.at("ok"), 1);
  EXPECT_EQ(summary.at("by_garment").at("vest").at("ok_share"), 0.5);
  EXPECT_EQ(summary.at("by_garment").at("sk<irt").at("crashed"), 1);
  EXPECT_EQ(summary.at("by_code").at("CRASHED"), 1);
  EXPECT_THAT(file("junit.xml"),
              HasSubstr("<testsuite name=\"vest\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\">"));
  EXPECT_THAT(file("junit.xml"), HasSubstr("tests=\"1\" failures=\"0\" errors=\"1\" skipped=\"0\">"));
}

TEST_F(Report, times_stand_in_a_file_of_their_own) {
  EXPECT_THAT(file("timings.jsonl"), HasSubstr("\"stage_ms\":{\"sewing\":12.5}"));
  for (const char* name : {"report.jsonl", "summary.json", "report.html", "junit.xml"})
    for (const char* time : {"_ms", "12.5", "wall"}) EXPECT_THAT(file(name), Not(HasSubstr(time))) << name;
}
