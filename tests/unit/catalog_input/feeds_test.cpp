// SPDX-License-Identifier: GPL-3.0-or-later
#include "inputs.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using vitrine::Cause;
using vitrine::InputKind;

class Feeds : public Inputs {};

TEST_F(Feeds, each_kind_is_told_by_its_columns_or_its_first_character) {
  EXPECT_EQ(get(shop("manifest.csv")).kind, InputKind::manifest);
  EXPECT_EQ(get(shop("manifest.json")).kind, InputKind::manifest);
  EXPECT_EQ(get(shop("shopify.csv")).kind, InputKind::shopify);
  EXPECT_EQ(get(shop("shopify-legacy.csv")).kind, InputKind::shopify);
  EXPECT_EQ(get(shop("google.tsv")).kind, InputKind::google);
  EXPECT_EQ(get(shop("google.xml")).kind, InputKind::google);
  EXPECT_EQ(get(shop("google-atom.xml")).kind, InputKind::google);
  EXPECT_EQ(get(shop("woocommerce.csv")).kind, InputKind::woocommerce);
  picture("a_front.jpg");
  EXPECT_EQ(get(root.string()).kind, InputKind::folder);
}

TEST_F(Feeds, columns_of_no_known_kind_are_refused_with_the_ways_out) {
  const auto error = error_of(write("x.csv", "item,photo\n1,a.jpg\n"));
  EXPECT_EQ(error.code, "INPUT_KIND");
  EXPECT_THAT(error.message, HasSubstr("x.csv:1"));
  EXPECT_THAT(error.remedy, HasSubstr("--input-kind"));
}

TEST_F(Feeds, a_forced_kind_names_the_column_that_it_misses) {
  for (const auto& [kind, column] : {std::pair{InputKind::shopify, "Handle"},
                                     {InputKind::google, "id"},
                                     {InputKind::woocommerce, "Images"},
                                     {InputKind::manifest, "sku"}}) {
    vitrine::InputOptions options;
    options.kind = kind;
    const auto error = error_of(write("x.csv", "item,photo\n1,a.jpg\n"), options);
    EXPECT_EQ(error.code, "MANIFEST_COLUMN") << name_of(kind);
    EXPECT_THAT(error.message, HasSubstr(column));
  }
}

TEST_F(Feeds, shopify_rows_of_one_handle_are_one_garment_in_the_old_export) {
  const auto input = get(shop("shopify-legacy.csv"));
  ASSERT_EQ(input.items.size(), 3u);
  const auto& vest = item(input, "harbour-vest");
  EXPECT_EQ(vest.garment, "vest");
  EXPECT_EQ(vest.neckline, "neck_v") << "from the tags";
  EXPECT_EQ(vest.title, "Harbour Vest, ecru");
  EXPECT_TRUE(ends(vest.front, "harbour-vest_front.jpg?v=1699999999"));
  EXPECT_TRUE(ends(vest.back, "harbour-vest_back.jpg?v=1699999999"));
  EXPECT_DOUBLE_EQ(*vest.chest_cm, 46.5);
  EXPECT_DOUBLE_EQ(*vest.length_cm, 62);
  EXPECT_EQ(vest.line, 2);
  const auto why = plan(input, "harbour-vest");
  EXPECT_THAT(why.ids, ElementsAre("HV-ECR-S", "HV-ECR-M", "HV-ECR-L"));
  EXPECT_THAT(why.sizes, ElementsAre("S", "M", "L"));
  EXPECT_EQ(why.front_rule, "alt-front");
  EXPECT_EQ(why.pictures.at(2).role, "other") << "the worn one";
  const auto& skirt = item(input, "dune-skirt");
  EXPECT_EQ(skirt.fabric, "cotton_woven") << "linen";
  EXPECT_DOUBLE_EQ(*skirt.length_cm, 60);
  EXPECT_EQ(plan(input, "dune-skirt").back_rule, "file-number-2") << "under the tail that Shopify adds";
}

TEST_F(Feeds, shopify_reads_the_new_export_by_position_where_names_say_nothing) {
  const auto input = get(shop("shopify.csv"));
  const auto& vest = item(input, "harbour-vest");
  EXPECT_EQ(vest.garment, "vest") << "from the category";
  EXPECT_TRUE(ends(vest.front, "IMG_4410.jpg?v=1"));
  EXPECT_TRUE(ends(vest.back, "IMG_4411.jpg?v=1"));
  EXPECT_NEAR(*vest.chest_cm, 46.99, 1e-9) << "18.5 in";
  EXPECT_EQ(plan(input, "harbour-vest").front_rule, "position-1");
  EXPECT_EQ(plan(input, "harbour-vest").back_rule, "alt-back");
  EXPECT_TRUE(ends(item(input, "open-back-top").front, "open-back-top-1.jpg"))
      << "a garment called open back is not its own back";
}

TEST_F(Feeds, products_that_are_no_garment_or_archived_are_left_out_with_the_reason) {
  const auto input = get(shop("shopify-legacy.csv"));
  ASSERT_EQ(input.left_out.size(), 2u);
  EXPECT_EQ(input.left_out[0].id, "tide-mug");
  EXPECT_THAT(input.left_out[0].reason, HasSubstr("no rule"));
  EXPECT_EQ(input.left_out[1].id, "old-jumper");
  EXPECT_THAT(input.left_out[1].reason, HasSubstr("archived"));
}

TEST_F(Feeds, a_product_without_a_back_is_refused_alone_with_file_and_line) {
  const auto input = get(shop("shopify-legacy.csv"));
  const auto& jumper = item(input, "fog-jumper");
  ASSERT_TRUE(jumper.refusal);
  EXPECT_EQ(jumper.refusal->code, "NO_BACK");
  EXPECT_EQ(jumper.refusal->cause, Cause::unusable);
  EXPECT_THAT(jumper.refusal->message, HasSubstr("shopify-legacy.csv:10"));
  EXPECT_THAT(jumper.refusal->remedy, HasSubstr("mirror"));
  EXPECT_EQ(code(item(input, "harbour-vest")), "");
}

TEST_F(Feeds, google_sizes_of_one_group_and_colour_are_one_garment_with_all_their_ids) {
  const auto input = get(shop("google.tsv"));
  ASSERT_EQ(input.items.size(), 2u);
  const auto& top = item(input, "NB-100");
  EXPECT_EQ(top.garment, "long_sleeve");
  EXPECT_EQ(top.fabric, "jersey");
  EXPECT_EQ(top.title, "Birch long-sleeved top 12\" cuffs") << "a quote is a character in tab-separated text";
  EXPECT_DOUBLE_EQ(*top.length_cm, 64) << "640 mm";
  EXPECT_TRUE(ends(top.front, "/100/front.jpg"));
  EXPECT_TRUE(ends(top.back, "/100/back.jpg"));
  EXPECT_THAT(plan(input, "NB-100").ids, ElementsAre("NB-100-L", "NB-100-M", "NB-100-S"));
  EXPECT_EQ(plan(input, "NB-100").pictures.size(), 4u);
  EXPECT_EQ(item(input, "NB-200").fabric, "denim");
  EXPECT_THAT(input.left_out.at(0).id, "NB-300");
}

TEST_F(Feeds, google_colours_of_one_group_are_garments_of_their_own) {
  const auto input = get(write("g.tsv",
                               "id\ttitle\tcolor\timage_link\tadditional_image_link\titem_group_id\n"
                               "1\tVest\tRed\thttps://x/r_f.jpg\thttps://x/r_b.jpg\tG\n"
                               "2\tVest\tRed\thttps://x/r_f.jpg\thttps://x/r_b.jpg\tG\n"
                               "3\tVest\tSea Blue\thttps://x/s_f.jpg\thttps://x/s_b.jpg\tG\n"));
  ASSERT_EQ(input.items.size(), 2u);
  EXPECT_EQ(input.items[0].product_id, "G red");
  EXPECT_EQ(input.items[1].product_id, "G sea blue");
  EXPECT_TRUE(ends(input.items[1].back, "s_b.jpg"));
}

TEST_F(Feeds, an_id_that_appears_twice_is_refused_the_second_time) {
  const auto input = get(write("g.tsv",
                               "id\ttitle\timage_link\tadditional_image_link\n"
                               "1\tVest\thttps://x/a_f.jpg\thttps://x/a_b.jpg\n"
                               "1\tVest\thttps://x/a_f.jpg\thttps://x/a_b.jpg\n"));
  ASSERT_EQ(input.items.size(), 2u);
  EXPECT_EQ(code(input.items[0]), "");
  EXPECT_EQ(code(input.items[1]), "PRODUCT_ID");
  EXPECT_THAT(input.items[1].refusal->message, HasSubstr("line 2"));
  EXPECT_NE(input.items[0].sku, input.items[1].sku);
}

TEST_F(Feeds, google_xml_is_read_as_rss_and_as_atom) {
  const auto input = get(shop("google.xml"));
  ASSERT_EQ(input.items.size(), 2u);
  EXPECT_EQ(input.items[0].product_id, "MT 7/1");
  EXPECT_EQ(input.items[0].title, "Unterhemd „Lina“ & Freunde");
  EXPECT_EQ(input.items[0].fabric, "rib_knit");
  EXPECT_TRUE(ends(input.items[0].front, "lina_vorne.jpg"));
  EXPECT_TRUE(ends(input.items[0].back, "lina_hinten.jpg"));
  EXPECT_EQ(input.items[0].line, 6);
  EXPECT_EQ(code(input.items[1]), "NO_BACK");
  const auto atom = get(shop("google-atom.xml"));
  EXPECT_EQ(item(atom, "A-1").neckline, "neck_square");
  EXPECT_TRUE(ends(item(atom, "A-1").back, "a1_B.jpg"));
}

TEST_F(Feeds, xml_that_is_broken_nested_or_has_a_document_type_is_refused_with_its_place) {
  const std::string head = "<rss xmlns:g=\"http://base.google.com/ns/1.0\"><channel><item>\n";
  const auto refuses = [&](const std::string& text, const std::string& message) {
    const auto error = error_of(write("f.xml", text));
    EXPECT_EQ(error.code, "FEED_XML");
    EXPECT_EQ(error.cause, Cause::unusable);
    EXPECT_THAT(error.message, HasSubstr(message)) << text.substr(0, 80);
    EXPECT_THAT(error.message, HasSubstr("f.xml:"));
    EXPECT_FALSE(error.remedy.empty());
  };
  refuses(head + "<g:id>1</g:id>\n<g:title>a & b</g:title>", "f.xml:3: column");
  refuses(head + "<g:id>1</g:id>", "broken");
  refuses("<?xml version=\"1.0\"?>\n<!DOCTYPE rss [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]>" + head + "&b;",
          "document type");
  refuses("<!DOCTYPE rss SYSTEM \"file:///etc/passwd\"><rss/>", "document type");
  std::string deep = head;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  refuses(deep, "16 deep");
  refuses("<html><body/></html>", "no product feed");
  const auto unbound = error_of(write("f.xml", "<rss><channel><item><g:id>1</g:id></item></channel></rss>"));
  EXPECT_THAT(unbound.remedy, HasSubstr("xmlns:g"));
}

TEST_F(Feeds, woocommerce_variations_are_sizes_and_a_colour_with_both_sides_is_a_garment) {
  const auto input = get(shop("woocommerce.csv"));
  ASSERT_EQ(input.items.size(), 5u);
  EXPECT_THAT(plan(input, "LOOM-V").ids, ElementsAre("LOOM-V", "LOOM-V-S"));
  EXPECT_THAT(plan(input, "LOOM-V").sizes, ElementsAre("S", "M", "L"));
  EXPECT_TRUE(ends(item(input, "LOOM-V").back, "loom-vest-back-1024x1365.jpg"));
  EXPECT_EQ(item(input, "LOOM-V-MOSS").garment, "vest") << "filed like its parent";
  EXPECT_TRUE(ends(item(input, "LOOM-V-MOSS").front, "moss-front.jpg"));
  EXPECT_EQ(code(item(input, "ORPHAN")), "PRODUCT_ROW");
  EXPECT_THAT(item(input, "ORPHAN").refusal->message, HasSubstr("GONE"));
  EXPECT_EQ(code(item(input, "SHORT-ROW")), "PRODUCT_ROW");
  EXPECT_THAT(item(input, "SHORT-ROW").refusal->message, HasSubstr("woocommerce.csv:7"));
  EXPECT_EQ(input.items[2].product_id, "id 204") << "a product without a SKU is called by its number";
}

TEST_F(Feeds, a_folder_pairs_photos_by_name_and_takes_the_garment_from_folder_or_sku) {
  for (const char* name : {"vest-1_front.jpg", "vest-1_back.JPG", "skirts/dune_F.png", "skirts/dune_B.png",
                           "tanks/T9/front.webp", "tanks/T9/back.webp", "vest-1_front_mask.png", "holiday.jpg",
                           "vest-2-01.jpg", "vest-2-02.jpg", "notes_front.txt"})
    picture(name);
  const auto input = get(root.string());
  ASSERT_EQ(input.items.size(), 4u);
  const auto real = std::filesystem::canonical(root).string() + "/";
  EXPECT_EQ(item(input, "vest-1").garment, "vest");
  EXPECT_EQ(item(input, "vest-1").front, real + "vest-1_front.jpg");
  EXPECT_EQ(item(input, "vest-1").back, real + "vest-1_back.JPG");
  EXPECT_EQ(item(input, "vest-1").front_mask, real + "vest-1_front_mask.png");
  EXPECT_EQ(item(input, "dune").garment, "skirt");
  EXPECT_EQ(item(input, "dune").back, real + "skirts/dune_B.png");
  EXPECT_EQ(item(input, "T9").garment, "vest");
  EXPECT_EQ(item(input, "T9").front, real + "tanks/T9/front.webp");
  EXPECT_EQ(item(input, "vest-2").back, real + "vest-2-02.jpg");
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_THAT(input.warnings[0], HasSubstr("holiday.jpg"));
}

TEST_F(Feeds, rows_of_the_wrong_length_refuse_their_product_and_no_other) {
  const auto input = get(write("s.csv",
                               "Handle,Title,Type,Image Src\n"
                               "a,A,Vests,https://x/a_front.jpg\na,,,https://x/a_back.jpg\n"
                               "b,B,Vests,https://x/b_front.jpg,extra\nb,,,https://x/b_back.jpg\n"
                               ",C,Vests,https://x/c_front.jpg\n"));
  ASSERT_EQ(input.items.size(), 3u);
  EXPECT_EQ(code(input.items[0]), "");
  EXPECT_EQ(code(input.items[1]), "PRODUCT_ROW");
  EXPECT_THAT(input.items[1].refusal->message, HasSubstr("s.csv:4: column 5"));
  EXPECT_EQ(code(input.items[2]), "PRODUCT_ID");
}

TEST_F(Feeds, a_text_that_cannot_be_read_to_its_end_is_refused_as_a_whole) {
  const auto open = error_of(write("s.csv", "Handle,Title,Image Src\na,\"A,https://x/a.jpg\nb,B,https://x/b.jpg\n"));
  EXPECT_EQ(open.code, "FEED_CSV");
  EXPECT_THAT(open.message, HasSubstr("s.csv:2"));
  const auto latin = error_of(write("s.csv", "Handle,Title,Image Src\na,caf\xE9,https://x/a.jpg\n"));
  EXPECT_EQ(latin.code, "FEED_ENCODING");
  EXPECT_THAT(latin.message, HasSubstr("s.csv:2"));
  EXPECT_EQ(error_of(write("s.csv", "Handle,Title,Image Src\n")).code, "FEED_EMPTY");
  EXPECT_EQ(error_of((root / "none.csv").string()).cause, Cause::missing);
}

TEST_F(Feeds, more_than_a_million_rows_are_refused) {
  std::string text = "id\timage_link\n";
  for (int i = 0; i <= 1'000'000; ++i) text += std::to_string(i) + "\tf.jpg\n";
  const auto error = error_of(write("g.tsv", text));
  EXPECT_EQ(error.code, "FEED_TOO_LARGE");
  EXPECT_THAT(error.message, HasSubstr(":1000002"));
}

TEST_F(Feeds, a_million_pictures_of_one_product_are_looked_at_up_to_the_64th) {
  std::string text = "Handle,Type,Image Src\n";
  for (int i = 0; i < 5000; ++i) text += "a,Vests,https://x/" + std::to_string(i) + ".jpg\n";
  const auto input = get(write("s.csv", text));
  EXPECT_EQ(input.plan.at(0).pictures.size(), 64u);
  EXPECT_THAT(input.plan[0].notes.at(0), HasSubstr("64"));
}
