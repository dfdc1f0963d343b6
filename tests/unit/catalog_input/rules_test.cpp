// SPDX-License-Identifier: GPL-3.0-or-later
#include <tuple>

#include "inputs.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Rules : public Inputs {
 protected:
  vitrine::InputOptions rules(const std::string& text) const {
    vitrine::InputOptions options;
    options.rules = write("rules.json", text);
    return options;
  }
  /// Front and back of a product with these pictures, by the rules that chose them: "front rule/back rule".
  std::string chosen(const std::string& rows, const std::string& title = "Loom top") const {
    const auto input = get(write("s.csv",
                                 "Handle,Title,Type,Image Src,Image Position,Image Alt Text\n"
                                 "x," +
                                     title + ",Vests,,,\n" + rows));
    if (input.plan.empty()) return "";
    const auto name = [&](const char* role) {
      for (const auto& p : input.plan[0].pictures)
        if (p.role == role) return p.source + "(" + p.rule + ")";
      return std::string("none");
    };
    return name("front") + " " + name("back");
  }
};

TEST_F(Rules, alt_texts_come_before_file_names_and_those_before_positions) {
  EXPECT_EQ(chosen("x,,,a_back.jpg,1,Loom top - front\nx,,,m.jpg,2,\nx,,,c.jpg,3,\"Loom top, back view\"\n"),
            "a_back.jpg(alt-front) c.jpg(alt-back)");
  EXPECT_EQ(chosen("x,,,b_back.jpg,1,\nx,,,a-front.jpg,2,\n"), "a-front.jpg(file-front) b_back.jpg(file-back)");
  EXPECT_EQ(chosen("x,,,p.jpg,1,\nx,,,q.jpg,2,\nx,,,r.jpg,3,\n"), "p.jpg(position-1) q.jpg(position-2)");
  EXPECT_EQ(chosen("x,,,q.jpg,2,\nx,,,p.jpg,1,\n"), "p.jpg(position-1) q.jpg(position-2)")
      << "whatever the rows' order";
}

TEST_F(Rules, file_names_are_understood_as_shops_write_them) {
  for (const auto& [front, back] : {std::pair{"77120_F.jpg", "77120_B.jpg"},
                                    {"loomTopFront.png", "loomTopBack.png"},
                                    {"LOOM-FRONT-2.jpg", "LOOM-BACK-2.jpg"},
                                    {"loom_front_1024x1024.jpg", "loom_back_grande.jpg"},
                                    {"loom-01.jpg", "loom-02.jpg"},
                                    {"loom_front-scaled.jpg", "loom_back-e1700000000.jpg"},
                                    {"kleid-vorne.jpg", "kleid-rueckseite.jpg"},
                                    {"robe-devant.jpg", "robe-dos.jpg"}}) {
    const std::string said =
        chosen(std::string("x,,,m.jpg,1,\nx,,,") + back + ",2,\nx,,,k.jpg,3,\nx,,," + front + ",4,\n");
    EXPECT_EQ(said.rfind(front, 0), 0u) << said;
    EXPECT_THAT(said, HasSubstr(std::string(" ") + back)) << said;
  }
}

TEST_F(Rules, words_of_the_garments_own_name_say_nothing_about_its_pictures) {
  EXPECT_EQ(chosen("x,,,a.jpg,1,Open back top\nx,,,m.jpg,2,\"Open back top, back\"\n", "Open back top"),
            "a.jpg(position-1) m.jpg(alt-back)");
  EXPECT_EQ(chosen("x,,,a.jpg,1,Vest with front zip\nx,,,m.jpg,2,Vest with zip\n"),
            "a.jpg(position-1) m.jpg(position-2)");
}

TEST_F(Rules, details_and_worn_pictures_are_neither_front_nor_back) {
  EXPECT_EQ(chosen("x,,,a-detail.jpg,1,\nx,,,b-worn.jpg,2,\nx,,,c_front.jpg,3,\nx,,,d_back.jpg,4,\n"),
            "c_front.jpg(file-front) d_back.jpg(file-back)");
  EXPECT_EQ(chosen("x,,,a.jpg,1,\nx,,,size-chart.jpg,2,\n"), "a.jpg(position-1) none");
}

TEST_F(Rules, a_position_does_not_complete_a_front_that_has_a_name) {
  EXPECT_EQ(chosen("x,,,a_front.jpg,1,\nx,,,m.jpg,2,\n"), "a_front.jpg(file-front) none");
  EXPECT_EQ(chosen("x,,,a.jpg,1,\nx,,,b_back.jpg,2,\n"), "a.jpg(position-1) b_back.jpg(file-back)");
  EXPECT_EQ(chosen("x,,,a-1.jpg,1,\nx,,,m.jpg,2,\n"), "a-1.jpg(position-1) m.jpg(position-2)")
      << "half a pair of numbers";
}

TEST_F(Rules, a_rules_file_replaces_the_keys_it_has) {
  const auto options = rules(R"({"pictures": [[{"name": "plan A", "position": 3, "is": "front"}]],
    "garments": [{"name": "all", "match": ".", "garment": "skirt"}],
    "no_back": "mirror", "mannequins": "sizes"})");
  const auto input = get(write("s.csv",
                               "Handle,Title,Option1 Name,Option1 Value,Image Src,Image Position\n"
                               "a,Thing,Size,m,u.jpg,1\na,,,XL,v.jpg,3\na,,,46,,\n"),
                         options);
  ASSERT_EQ(input.items.size(), 1u);
  EXPECT_EQ(input.items[0].front, "v.jpg");
  EXPECT_TRUE(input.items[0].mirror_back);
  EXPECT_EQ(input.items[0].garment, "skirt");
  EXPECT_THAT(input.items[0].mannequins, ElementsAre("M", "XL"));
  EXPECT_EQ(input.plan[0].front_rule, "plan A");
  EXPECT_EQ(input.plan[0].garment_rule, "all in title");
}

TEST_F(Rules, each_garment_is_found_in_the_words_that_shops_use_for_it) {
  // {type, title, garment}; empty: left out.
  const std::tuple<const char*, const char*, const char*> products[] = {
      {"Dresses", "Olive dress", "dress"},
      {"Dresses", "Olive dress, short sleeves", "dress_short_sleeve"},
      {"Dresses", "Long-sleeved olive dress", "dress_long_sleeve"},
      {"", "T-shirt dress in navy", "dress_short_sleeve"},
      {"", "Linen sundress", "dress"},
      {"", "Dress with a pleated skirt", "dress"},
      {"", "Dress pants, charcoal", "trousers"},
      {"", "Dress shirt, white", ""},
      {"", "Dress shoes", ""},
      {"", "Address book", ""},
      {"T-shirts", "Heavy tee", "t_shirt"},
      {"T-shirts", "Heavy tee, long sleeves", "long_sleeve"},
      {"T-shirts", "Ribbed tank top", "vest"},
      {"Tops & T-shirts", "Ribbed tank", "vest"},
      {"", "Short sleeve top", "t_shirt"},
      {"Sweaters", "Short-sleeved sweater", "t_shirt"},
      {"Sweaters", "Sweater vest", "vest"},
      {"Sweaters", "Fog", "long_sleeve"},
      {"", "Long sleeve top", "long_sleeve"},
      {"Jeans", "Straight leg", "trousers"},
      {"", "Wide-leg pants", "trousers"},
      {"", "Denim shorts", "shorts"},
      {"Bottoms", "Bermuda shorts, short sleeve not included", "shorts"},
      {"", "Jean jacket", ""},
      {"", "Denim skirt", "skirt"},
      {"", "Hooded jumpsuit", ""},
      {"", "Mug", ""},
  };
  for (const auto& [type, title, garment] : products) {
    const auto input = get(write("s.csv", std::string("Handle,Title,Type,Image Src\nx,\"") + title + "\",\"" + type +
                                              "\",x_front.jpg\nx,,,x_back.jpg\n"));
    EXPECT_EQ(input.items.empty() ? "" : input.items[0].garment, garment) << type << ": " << title;
  }
}

TEST_F(Rules, google_categories_by_number_are_garments) {
  for (const auto& [category, garment] :
       {std::pair{"2271", "dress"}, {"1581", "skirt"}, {"204", "trousers"}, {"207", "shorts"}}) {
    const auto input = get(write("g.tsv", std::string("id\ttitle\timage_link\tadditional_image_link\t"
                                                      "google_product_category\n1\tOlive\ta_front.jpg\ta_back.jpg\t") +
                                              category + "\n"));
    ASSERT_EQ(input.items.size(), 1u) << category;
    EXPECT_EQ(input.items[0].garment, garment);
  }
}

TEST_F(Rules, a_boat_neck_and_a_fabric_are_read_for_the_garments_that_have_them) {
  const auto input = get(write("s.csv",
                               "Handle,Title,Type,Image Src\na,Bateau neck dress in tweed,Dresses,a_front.jpg\n"
                               "a,,,a_back.jpg\nb,\"Slim jeans, boat neck bag\",Jeans,b_front.jpg\nb,,,b_back.jpg\n"));
  EXPECT_EQ(item(input, "a").neckline, "neck_boat");
  EXPECT_EQ(item(input, "a").fabric, "wool_twill");
  EXPECT_EQ(item(input, "b").fabric, "denim");
  EXPECT_EQ(item(input, "b").neckline, vitrine::CatalogItem{}.neckline) << "trousers have no neckline";
}

TEST_F(Rules, a_garment_may_want_a_word_in_any_of_the_texts) {
  const auto options = rules(R"({"garments": [
    {"name": "knee", "match": "gown", "with": "knee", "garment": "dress"},
    {"name": "long", "match": "gown", "garment": ""}]})");
  const std::string feed = write("s.csv",
                                 "Handle,Title,Type,Image Src\na,Knee length,Gowns,a_front.jpg\na,,,a_back.jpg\n"
                                 "b,To the floor,Gowns,b_front.jpg\nb,,,b_back.jpg\n");
  const auto input = get(feed, options);
  EXPECT_EQ(item(input, "a").garment, "dress");
  EXPECT_EQ(input.items.size(), 1u);
  EXPECT_THAT(input.left_out.at(0).reason, HasSubstr("by rule long"));
}

TEST_F(Rules, products_without_a_garment_are_refused_or_given_one_as_the_rules_say) {
  const std::string feed = write("s.csv", "Handle,Title,Image Src\na,Thing,a_front.jpg\na,,a_back.jpg\n");
  EXPECT_EQ(get(feed).left_out.size(), 1u);
  EXPECT_EQ(code(get(feed, rules("{\"no_garment\": \"refuse\"}")).items.at(0)), "NO_GARMENT");
  EXPECT_EQ(get(feed, rules("{\"default_garment\": \"vest\"}")).items.at(0).garment, "vest");
}

TEST_F(Rules, columns_in_another_language_are_named_once) {
  const auto input = get(write("w.csv",
                               "ID;Typ;Artikelnummer;Name;Kategorien;Bilder;Breite\n"
                               "7;simple;K-7;Rock;Skirts;https://x/k_vorne.jpg, https://x/k_hinten.jpg;352\n"),
                         rules(R"({"columns": {"Typ": "Type", "Artikelnummer": "SKU", "Kategorien": "Categories",
                                               "Bilder": "Images"},
                                   "measures": [{"is": "chest_cm", "column": "Breite", "unit": "mm"}]})"));
  EXPECT_EQ(input.kind, vitrine::InputKind::woocommerce);
  EXPECT_TRUE(ends(item(input, "K-7").back, "k_hinten.jpg"));
  EXPECT_DOUBLE_EQ(*item(input, "K-7").chest_cm, 35.2);
}

TEST_F(Rules, a_measure_out_of_range_is_passed_over_and_noted) {
  const auto input = get(write("s.csv",
                               "Handle,Title,Type,Body (HTML),Image Src\na,A,Vests,Pit to pit: 460 cm,a_f.jpg\n"
                               "a,,,,a_b.jpg\n"));
  EXPECT_FALSE(input.items.at(0).chest_cm.has_value());
  EXPECT_THAT(input.plan.at(0).notes.at(0), HasSubstr("460"));
}

TEST_F(Rules, a_mistake_in_the_rules_names_its_key_and_the_way_out) {
  const std::string feed = shop("shopify.csv");
  for (const auto& [text, where] :
       {std::pair<const char*, const char*>{"{\"picture\": []}", "\"picture\""},
        {"{\"pictures\": [{}]}", "\"pictures\""},
        {"{\"pictures\": [[{\"file\": \"(\", \"is\": \"front\"}]]}", "regular expression"},
        {"{\"pictures\": [[{\"file\": \"a\", \"is\": \"left\"}]]}", "left"},
        {"{\"pictures\": [[{\"position\": 0, \"is\": \"front\"}]]}", "position"},
        {"{\"garments\": [{\"match\": \"a\"}]}", "\"garments\""},
        {"{\"garments\": [{\"match\": \"a\", \"with\": \"(\", \"garment\": \"\"}]}", "regular expression"},
        {"{\"fabrics\": [{\"match\": \"a\", \"with\": \"b\", \"fabric\": \"c\"}]}", "with"},
        {"{\"measures\": [{\"is\": \"hip_cm\", \"match\": \"(a)\"}]}", "\"measures\""},
        {"{\"measures\": [{\"is\": \"chest_cm\", \"match\": \"a\"}]}", "group"},
        {"{\"no_back\": \"maybe\"}", "\"no_back\""},
        {"{\"mannequins\": [\"a b\"]}", "\"mannequins\""},
        {"[]", "object"},
        {"{", "rules.json:1: column"}}) {
    const auto error = error_of(feed, rules(text));
    EXPECT_EQ(error.code, "RULES") << text;
    EXPECT_THAT(error.message, HasSubstr(where)) << text;
    EXPECT_THAT(error.message, HasSubstr("rules.json")) << text;
    EXPECT_FALSE(error.remedy.empty());
  }
}

TEST_F(Rules, the_printed_rules_are_the_built_in_ones) {
  const auto own = get(shop("shopify-legacy.csv"), rules(vitrine::default_rules()));
  EXPECT_EQ(plan_json(own), plan_json(get(shop("shopify-legacy.csv"))));
}

TEST_F(Rules, a_plan_says_what_was_decided_by_which_rule_and_what_is_missing) {
  const auto input = get(shop("shopify-legacy.csv"));
  const std::string table = plan_table(input), json = plan_json(input);
  EXPECT_THAT(table, HasSubstr("harbour-vest_front.jpg (alt-front)"));
  EXPECT_THAT(table, HasSubstr("vest (vest in type)"));
  EXPECT_THAT(table, HasSubstr("NO_BACK"));
  EXPECT_THAT(table, HasSubstr("2 to convert, 1 refused, 2 left out"));
  EXPECT_THAT(json, HasSubstr("\"rule\": \"file-other\""));
}
