// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <random>
#include <set>

#include "folder_name.hpp"
#include "image_root.hpp"
#include "inputs.hpp"
#include "vitrine/catalog.hpp"

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using vitrine::input::folder_name;
using vitrine::input::ImageRoot;
using vitrine::input::path_parts;

class Paths : public Inputs {};

TEST_F(Paths, an_address_is_its_path_without_host_query_and_codes) {
  EXPECT_THAT(path_parts("https://cdn.example/a/b%20c/d.jpg?v=1#x"), ElementsAre("a", "b c", "d.jpg"));
  EXPECT_THAT(path_parts("//cdn.example/d.jpg"), ElementsAre("d.jpg"));
  EXPECT_THAT(path_parts("a\\b/./c#1?.jpg"), ElementsAre("a", "b", "c#1?.jpg"));
  EXPECT_THAT(path_parts("file:///etc/passwd"), ElementsAre("etc", "passwd"));
  for (const char* bad : {"../a.jpg", "a/../b.jpg", "https://x/%2e%2e/b.jpg", "https://x/..%2fb.jpg",
                          "https://x/a%00.jpg", "a\n.jpg", "", "https://x"})
    EXPECT_TRUE(path_parts(bad).empty()) << bad;
}

TEST_F(Paths, a_picture_is_found_by_the_longest_tail_of_its_address_then_by_its_name) {
  picture("r/2026/a.jpg");
  picture("r/a.jpg");
  picture("r/deep/er/only.jpg");
  picture("r/x/twin.jpg");
  picture("r/y/twin.jpg");
  picture("r/b c.jpg");
  const auto images = ImageRoot::open((root / "r").string());
  ASSERT_TRUE(images);
  const std::string real = std::filesystem::canonical(root / "r").string() + "/";
  EXPECT_EQ(images->find("https://x/uploads/2026/a.jpg?w=1").file, real + "2026/a.jpg");
  EXPECT_EQ(images->find("https://x/uploads/2025/a.jpg").file, real + "a.jpg");
  EXPECT_EQ(images->find("https://x/p/only.jpg").file, real + "deep/er/only.jpg");
  EXPECT_EQ(images->find("https://x/y/twin.jpg").file, real + "y/twin.jpg");
  EXPECT_EQ(images->find("https://x/b%20c.jpg").file, real + "b c.jpg");
  EXPECT_THAT(images->find("https://x/twin.jpg").why, HasSubstr("several"));
  EXPECT_THAT(images->find("https://x/none.jpg").why, HasSubstr("there is no \"none.jpg\""));
}

TEST_F(Paths, nothing_outside_the_image_root_is_ever_found) {
  picture("secret.jpg");
  picture("r/in.jpg");
  picture("other/b.jpg");
  std::filesystem::create_symlink(root / "secret.jpg", root / "r" / "leak.jpg");
  std::filesystem::create_symlink(root / "other", root / "r" / "folder");
  std::filesystem::create_symlink("/etc/passwd", root / "r" / "passwd.jpg");
  std::filesystem::create_symlink(root / "r" / "in.jpg", root / "r" / "alias.jpg");
  std::filesystem::create_symlink(root / "r", root / "r" / "loop");
  const auto images = ImageRoot::open((root / "r").string());
  ASSERT_TRUE(images);
  const std::string absolute = (root / "secret.jpg").string();
  for (const std::string& source :
       {std::string("../secret.jpg"), std::string("https://x/../secret.jpg"), std::string("r/../../secret.jpg"),
        absolute, "file://" + absolute, std::string("leak.jpg"), std::string("folder/b.jpg"), std::string("passwd.jpg"),
        std::string("/etc/passwd"), std::string("%2e%2e/secret.jpg"), std::string("loop/../secret.jpg")})
    EXPECT_EQ(images->find(source).file, "") << source;
  EXPECT_TRUE(ends(images->find("alias.jpg").file, "/r/in.jpg"))
      << "a link that stays inside is the file it stands for";
}

TEST_F(Paths, a_missing_picture_refuses_its_product_with_exit_code_66) {
  picture("img/harbour-vest_front.jpg");
  picture("img/harbour-vest_back.jpg");
  vitrine::InputOptions options;
  options.image_root = (root / "img").string();
  const auto input = get(shop("shopify-legacy.csv"), options);
  EXPECT_TRUE(ends(item(input, "harbour-vest").front, "/img/harbour-vest_front.jpg"));
  const auto& skirt = item(input, "dune-skirt");
  ASSERT_TRUE(skirt.refusal);
  EXPECT_EQ(skirt.refusal->code, "PICTURE_MISSING");
  EXPECT_EQ(skirt.refusal->exit_code(), 66);
  EXPECT_THAT(skirt.refusal->message, HasSubstr("DUNE-01.jpg"));
}

TEST_F(Paths, a_feed_without_an_image_root_can_be_planned_but_not_run) {
  EXPECT_FALSE(get(shop("shopify.csv")).pictures_found);
  const auto items = vitrine::read_items(shop("shopify.csv"));
  ASSERT_FALSE(items);
  EXPECT_EQ(items.error().exit_code(), 64);
  EXPECT_THAT(items.error().remedy, HasSubstr("--image-root"));
}

TEST(FolderName, keeps_plain_ids_and_rewrites_the_others_by_their_own_bytes_alone) {
  EXPECT_EQ(folder_name("NB-100.a_b"), "NB-100.a_b");
  EXPECT_EQ(folder_name("MT 7/1"), "MT_7_1-x59451b32355f9a45");
  EXPECT_EQ(folder_name("../../etc"), folder_name("../../etc"));
  EXPECT_NE(folder_name("a b"), folder_name("a/b")) << "what they share does not make them one";
  EXPECT_NE(folder_name("MT_7_1-x59451b32355f9a45"), "MT_7_1-x59451b32355f9a45")
      << "an id that looks like a rewritten one is rewritten";
  for (const char* taken : {"report.jsonl", "Summary.json", "items.json", "quarantine", "journal.jsonl"})
    EXPECT_NE(folder_name(taken), taken);
}

TEST(FolderName, a_hundred_thousand_hostile_ids_have_safe_names_of_their_own) {
  std::mt19937 random(20260501);
  const std::string alphabet = std::string("ab/\\.. -_~%\n\"'`$:*?<>|\xC3\xA4x0", 26) + '\0';
  std::map<std::string, std::string> seen;
  for (int i = 0; i < 100'000; ++i) {
    std::string id;
    const auto n = random() % 130;
    for (unsigned k = 0; k < n; ++k) id += alphabet[random() % alphabet.size()];
    if (i % 3 == 0) id = folder_name(id);  // names that are names of ours already
    const std::string name = folder_name(id);
    ASSERT_FALSE(name.empty());
    ASSERT_LE(name.size(), 100u);
    ASSERT_TRUE(name[0] != '.' && name[0] != '-') << name;
    for (const char c : name)
      ASSERT_TRUE((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
                  c == '-')
          << name;
    const auto [known, fresh] = seen.emplace(name, id);
    ASSERT_TRUE(fresh || known->second == id) << name;
  }
}
