// SPDX-License-Identifier: GPL-3.0-or-later
// A shop's feed from plan to run to what platforms get back, as a shop's night job calls them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "run.hpp"

using namespace vitrine::test;
using ::testing::HasSubstr;

namespace {

fs::path put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

const char* const feed =
    "Handle,Title,Type,Body (HTML),Option1 Name,Option1 Value,Variant SKU,Image Src,Image Position,Image Alt Text\n"
    "terracotta,Ribbed vest & \"more\",Vests,Pit to pit: 46.5 "
    "cm,Size,M,TC-M,https://x/vest-terracotta-front.jpg?v=1,1,\n"
    "terracotta,,,,,L,TC-L,https://x/vest-terracotta-back.jpg?v=1,2,\n"
    "gone,Vest,Vests,,Size,M,G-M,https://x/gone_front.jpg,1,\ngone,,,,,,,https://x/gone_back.jpg,2,\n"
    "mug,Mug,Mugs,,,,,https://x/mug.jpg,1,\n";

}  // namespace

TEST(CatalogInput, a_plan_of_the_sample_photos_finds_every_garment_by_their_names) {
  const Outcome table = run_vitrine("catalog plan " + in_quotes(sample));
  EXPECT_EQ(table.exit_code, 0) << table.text;
  for (const char* cell : {"vest-sailor ", "vest (vest in tags)", "skirt-garden-back.jpg (file-back)", "10 to convert"})
    EXPECT_THAT(table.text, HasSubstr(cell));
  const fs::path folder = scratch();
  const Outcome json = run_vitrine(
      "catalog plan " + in_quotes(sample) + " --json --write-manifest " + in_quotes(folder / "m.json"), "2>/dev/null");
  const auto plan = nlohmann::json::parse(json.text);
  EXPECT_EQ(plan["items"].size(), 10u);
  EXPECT_EQ(plan["items"][0]["rules"]["front"], "file-front");
  const Outcome again = run_vitrine("catalog plan " + in_quotes(folder / "m.json"));
  EXPECT_THAT(again.text, HasSubstr("manifest: 10 to convert, 0 refused"));
}

TEST(CatalogInput, a_feed_with_a_bad_product_is_run_and_the_product_is_refused_in_the_report) {
  const fs::path folder = scratch(), path = put(folder / "shop.csv", feed), out = folder / "out";
  const std::string input = in_quotes(path) + " --image-root " + in_quotes(sample);
  const Outcome plan = run_vitrine("catalog plan " + input);
  EXPECT_THAT(plan.text, HasSubstr("1 to convert, 1 refused, 1 left out"));
  const Outcome run = run_vitrine("-q catalog run " + input + " --quality draft --out " + in_quotes(out));
  EXPECT_NE(run.exit_code, 0);
  std::map<std::string, nlohmann::json> report;
  std::ifstream lines(out / "report.jsonl");
  for (std::string line; std::getline(lines, line);) {
    const auto entry = nlohmann::json::parse(line);
    report[entry["sku"].get<std::string>()] = entry;
  }
  ASSERT_EQ(report.size(), 2u) << run.text;
  EXPECT_EQ(report["terracotta"]["status"], "ok");
  EXPECT_EQ(report["gone"]["code"], "PICTURE_MISSING");
  EXPECT_EQ(report["gone"]["exit_code"], 66);
  ASSERT_TRUE(fs::exists(out / "terracotta" / "garment.glb"));

  const std::string base = "catalog feed " + in_quotes(out) + " --base-url https://shop.example/3d --input " + input;
  const Outcome google = run_vitrine("-q " + base + " --platform google");
  EXPECT_EQ(google.exit_code, 0) << google.text;
  EXPECT_EQ(google.text,
            "id\tvirtual_model_link\nTC-M\thttps://shop.example/3d/terracotta/garment.glb\n"
            "TC-L\thttps://shop.example/3d/terracotta/garment.glb\n");
  const Outcome shopify = run_vitrine("-q " + base + " --platform shopify --model dressed");
  EXPECT_THAT(shopify.text,
              HasSubstr("\nterracotta,MODEL_3D,https://shop.example/3d/terracotta/dressed.glb,\"Ribbed vest & "
                        "\"\"more\"\", 3D model\","));
  EXPECT_EQ(run_vitrine("-q " + base + " --platform items --out " + in_quotes(out / "items.json")).exit_code, 0);
  const auto items = nlohmann::json::parse(slurp(out / "items.json"));
  ASSERT_EQ(items["items"].size(), 1u);
  const auto& models = items["items"][0]["models"];
  ASSERT_EQ(models.size(), 2u);
  // A vest of 46.5 cm, and a person in it.
  EXPECT_EQ(models[1]["name"], "garment");
  EXPECT_GT(models[1]["width_mm"], 300);
  EXPECT_LT(models[1]["height_mm"], 800);
  EXPECT_GT(models[0]["height_mm"], 1500);
  EXPECT_EQ(models[1]["bytes"], fs::file_size(out / "terracotta" / "garment.glb"));
}

TEST(CatalogInput, wrong_uses_say_what_to_do_with_their_exit_code) {
  const fs::path folder = scratch(), path = put(folder / "shop.csv", feed);
  const std::string out = " --out " + in_quotes(folder / "out");
  const auto refuses = [&](const std::string& arguments, int exit_code, const std::string& text) {
    const Outcome run = run_vitrine(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << arguments << "\n" << run.text;
    EXPECT_THAT(run.text, HasSubstr(text)) << arguments;
  };
  refuses("catalog run " + in_quotes(path) + out, 64, "--image-root");
  refuses("catalog plan " + in_quotes(path) + " --write-manifest m.csv", 64, "--image-root");
  refuses("catalog run " + in_quotes(path) + " --image-root " + in_quotes(folder / "none") + out, 66, "IMAGE_ROOT");
  refuses("catalog plan " + in_quotes(folder / "none.csv"), 66, "MANIFEST_MISSING");
  refuses("catalog plan " + in_quotes(path) + " --input-kind google", 65, "MANIFEST_COLUMN");
  refuses("catalog plan " + in_quotes(path) + " --rules " + in_quotes(put(folder / "r.json", "{\"pictures\": 3}")), 65,
          "RULES");
  refuses("catalog plan", 64, "no input");
  refuses("catalog feed " + in_quotes(folder) + " --platform google --base-url x", 64, "BASE_URL");
  refuses("catalog feed " + in_quotes(folder) + " --platform google --base-url https://x --format json", 64,
          "tsv or xml");
  refuses("catalog feed " + in_quotes(folder) + " --platform items", 65, "NO_MODELS");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(CatalogInput, the_printed_rules_can_be_given_back) {
  const fs::path folder = scratch();
  const Outcome rules = run_vitrine("catalog plan --print-rules");
  ASSERT_EQ(rules.exit_code, 0);
  const Outcome plan = run_vitrine("catalog plan " + in_quotes(sample) + " --rules " +
                                   in_quotes(put(folder / "rules.json", rules.text)));
  EXPECT_THAT(plan.text, HasSubstr("10 to convert"));
}
