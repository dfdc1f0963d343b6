// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "vitrine/catalog_feed.hpp"

using ::testing::HasSubstr;
using vitrine::FeedFormat;
using vitrine::FeedOptions;
using vitrine::FeedPlatform;

class FeedOut : public Inputs {
 protected:
  /// A GLB of one accessor: 0.5 m wide, 0.7 m high, 0.25 m deep.
  void glb(const std::string& path, std::size_t padding = 0) const {
    std::string json =
        R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":2,"type":"VEC3","min":[-0.25,0.8,-0.1],)"
        R"("max":[0.25,1.5,0.15]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
    while (json.size() % 4 != 0) json += ' ';
    const auto word = [](std::size_t n) {
      std::string bytes;
      for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> (8 * i) & 255);
      return bytes;
    };
    std::filesystem::create_directories((root / path).parent_path());
    write(path, "glTF" + word(2) + word(20 + json.size() + padding) + word(json.size()) + "JSON" + json +
                    std::string(padding, '\0'));
  }
  vitrine::Feed feed(FeedPlatform platform, FeedFormat format, const vitrine::CatalogInput* input = nullptr) const {
    FeedOptions options;
    options.platform = platform;
    options.format = format;
    options.base_url = "https://shop.example/3d";
    options.input = input;
    const auto made = make_feed((root / "out").string(), options);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? *made : vitrine::Feed{};
  }
  void a_run() const {
    glb("out/b/garment.glb");
    glb("out/a/garment.glb");
    glb("out/a/dressed.glb");
    write("out/a/preview.png", "png");
    write("out/report.jsonl", "{}");
    glb("out/quarantine/c/garment.glb");
    glb("out/a/quarantine/xl/garment.glb");
    std::filesystem::create_directories(root / "out/refused");
  }
  vitrine::CatalogInput told() const {
    return get(write("f.tsv",
                     "id\ttitle\timage_link\tadditional_image_link\titem_group_id\tsize\n"
                     "a-S & \"x\"\tVest <\"Ä\">\tu_f.jpg\tu_b.jpg\ta\tS\na-M\tVest <\"Ä\">\tu_f.jpg\tu_b.jpg\ta\tM\n"));
  }
};

TEST_F(FeedOut, google_gets_a_row_for_every_id_that_shares_the_model) {
  a_run();
  const auto input = told();
  const auto tsv = feed(FeedPlatform::google, FeedFormat::tsv, &input);
  EXPECT_EQ(tsv.text,
            "id\tvirtual_model_link\na-M\thttps://shop.example/3d/a/garment.glb\n"
            "\"a-S & \"\"x\"\"\"\thttps://shop.example/3d/a/garment.glb\nb\thttps://shop.example/3d/b/garment.glb\n");
  EXPECT_EQ(tsv.items, 2);
}

TEST_F(FeedOut, google_xml_escapes_and_is_a_feed_that_can_be_read) {
  a_run();
  const auto input = told();
  const auto xml = feed(FeedPlatform::google, FeedFormat::xml, &input);
  EXPECT_THAT(xml.text, HasSubstr("<g:id>a-S &amp; &quot;x&quot;</g:id><g:virtual_model_link>https://shop.example/3d/a/"
                                  "garment.glb</g:virtual_model_link>"));
  const auto again = vitrine::read_input(write("again.xml", xml.text));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->left_out.size(), 3u) << "three ids, none with a garment's words";
}

TEST_F(FeedOut, shopify_gets_rows_with_the_keys_of_its_media_input) {
  a_run();
  const auto input =
      get(write("s.csv", "Handle,Title,Type,Image Src\na,\"Vest, \"\"Ä\"\"\",Vests,a_front.jpg\na,,,a_back.jpg\n"));
  EXPECT_THAT(feed(FeedPlatform::shopify, FeedFormat::csv, &input).text,
              HasSubstr("URL handle,Media content type,Original source,Alt,Bytes\n"
                        "a,MODEL_3D,https://shop.example/3d/a/garment.glb,\"Vest, \"\"Ä\"\", 3D model\","));
}

TEST_F(FeedOut, items_json_has_sizes_bytes_hashes_and_a_phrase_for_those_who_do_not_see) {
  a_run();
  glb("out/a/xs/garment.glb");
  const auto input = told();
  const auto all = nlohmann::json::parse(feed(FeedPlatform::items, FeedFormat::json, &input).text);
  ASSERT_EQ(all["items"].size(), 2u);
  const auto& a = all["items"][0];
  EXPECT_EQ(a["sku"], "a");
  EXPECT_EQ(a["alt"], "Vest <\"Ä\">, 3D model");
  EXPECT_EQ(a["poster"]["path"], "a/preview.png");
  ASSERT_EQ(a["models"].size(), 3u);
  EXPECT_EQ(a["models"][0]["name"], "dressed");
  EXPECT_EQ(a["models"][1]["width_mm"], 500);
  EXPECT_EQ(a["models"][1]["height_mm"], 700);
  EXPECT_EQ(a["models"][1]["depth_mm"], 250);
  EXPECT_EQ(a["models"][1]["bytes"], std::filesystem::file_size(root / "out/a/garment.glb"));
  EXPECT_EQ(a["models"][1]["sha256"].get<std::string>().size(), 64u);
  EXPECT_EQ(a["models"][2]["mannequin"], "xs");
  EXPECT_EQ(a["sizes"], (std::vector<std::string>{"M", "S"}));
}

TEST_F(FeedOut, the_same_folder_gives_the_same_bytes) {
  a_run();
  const auto once = feed(FeedPlatform::items, FeedFormat::json).text;
  EXPECT_EQ(feed(FeedPlatform::items, FeedFormat::json).text, once);
}

TEST_F(FeedOut, models_above_a_platforms_limit_are_left_out_and_above_its_advice_warned_of) {
  glb("out/big/garment.glb", (15u << 20) + 4096);
  glb("out/fat/garment.glb", 11u << 20);
  glb("out/fit/garment.glb");
  const auto google = feed(FeedPlatform::google, FeedFormat::tsv);
  EXPECT_EQ(google.items, 2);
  ASSERT_EQ(google.left_out.size(), 1u);
  EXPECT_EQ(google.left_out[0].code, "MODEL_TOO_LARGE");
  EXPECT_THAT(google.left_out[0].message, HasSubstr("big/garment.glb"));
  ASSERT_EQ(google.warnings.size(), 1u);
  EXPECT_THAT(google.warnings[0], HasSubstr("fat/garment.glb"));
  EXPECT_EQ(feed(FeedPlatform::shopify, FeedFormat::csv).items, 3);
}

TEST_F(FeedOut, an_address_of_2000_characters_goes_in_and_one_of_2001_does_not) {
  glb("out/a/garment.glb");
  FeedOptions options;
  options.platform = FeedPlatform::google;
  options.format = FeedFormat::tsv;
  const std::string tail = "/a/garment.glb", head = "https://x/";
  for (const std::size_t length : {2000u, 2001u}) {
    options.base_url = head + std::string(length - head.size() - tail.size(), 'y');
    const auto made = make_feed((root / "out").string(), options);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->items, length == 2000 ? 1 : 0);
    if (length > 2000) {
      EXPECT_EQ(made->left_out.at(0).code, "URL_TOO_LONG");
    }
  }
}

TEST_F(FeedOut, a_broken_model_is_left_out_by_name_and_no_other) {
  a_run();
  write("out/b/garment.glb", "glTF");
  write("out/b/dressed.glb", "no");
  const auto made = feed(FeedPlatform::google, FeedFormat::tsv);
  EXPECT_EQ(made.items, 1);
  ASSERT_EQ(made.left_out.size(), 2u);
  EXPECT_EQ(made.left_out[1].code, "MODEL_FILE");
  EXPECT_THAT(made.left_out[1].message, HasSubstr("b/garment.glb"));
}

TEST_F(FeedOut, bad_addresses_and_empty_folders_are_refused) {
  a_run();
  for (const char* base : {"", "ftp://x/", "shop.example", "https://", "https:///x", "https://x y/", "https://x/?a=1",
                           "https://x/\"><script>"}) {
    FeedOptions options;
    options.platform = FeedPlatform::google;
    options.base_url = base;
    const auto made = make_feed((root / "out").string(), options);
    ASSERT_FALSE(made) << base;
    EXPECT_EQ(made.error().code, "BASE_URL");
    EXPECT_EQ(made.error().exit_code(), 64);
  }
  std::filesystem::create_directories(root / "empty");
  EXPECT_EQ(vitrine::make_feed((root / "empty").string(), {}).error().code, "NO_MODELS");
  EXPECT_EQ(vitrine::make_feed((root / "none").string(), {}).error().exit_code(), 66);
}
