// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "scratch.hpp"
#include "vitrine/catalog.hpp"

using ::testing::HasSubstr;
using vitrine::CatalogItem;
using vitrine::Cause;
using vitrine::read_manifest;

class Manifest : public Scratch {
 protected:
  std::vector<CatalogItem> items(const std::string& text, std::vector<std::string>* warnings = nullptr) const {
    std::vector<std::string> own;
    const auto read = read_manifest(write("m.csv", text), warnings != nullptr ? warnings : &own);
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    return read ? *read : std::vector<CatalogItem>{};
  }
  void refuses(const std::string& text, const std::string& code, const std::string& where) const {
    std::vector<std::string> own;
    const auto read = read_manifest(write("m.csv", text), &own);
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, code) << read.error().message;
    EXPECT_EQ(read.error().cause, Cause::unusable);
    EXPECT_THAT(read.error().message, HasSubstr((root / "m.csv").string() + where));
    EXPECT_FALSE(read.error().remedy.empty());
  }
};

TEST_F(Manifest, reads_every_column_in_any_order) {
  const auto list = items(
      "title,length_cm,chest_cm,back_mask,front_mask,mirror_back,back,front,neckline,garment,sku,fabric,copyright\n"
      "A vest,62,46.5,b.png,f.png,no,b.jpg,f.jpg,neck_v,vest,v-1,jersey,2026 A shop\n");
  ASSERT_EQ(list.size(), 1u);
  const CatalogItem& v = list[0];
  EXPECT_EQ(v.sku, "v-1");
  EXPECT_EQ(v.garment, "vest");
  EXPECT_EQ(v.neckline, "neck_v");
  EXPECT_EQ(v.front, (root / "f.jpg").string());
  EXPECT_EQ(v.back, (root / "b.jpg").string());
  EXPECT_EQ(v.front_mask, (root / "f.png").string());
  EXPECT_EQ(v.back_mask, (root / "b.png").string());
  EXPECT_FALSE(v.mirror_back);
  EXPECT_DOUBLE_EQ(*v.chest_cm, 46.5);
  EXPECT_DOUBLE_EQ(*v.length_cm, 62);
  EXPECT_EQ(v.fabric, "jersey");
  EXPECT_EQ(v.title, "A vest");
  EXPECT_EQ(v.copyright, "2026 A shop");
  EXPECT_EQ(v.line, 2);
}

TEST_F(Manifest, empty_optional_fields_take_their_defaults) {
  const auto list = items("sku,garment,front,neckline,mirror_back,chest_cm,back\na,vest,f.jpg,,,,b.jpg\n");
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].neckline, "auto");
  EXPECT_FALSE(list[0].mirror_back);
  EXPECT_FALSE(list[0].chest_cm.has_value());
  EXPECT_TRUE(list[0].front_mask.empty());
}

TEST_F(Manifest, the_back_is_a_photo_or_the_mirrored_front_but_not_both) {
  const auto list =
      items("sku,garment,front,back,mirror_back\na,vest,f.jpg,,yes\nb,vest,f.jpg,b.jpg,\nc,vest,f.jpg,b.jpg,no\n");
  ASSERT_EQ(list.size(), 3u);
  EXPECT_TRUE(list[0].mirror_back && list[0].back.empty());
  for (const int i : {1, 2}) EXPECT_TRUE(!list[i].mirror_back && !list[i].back.empty()) << i;
  const std::string header = "sku,garment,front,back,mirror_back,back_mask\nx,vest,f.jpg,b.jpg,,\n";
  refuses(header + "a,vest,f.jpg,b.jpg,yes,\n", "MANIFEST_VALUE", ":3: column 5 \"mirror_back\"");
  for (const char* no : {"", "no", "false", "0"})
    refuses(header + "a,vest,f.jpg,," + no + ",\n", "MANIFEST_VALUE", ":3: column 4 \"back\"");
  refuses(header + "a,vest,f.jpg,,yes,m.png\n", "MANIFEST_VALUE", ":3: column 6 \"back_mask\"");
  refuses("sku,garment,front\na,vest,f.jpg\n", "MANIFEST_VALUE", ":2: column \"back\"");
}

TEST_F(Manifest, quotes_hold_commas_quotes_and_line_breaks) {
  const auto list =
      items("sku,garment,front,back,title\na,vest,f.jpg,b.jpg,\"one, \"\"two\"\"\nthree\"\nb,vest,g.jpg,b.jpg,\"\"\n");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].title, "one, \"two\"\nthree");
  EXPECT_EQ(list[1].title, "");
  EXPECT_EQ(list[1].line, 4) << "a line break in quotes counts as a line of the file";
}

TEST_F(Manifest, line_ends_and_byte_order_mark_make_no_difference) {
  const std::string plain = "sku,garment,front,back\na,vest,f.jpg,b.jpg\nb,skirt,g.jpg,b.jpg";
  for (const char* end : {"\n", "\r\n", "\r"})
    for (const char* mark : {"", "\xEF\xBB\xBF"})
      for (const char* last : {"", end}) {
        std::string text = mark;
        for (const char c : plain) text += c == '\n' ? std::string(end) : std::string(1, c);
        const auto list = items(text + last);
        ASSERT_EQ(list.size(), 2u);
        EXPECT_EQ(list[0].sku, "a");
        EXPECT_EQ(list[1].front, (root / "g.jpg").string());
        EXPECT_EQ(list[1].line, 3);
      }
}

TEST_F(Manifest, absolute_paths_stay_and_others_are_beside_the_manifest) {
  const auto list = items("sku,garment,front,back\na,vest,/photos/f.jpg,../b.jpg\n");
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].front, "/photos/f.jpg");
  EXPECT_EQ(list[0].back, (root.parent_path() / "b.jpg").string());
}

TEST_F(Manifest, unknown_columns_are_ignored_with_a_warning) {
  std::vector<std::string> warnings;
  const auto list = items("sku,colour,garment,front,back\na,red,vest,f.jpg,b.jpg\n", &warnings);
  ASSERT_EQ(list.size(), 1u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr(":1: column 2 \"colour\""));
}

TEST_F(Manifest, lines_without_content_are_skipped) {
  EXPECT_EQ(items("\nsku,garment,front,back\n\na,vest,f.jpg,b.jpg\n,,,\n\nb,vest,f.jpg,b.jpg\n\n").size(), 2u);
}

TEST_F(Manifest, each_mandatory_column_is_asked_for_by_name) {
  refuses("garment,front\nvest,f.jpg\n", "MANIFEST_COLUMN", ":1: column \"sku\"");
  refuses("sku,front\na,f.jpg\n", "MANIFEST_COLUMN", ":1: column \"garment\"");
  refuses("sku,garment\na,vest\n", "MANIFEST_COLUMN", ":1: column \"front\"");
  refuses("sku,sku,garment,front\na,a,vest,f.jpg\n", "MANIFEST_COLUMN", ":1: column 2 \"sku\"");
}

TEST_F(Manifest, semicolons_are_recognised_in_the_remedy) {
  const auto read = read_manifest(write("m.csv", "sku;garment;front\na;vest;f.jpg\n"));
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().remedy, HasSubstr("commas"));
}

TEST_F(Manifest, an_empty_mandatory_field_names_its_line_and_column) {
  refuses("sku,garment,front,back\na,vest,f.jpg,b.jpg\nb,,f.jpg,b.jpg\n", "MANIFEST_VALUE", ":3: column 2 \"garment\"");
  refuses("sku,garment,front\n,vest,f.jpg\n", "MANIFEST_VALUE", ":2: column 1 \"sku\"");
}

TEST_F(Manifest, a_repeated_sku_names_both_lines) {
  refuses("sku,garment,front,back\na,vest,f.jpg,b.jpg\nb,vest,f.jpg,b.jpg\na,vest,f.jpg,b.jpg\n", "SKU_DUPLICATE",
          ":4: column 1 \"sku\"");
  const auto read = read_manifest((root / "m.csv").string());
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("line 2"));
}

TEST_F(Manifest, a_sku_that_is_not_a_plain_folder_name_is_refused) {
  for (const std::string sku :
       {"../a", "..", ".", ".hidden", "-rf", "a/b", "/etc", "a b", "a\\b", "\xC3\xA4", "a:b", "a*"})
    refuses("sku,garment,front\n\"" + sku + "\",vest,f.jpg\n", "SKU_UNSAFE", ":2: column 1 \"sku\"");
  refuses("sku,garment,front\n" + std::string(101, 'a') + ",vest,f.jpg\n", "SKU_UNSAFE", ":2");
}

TEST_F(Manifest, numbers_and_answers_are_checked) {
  for (const char* text : {"abc", "\"46,5\"", "nan", "inf", "1e9", "-46", "46cm", "0"})
    refuses(std::string("sku,garment,front,chest_cm\na,vest,f.jpg,") + text + "\n", "MANIFEST_VALUE",
            ":2: column 4 \"chest_cm\"");
  refuses("sku,garment,front,mirror_back\na,vest,f.jpg,maybe\n", "MANIFEST_VALUE", ":2: column 4 \"mirror_back\"");
}

TEST_F(Manifest, broken_csv_names_the_line_on_which_it_breaks) {
  refuses("sku,garment,front\na,vest,\"f.jpg\nb,vest,g.jpg\n", "MANIFEST_CSV", ":2");
  refuses("sku,garment,front\na,vest,f\"x.jpg\n", "MANIFEST_CSV", ":2");
  refuses("sku,garment,front\na,vest,\"f\"x.jpg\n", "MANIFEST_CSV", ":2");
  refuses("sku,garment,front\na,vest\n", "MANIFEST_CSV", ":2: column 3");
  refuses("sku,garment,front\na,vest,f.jpg,more\n", "MANIFEST_CSV", ":2: column 4");
}

TEST_F(Manifest, text_that_is_not_utf8_is_refused) {
  refuses("sku,garment,front,title\na,vest,f.jpg,caf\xE9\n", "MANIFEST_ENCODING", "");
  refuses(std::string("sku,garment,front\na,vest,f\0.jpg\n", 31), "MANIFEST_ENCODING", "");
  refuses("\xFF\xFEs", "MANIFEST_ENCODING", "");
  EXPECT_EQ(items("sku,garment,front,back,title\na,vest,f.jpg,b.jpg,caf\xC3\xA9 \xE2\x82\xAC\n").size(), 1u);
}

TEST_F(Manifest, a_manifest_without_items_is_refused) {
  refuses("sku,garment,front\n", "MANIFEST_EMPTY", "");
  refuses("", "MANIFEST_EMPTY", "");
}

TEST_F(Manifest, a_missing_file_and_a_folder_are_told_apart_from_bad_content) {
  for (const std::string& path : {(root / "none.csv").string(), root.string()}) {
    const auto read = read_manifest(path);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().cause, Cause::missing);
    EXPECT_THAT(read.error().message, HasSubstr(path));
  }
}

TEST_F(Manifest, a_file_beyond_64_megabytes_is_refused_unread) {
  const std::string path = write("m.csv", "sku,garment,front\n");
  std::filesystem::resize_file(path, (64u << 20) + 1);
  const auto read = read_manifest(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, "MANIFEST_TOO_LARGE");
}

TEST_F(Manifest, more_than_a_million_rows_are_refused) {
  std::string text = "sku,garment,front,back\n";
  for (int i = 0; i <= 1'000'000; ++i) text += std::to_string(i) + ",vest,f.jpg,b.jpg\n";
  refuses(text, "MANIFEST_TOO_LARGE", ":1000002");
}
