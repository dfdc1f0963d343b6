// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "items.hpp"
#include "model.hpp"
#include "pages.hpp"
#include "shop.hpp"

using namespace vitrine;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(ColourFamily, names_what_a_shopper_would) {
  using showroom::colour_family;
  EXPECT_STREQ(colour_family(15, 15, 18), "black");
  EXPECT_STREQ(colour_family(128, 128, 130), "grey");
  EXPECT_STREQ(colour_family(250, 250, 248), "white");
  EXPECT_STREQ(colour_family(222, 205, 175), "beige");
  EXPECT_STREQ(colour_family(95, 60, 40), "brown");
  EXPECT_STREQ(colour_family(190, 30, 35), "red");
  EXPECT_STREQ(colour_family(240, 140, 40), "orange");
  EXPECT_STREQ(colour_family(240, 210, 50), "yellow");
  EXPECT_STREQ(colour_family(60, 130, 70), "green");
  EXPECT_STREQ(colour_family(40, 60, 110), "blue");
  EXPECT_STREQ(colour_family(110, 50, 140), "purple");
  EXPECT_STREQ(colour_family(240, 150, 180), "pink");
}

TEST(ColourFamily, is_counted_on_the_cloth_that_the_model_shows) {
  Shop shop;
  shop.item("a", "A vest", {40, 60, 110});
  const auto colours = showroom::colour_families(shop.root / "out/a/garment.glb");
  ASSERT_TRUE(colours);
  EXPECT_THAT(*colours, ElementsAre("blue"));
  EXPECT_FALSE(showroom::colour_families(shop.root / "out/a/report.json"));
}

TEST(ShownText, keeps_letters_and_loses_what_turns_or_breaks_the_line) {
  using showroom::shown_text;
  EXPECT_EQ(shown_text("Vest, \"Rosa\" <b>", 100), "Vest, \"Rosa\" <b>");
  EXPECT_EQ(shown_text("a\r\n\tb\0c", 100), "a b");
  EXPECT_EQ(shown_text("\xE2\x80\xAEgpj.exe", 100), "gpj.exe");
  EXPECT_EQ(shown_text("\xD7\x97\xD7\x95\xD7\x9C\xD7\xA6\xD7\x94", 3), "\xD7\x97\xD7\x95\xD7\x9C\xE2\x80\xA6");
  EXPECT_EQ(shown_text("bad \xFF\xC0 end", 100), "bad \xEF\xBF\xBD\xEF\xBF\xBD end");
  EXPECT_EQ(shown_text(std::string(10'000, 'x'), 300).size(), 303u);
}

TEST(Page, fills_a_place_once_and_reads_no_place_from_a_value) {
  showroom::Page page("<p>{{a}}</p>{{b}}");
  EXPECT_EQ(*page.text("a", "{{b}} & <i>").html("b", "B").done(), "<p>{{b}} &amp; &lt;i&gt;</p>B");
  EXPECT_FALSE(showroom::Page("{{nobody}}").done());
}

TEST(Site, escapes_hostile_titles_wherever_they_stand) {
  Shop shop;
  const std::string evil = "</title></script><script>alert(1)</script>\"' onload=x {{data}} ../../etc";
  shop.item("evil", evil);
  ASSERT_TRUE(make_showroom(shop.options));
  for (const auto& [name, text] : shop.files()) {
    if (name.rfind("app/", 0) == 0) continue;
    EXPECT_THAT(text, Not(HasSubstr("<script>alert"))) << name;
    EXPECT_THAT(text, Not(HasSubstr("</script><script>"))) << name;
    EXPECT_THAT(text, Not(HasSubstr("\"' onload"))) << name;
  }
}

TEST(Site, refuses_a_report_whose_skus_are_no_folder_names) {
  for (const char* sku : {"../x", "", ".", "a/b", "<script>", "-rf"}) {
    Shop shop;
    shop.line({{"sku", sku}, {"garment", "vest"}, {"status", "ok"}});
    const auto made = make_showroom(shop.options);
    ASSERT_FALSE(made) << sku;
    EXPECT_EQ(made.error().code, "REPORT_LINE");
    EXPECT_FALSE(fs::exists(shop.root / "site"));
  }
}

TEST(Site, gives_the_same_bytes_twice) {
  Shop shop;
  shop.item("a", "A vest");
  shop.item("b", "Another", {40, 60, 110});
  ASSERT_TRUE(make_showroom(shop.options));
  const auto first = shop.files();
  ASSERT_TRUE(make_showroom(shop.options));
  EXPECT_EQ(first, shop.files());
  EXPECT_GT(first.size(), 20u);
}

TEST(Site, tells_the_mannequins_of_a_size_run_in_the_order_of_sizes) {
  Shop shop;
  for (const auto& [size, bust] :
       {std::pair("woman-l", 940.0), std::pair("woman-s", 840.0), std::pair("woman-m", 880.0)})
    shop.look(shop.root / "out/run" / size, 0.85, 1.45, {200, 30, 30}, bust);
  shop.line({{"sku", "run"}, {"garment", "vest"}, {"title", "Run"}, {"status", "ok"}});
  const auto made = make_showroom(shop.options);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->mannequins, 3);
  const std::string page = slurp(shop.root / "site/item/run/index.html");
  EXPECT_LT(page.find("<span>S</span>"), page.find("<span>M</span>"));
  EXPECT_LT(page.find("<span>M</span>"), page.find("<span>L</span>"));
  EXPECT_THAT(slurp(shop.root / "site/size.html"), HasSubstr("[172.0,94.0,75.0,68.0,94.0,81.5,57.5,36.5]"));
  EXPECT_THAT(page, HasSubstr("45 cm"));  // 900 px of half a millimetre
}

TEST(Site, knows_tops_from_bottoms_by_where_they_hang) {
  Shop shop;
  shop.item("top", "Top", {200, 30, 30}, 0.85, 1.45);
  shop.item("dress", "Dress", {200, 30, 30}, 0.4, 1.45);
  shop.item("skirt", "Skirt", {200, 30, 30}, 0.6, 1.05);
  const auto made = make_showroom(shop.options);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->outfit_tops, 1);
  EXPECT_EQ(made->outfit_bottoms, 1);
}

TEST(Site, leaves_the_old_one_alone_when_the_new_one_cannot_be_finished) {
  Shop shop;
  shop.item("a", "A vest");
  ASSERT_TRUE(make_showroom(shop.options));
  const auto first = shop.files();
  shop.item("b", "Broken");
  std::ofstream(shop.root / "out/b/preview.png") << "no picture";
  EXPECT_FALSE(make_showroom(shop.options));
  EXPECT_EQ(first, shop.files());
  EXPECT_FALSE(fs::exists(shop.root / ".site.partial"));
}

TEST(Site, touches_no_folder_that_is_not_its_own) {
  Shop shop;
  shop.item("a", "A vest");
  fs::create_directories(shop.root / "site");
  std::ofstream(shop.root / "site/diary.txt") << "mine";
  const auto made = make_showroom(shop.options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, "SITE_FOLDER");
  EXPECT_EQ(slurp(shop.root / "site/diary.txt"), "mine");
}

TEST(Site, says_which_items_it_leaves_out) {
  Shop shop;
  shop.item("a", "A vest");
  shop.line({{"sku", "gone"}, {"garment", "vest"}, {"status", "ok"}});
  shop.line({{"sku", "refused"}, {"garment", "vest"}, {"status", "refused"}});
  const auto made = make_showroom(shop.options);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->items, 1);
  EXPECT_THAT(made->warnings, ElementsAre(HasSubstr("gone: left out")));
}
