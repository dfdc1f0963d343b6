// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_input.hpp"

#include <stdlib.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "read_input.hpp"
#include "vitrine/sku.hpp"

namespace {

namespace fs = std::filesystem;
using vitrine::CatalogInput;
using vitrine::CatalogItem;
using vitrine::InputKind;

void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

/// An image root with the seeds' pictures, and around it what must never be reached.
class World {
 public:
  World() {
    std::string pattern = (fs::temp_directory_path() / "vitrine-fuzz-XXXXXX").string();
    promise(::mkdtemp(pattern.data()) != nullptr, "a temporary folder can be made");
    top_ = fs::canonical(pattern);
    for (const char* name : {"root/harbour-vest_front.jpg",
                             "root/harbour-vest_back.jpg",
                             "root/DUNE-01.jpg",
                             "root/DUNE-02.jpg",
                             "root/100/front.jpg",
                             "root/100/back.jpg",
                             "root/lina_vorne.jpg",
                             "root/lina_hinten.jpg",
                             "root/a1_F.jpg",
                             "root/a1_B.jpg",
                             "root/moss-front.jpg",
                             "root/moss-back.jpg",
                             "root/v-1_front.jpg",
                             "root/v-1_back.jpg",
                             "root/a.jpg",
                             "root/b.jpg",
                             "root/s-1.jpg",
                             "secret_front.jpg",
                             "secret.jpg",
                             "elsewhere/b.jpg"}) {
      fs::create_directories((top_ / name).parent_path());
      std::ofstream(top_ / name) << "picture";
    }
    fs::create_symlink(top_ / "secret.jpg", root() / "leak.jpg");
    fs::create_symlink(top_ / "elsewhere", root() / "out");
    fs::create_symlink(top_, root() / "up");
    fs::create_symlink(root(), root() / "loop");
    auto opened = vitrine::input::ImageRoot::open(root().string());
    promise(static_cast<bool>(opened), "the image root opens");
    images = std::make_unique<vitrine::input::ImageRoot>(std::move(*opened));
    auto built_in = vitrine::input::parse_rules("", "");
    promise(static_cast<bool>(built_in), "the built-in rules are good");
    rules = std::make_unique<vitrine::input::Rules>(std::move(*built_in));
    auto all = vitrine::input::parse_rules(R"({"default_garment": "vest", "no_back": "mirror", "mannequins": "sizes",
      "leave_out_status": [], "garments": [], "measures": [{"is": "chest_cm", "column": "size"}]})",
                                           "generous");
    promise(static_cast<bool>(all), "the generous rules are good");
    generous = std::make_unique<vitrine::input::Rules>(std::move(*all));
  }
  ~World() {
    std::error_code ignored;
    fs::remove_all(top_, ignored);
  }
  fs::path root() const { return top_ / "root"; }
  bool inside(const std::string& file) const {
    std::error_code failed;
    const std::string real = fs::weakly_canonical(file, failed).string(), start = root().string() + "/";
    return !failed && real.compare(0, start.size(), start) == 0;
  }

  std::unique_ptr<vitrine::input::ImageRoot> images;
  std::unique_ptr<vitrine::input::Rules> rules, generous;

 private:
  fs::path top_;
};

const World& world() {
  static const World one;
  return one;
}

bool same(const CatalogItem& a, const CatalogItem& b) {
  return a.sku == b.sku && a.garment == b.garment && a.neckline == b.neckline && a.front == b.front &&
         a.back == b.back && a.mirror_back == b.mirror_back && a.front_mask == b.front_mask &&
         a.back_mask == b.back_mask && a.chest_cm == b.chest_cm && a.length_cm == b.length_cm && a.fabric == b.fabric &&
         a.mannequins == b.mannequins && a.title == b.title && a.copyright == b.copyright &&
         a.product_id == b.product_id;
}

void check_round_trip(const CatalogInput& input) {
  for (const char* name : {"m.csv", "m.json"}) {
    const std::string path = (world().root() / name).string();
    const auto text = vitrine::input::manifest_text(input.items, path);
    if (!text) continue;  // it says that a manifest cannot hold them
    std::vector<const CatalogItem*> kept;
    for (const CatalogItem& item : input.items)
      if (!item.refusal) kept.push_back(&item);
    if (kept.empty()) continue;
    const auto again =
        vitrine::input::read_input_text(path, *text, InputKind::manifest, *world().rules, nullptr, false);
    if (!again) std::fprintf(stderr, "%s\n%s\n", again.error().message.c_str(), text->c_str());
    promise(static_cast<bool>(again), "a written manifest can be read");
    promise(again->items.size() == kept.size(), "a written manifest has every item");
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const CatalogItem &a = again->items[i], &b = *kept[i];
      if (!same(a, b))
        std::fprintf(stderr, "%s: front %s / %s, back %s / %s, title [%s] / [%s], id [%s] / [%s]\n", a.sku.c_str(),
                     a.front.c_str(), b.front.c_str(), a.back.c_str(), b.back.c_str(), a.title.c_str(), b.title.c_str(),
                     a.product_id.c_str(), b.product_id.c_str());
      promise(same(a, b), "items survive a manifest");
    }
  }
}

void check_items(const CatalogInput& input, bool with_root) {
  std::set<std::string> names;
  for (const CatalogItem& item : input.items) {
    promise(vitrine::is_safe_sku(item.sku), "every item's name is safe");
    promise(names.insert(item.sku).second, "no two items share a name");
    if (item.refusal) {
      promise(!item.refusal->code.empty() && !item.refusal->message.empty() && !item.refusal->remedy.empty(),
              "a refusal says what and what to do");
      continue;
    }
    promise(!item.front.empty() && !item.garment.empty(), "an item has a front and a garment");
    promise(item.back.empty() == item.mirror_back, "an item has a back or mirrors the front");
    if (!with_root) continue;
    for (const std::string* file : {&item.front, &item.back, &item.front_mask, &item.back_mask})
      promise(file->empty() || world().inside(*file), "no picture lies outside the image root");
  }
  promise(!vitrine::plan_table(input).empty(), "a plan can be shown");
  promise(nlohmann::json::accept(vitrine::plan_json(input)), "a plan is JSON");
  if (with_root) check_round_trip(input);  // without one, fronts are still addresses
}

}  // namespace

void check_input(std::string_view text) {
  // A name below the root, so that a manifest's own paths begin there.
  const std::string file = (world().root() / "input").string();
  unsigned sum = 0;
  for (const char c : text) sum = sum * 31 + static_cast<unsigned char>(c);
  constexpr InputKind kinds[] = {InputKind::manifest, InputKind::shopify, InputKind::google, InputKind::woocommerce};
  const bool generous = sum % 2 == 0, rooted = sum % 8 != 1;
  for (const InputKind kind : {InputKind::automatic, kinds[sum / 8 % 4]}) {
    const auto input = vitrine::input::read_input_text(file, text, kind, generous ? *world().generous : *world().rules,
                                                       rooted ? world().images.get() : nullptr, true);
    if (input)
      check_items(*input, rooted);
    else
      promise(!input.error().code.empty() && !input.error().message.empty() && !input.error().remedy.empty() &&
                  (input.error().exit_code() == 65 || input.error().exit_code() == 66),
              "an error says what and what to do");
  }
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && text[first] == '{') {
    const auto rules = vitrine::input::parse_rules(text, "rules");
    if (!rules) promise(rules.error().code == "RULES" && !rules.error().remedy.empty(), "bad rules are called so");
  }
}
