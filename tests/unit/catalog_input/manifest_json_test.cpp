// SPDX-License-Identifier: GPL-3.0-or-later
#include "inputs.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ManifestJson : public Inputs {
 protected:
  void refuses(const std::string& text, const std::string& code, const std::string& where) {
    const auto error = error_of(write("m.json", text));
    EXPECT_EQ(error.code, code) << text << "\n" << error.message;
    EXPECT_THAT(error.message, HasSubstr((root / "m.json").string() + where));
    EXPECT_EQ(error.exit_code(), 65);
    EXPECT_FALSE(error.remedy.empty());
  }
};

TEST_F(ManifestJson, says_the_same_as_the_csv) {
  const auto json = get(shop("manifest.json")), csv = get(shop("manifest.csv"));
  ASSERT_EQ(json.items.size(), 2u);
  ASSERT_EQ(csv.items.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(json.items[i].sku, csv.items[i].sku);
    EXPECT_EQ(json.items[i].front, csv.items[i].front);
    EXPECT_EQ(json.items[i].back, csv.items[i].back);
    EXPECT_EQ(json.items[i].mirror_back, csv.items[i].mirror_back);
    EXPECT_EQ(json.items[i].chest_cm, csv.items[i].chest_cm);
  }
  EXPECT_THAT(json.items[0].mannequins, ElementsAre("S", "M", "L"));
  EXPECT_THAT(csv.items[0].mannequins, ElementsAre("XS", "S", "M", "L", "XL", "XXL"));
  EXPECT_THAT(csv.items[1].mannequins, ElementsAre("woman-m"));
  EXPECT_EQ(json.items[1].line, 4);
}

TEST_F(ManifestJson, a_mistake_names_line_item_and_key) {
  const std::string good = "{\"sku\":\"a\",\"garment\":\"vest\",\"front\":\"f\",\"back\":\"b\"}";
  refuses("[" + good + ",\n{\"sku\":\"b\",\"garment\":\"vest\",\"front\":\"f\",\"back\":\"b\",\"chest_cm\":1}]",
          "MANIFEST_VALUE", ":2: item 2: \"chest_cm\"");
  refuses("[" + good + ",\n\n" + good + "]", "SKU_DUPLICATE", ":3: item 2: \"sku\"");
  refuses("[{\"sku\":\"../a\",\"garment\":\"vest\",\"front\":\"f\",\"back\":\"b\"}]", "SKU_UNSAFE",
          ":1: item 1: \"sku\"");
  refuses("[{\"sku\":\"a\",\"garment\":\"vest\",\"front\":\"f\"}]", "MANIFEST_VALUE", ":1: item 1: \"back\"");
  refuses("[{\"sku\":\"a\",\"front\":\"f\"}]", "MANIFEST_COLUMN", ":1: item 1: \"garment\"");
  refuses("[{\"sku\":[1],\"garment\":\"vest\",\"front\":\"f\"}]", "MANIFEST_VALUE", ":1: item 1: \"sku\"");
  refuses("[{\"sku\":\"a\",\"garment\":\"vest\",\"front\":\"f\",\"x\":{}}]", "MANIFEST_JSON", ":1: item 1: \"x\"");
  refuses("[{\"sku\":\"a\",\"garment\":\"vest\",\"front\":\"f\",\"back\":\"b\",\"mannequin\":[\"S\",\"S\"]}]",
          "MANIFEST_VALUE", ":1: item 1: \"mannequin\"");
  refuses("[1]", "MANIFEST_JSON", ": item 1");
  refuses("{\"items\":3}", "MANIFEST_JSON", ":1");
  refuses("[]", "MANIFEST_EMPTY", "");
}

TEST_F(ManifestJson, broken_or_bottomless_text_names_line_and_column) {
  refuses("[{\"sku\": \"a\",\n \"garment\" \"vest\"}]", "MANIFEST_JSON", ":2: column ");
  refuses(std::string(1'000'000, '['), "MANIFEST_JSON", ":1: column 17");
  refuses("[{\"sku\": 1e999}]", "MANIFEST_JSON", "");
  refuses("[\"\xFF\"]", "MANIFEST_JSON", ":1");
}

TEST_F(ManifestJson, with_an_image_root_photos_outside_it_are_refused) {
  picture("in/f.jpg");
  picture("in/b.jpg");
  picture("out/b.jpg");
  std::filesystem::create_symlink(root / "out" / "b.jpg", root / "in" / "link.jpg");
  vitrine::InputOptions options;
  options.image_root = (root / "in").string();
  for (const auto& [back, good] : {std::pair<const char*, bool>{"in/b.jpg", true},
                                   {"in/../in/b.jpg", true},
                                   {"out/b.jpg", false},
                                   {"in/../out/b.jpg", false},
                                   {"in/link.jpg", false},
                                   {"/etc/passwd", false}}) {
    const std::string path = write("m.csv", std::string("sku,garment,front,back\na,vest,in/f.jpg,") + back + "\n");
    if (good)
      EXPECT_EQ(get(path, options).items.size(), 1u) << back;
    else
      EXPECT_EQ(error_of(path, options).code, "MANIFEST_VALUE") << back;
  }
}
