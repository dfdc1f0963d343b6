// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for any feed, over random ones.
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "inputs.hpp"

namespace {

using vitrine::CatalogItem;

/// Everything of an item but its place in the file.
std::string told(const CatalogItem& i) {
  std::string all;
  for (const std::string& text :
       {i.sku, i.product_id, i.garment, i.neckline, i.front, i.back, i.front_mask, i.back_mask, i.fabric, i.title,
        i.copyright, std::string(i.mirror_back ? "mirror" : ""), i.refusal ? i.refusal->code : std::string()})
    all += text + "|";
  for (const auto& number : {i.chest_cm, i.length_cm}) all += number ? std::to_string(*number) + "|" : "|";
  for (const std::string& who : i.mannequins) all += who + " ";
  return all;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  unsigned below(unsigned n) { return static_cast<unsigned>(engine_() % n); }
  template <class T>
  const T& of(const std::vector<T>& list) {
    return list[below(static_cast<unsigned>(list.size()))];
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[below(static_cast<unsigned>(i))]);
  }
  std::string text() {
    std::string all;
    for (unsigned n = below(12); n > 0; --n)
      all += of<std::string>({"a", "B", "7", " ", ",", "\"", "ä", "€", "&", "<", ";", "'", "\\", "%", "#", "="});
    return all;
  }

 private:
  std::mt19937 engine_;
};

std::string quoted(const std::string& field) {
  std::string all = "\"";
  for (const char c : field) all += c == '"' ? std::string("\"\"") : std::string(1, c);
  return all + "\"";
}

/// Rows of a Shopify export: each product's texts, then its pictures and sizes.
std::vector<std::string> shopify_rows(Random& random, int products) {
  std::vector<std::string> rows;
  for (int p = 0; p < products; ++p) {
    const std::string handle = quoted("h" + std::to_string(p) + random.text());
    const std::string title = quoted(random.text() + "t"),
                      type = random.of<std::string>({"Vests", "Skirts", "Mugs", "Jumpers"});
    const unsigned pictures = 1 + random.below(5);
    for (unsigned k = 0; k < pictures; ++k)
      rows.push_back(handle + "," + title + "," + type + ",https://x.example/" + std::to_string(p) + "/" +
                     random.of<std::string>({"a", "b_back", "c-front", "d_1", "e_2", "side"}) + std::to_string(k) +
                     random.of<std::string>({"", "_back", "_front", "-01"}) + ".jpg," + std::to_string(k + 1) + "," +
                     random.of<std::string>({"", "Front view", "Back view", "Detail"}) + ",Size," +
                     random.of<std::string>({"S", "M", "L"}));
  }
  return rows;
}

}  // namespace

class Properties : public Inputs {
 protected:
  static std::multiset<std::string> told_all(const vitrine::CatalogInput& input) {
    std::multiset<std::string> all;
    for (const CatalogItem& i : input.items) all.insert(told(i));
    for (const auto& l : input.left_out) all.insert("left out " + l.id + l.reason);
    return all;
  }
};

TEST_F(Properties, the_order_of_a_feeds_rows_changes_no_item) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    std::vector<std::string> rows = shopify_rows(random, 12);
    const auto read = [&] {
      std::string text = "Handle,Title,Type,Image Src,Image Position,Image Alt Text,Option1 Name,Option1 Value\n";
      for (const std::string& row : rows) text += row + "\n";
      return told_all(get(write("s.csv", text)));
    };
    const auto before = read();
    random.shuffle(rows);
    ASSERT_EQ(read(), before) << "seed " << seed;
  }
}

TEST_F(Properties, the_order_of_googles_rows_and_columns_changes_no_item) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    std::vector<std::array<std::string, 6>> rows;
    for (int i = 0; i < 30; ++i) {
      const std::string colour = random.of<std::string>({"red", "blue", ""});
      const std::string group = random.of<std::string>({"", "g1", "g2", "g3"});
      rows.push_back({"id" + std::to_string(i), "Vest " + std::to_string(random.below(3)), colour, group,
                      "https://x.example/" + group + colour + "/f_front.jpg",
                      "https://x.example/" + group + colour + "/f_back.jpg"});
    }
    std::vector<std::size_t> columns{0, 1, 2, 3, 4, 5};
    const std::array<std::string, 6> names{
        "id", "title", "color", "item_group_id", "image_link", "additional_image_link"};
    const auto read = [&] {
      std::string text;
      for (std::size_t c = 0; c < 6; ++c) text += (c ? "\t" : "") + names[columns[c]];
      for (const auto& row : rows) {
        text += "\n";
        for (std::size_t c = 0; c < 6; ++c) text += (c ? "\t" : "") + row[columns[c]];
      }
      return told_all(get(write("g.tsv", text + "\n")));
    };
    const auto before = read();
    random.shuffle(rows);
    random.shuffle(columns);
    ASSERT_EQ(read(), before) << "seed " << seed;
  }
}

TEST_F(Properties, a_written_manifest_reads_as_the_same_items) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<CatalogItem> items;
    for (int i = 0; i < 8; ++i) {
      CatalogItem item;
      item.sku = "s" + std::to_string(i);
      item.garment = random.of<std::string>({"vest", "skirt", "a \"b\", c"});
      item.neckline = random.of<std::string>({"auto", "neck_v"});
      item.front = (root / random.of<std::string>({"f.jpg", "in/ä, \"x\".jpg", "../up.jpg", " lead.jpg"}))
                       .lexically_normal()
                       .string();
      if (random.below(3) > 0) {
        item.back = (root / "b.jpg").string();
        if (random.below(2)) item.back_mask = (root / "bm.png").string();
      } else {
        item.mirror_back = true;
      }
      if (random.below(2)) item.chest_cm = 5 + random.below(29500) / 100.0 + 1e-9 * random.below(9);
      if (random.below(2)) item.length_cm = 61.5;
      if (random.below(2)) item.mannequins = {"XS", "woman-m", "XL"};
      item.fabric = random.of<std::string>({"", "jersey"});
      item.title = "t" + random.text() + "\n" + random.text() + "t";
      item.product_id = random.of<std::string>({"", "a/b \"c\", d"});
      items.push_back(std::move(item));
    }
    for (const char* name : {"m.csv", "deep/m.json"}) {
      const std::string path = (root / name).string();
      std::filesystem::create_directories(root / "deep");
      const auto error = vitrine::write_manifest(items, path);
      ASSERT_FALSE(error) << error->message;
      const auto again = get(path);
      ASSERT_EQ(again.items.size(), items.size());
      for (std::size_t i = 0; i < items.size(); ++i) {
        EXPECT_EQ(told(again.items[i]), told(items[i])) << name << " seed " << seed;
        EXPECT_EQ(again.items[i].chest_cm, items[i].chest_cm) << "to the last bit";
      }
      const std::string once = read(path);
      ASSERT_FALSE(vitrine::write_manifest(again.items, path));
      EXPECT_EQ(read(path), once) << "and writes the same bytes";
    }
  }
}

TEST_F(Properties, any_feed_becomes_a_manifest_that_reads_as_its_items) {
  for (const char* name :
       {"harbour-vest_front.jpg", "harbour-vest_back.jpg", "DUNE-01.jpg",
        "DUNE-02_5f0c1c2e-8a4b-4d5e-9f00-0123456789ab.jpg", "100/front.jpg", "100/back.jpg", "200/fjord_01.jpg",
        "200/fjord_02.jpg", "lina_vorne.jpg", "lina_hinten.jpg", "a1_F.jpg", "a1_B.jpg", "loom-vest-front-scaled.jpg",
        "loom-vest-back-1024x1365.jpg", "moss-front.jpg", "moss-back.jpg", "IMG_4410.jpg", "IMG_4411.jpg"})
    picture(std::string("img/") + name);
  vitrine::InputOptions options;
  options.image_root = (root / "img").string();
  for (const char* feed :
       {"shopify-legacy.csv", "shopify.csv", "google.tsv", "google.xml", "google-atom.xml", "woocommerce.csv"})
    for (const char* name : {"m.csv", "m.json"}) {
      auto input = get(shop(feed), options);
      std::erase_if(input.items, [](const CatalogItem& i) { return i.refusal != nullptr; });
      ASSERT_FALSE(input.items.empty()) << feed;
      ASSERT_FALSE(vitrine::write_manifest(input.items, (root / name).string()));
      const auto again = get((root / name).string());
      ASSERT_EQ(again.items.size(), input.items.size()) << feed;
      for (std::size_t i = 0; i < again.items.size(); ++i)
        EXPECT_EQ(told(again.items[i]), told(input.items[i])) << feed;
    }
}

TEST_F(Properties, a_value_that_a_manifest_cannot_hold_is_refused_when_it_is_written) {
  CatalogItem item;
  item.sku = "a";
  item.garment = "vest";
  item.back = (root / "b.jpg").string();
  item.front = (root / "f.jpg ").string();
  const auto error = vitrine::write_manifest({item}, (root / "m.csv").string());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, "MANIFEST_VALUE");
  EXPECT_FALSE(std::filesystem::exists(root / "m.csv"));
  item.front = (root / "f.jpg").string();
  EXPECT_EQ(vitrine::write_manifest({item}, (root / "none" / "m.csv").string())->exit_code(), 73);
}
