// SPDX-License-Identifier: GPL-3.0-or-later
#include <re2/re2.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "folder_name.hpp"
#include "image_root.hpp"
#include "rules.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

Error refusal(Cause cause, const char* code, const std::string& where, const std::string& what,
              const std::string& remedy) {
  return Error{cause, code, where + ": " + what, remedy, "catalog"};
}

/// A text of the product and what it is called in a plan.
struct Text {
  const char* name;
  const std::string& text;
};

struct Match {
  const TextRule* rule = nullptr;
  std::string why;  ///< "skirt in type"
};

/// The first text that a rule matches decides: what the shop files the product under comes before what it calls it.
/// What a rule wants besides may stand in any of the texts: a type says "Dresses", the title how long the sleeves are.
Match match(const std::vector<TextRule>& rules, std::initializer_list<Text> texts, const std::string& garment) {
  for (const Text& text : texts) {
    if (text.text.empty()) continue;
    for (const TextRule& rule : rules)
      if ((rule.garments.empty() || garment.empty() ||
           std::find(rule.garments.begin(), rule.garments.end(), garment) != rule.garments.end()) &&
          found_in(rule.match, text.text) &&
          (!rule.with ||
           std::any_of(texts.begin(), texts.end(), [&](const Text& other) { return found_in(rule.with, other.text); })))
        return {&rule, rule.name + " in " + text.name};
  }
  return {};
}

std::optional<double> number_in(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  text = trimmed(text);
  double value = 0;
  const auto [rest, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || rest == text.data() || !std::isfinite(value)) return {};
  return value;
}

double unit_cm(std::string unit, double otherwise) {
  unit = lower(trimmed(unit));
  if (unit.rfind("mm", 0) == 0) return 0.1;
  if (unit.rfind("cm", 0) == 0) return 1;
  if (unit.rfind("in", 0) == 0 || unit.rfind('"', 0) == 0) return 2.54;
  return otherwise;
}

/// The first measure of this kind that makes sense; one that does not is passed over, and said so.
std::optional<double> measure(const Product& product, const Rules& rules, bool chest, ItemPlan& plan) {
  for (std::size_t i = 0; i < rules.measures.size(); ++i) {
    const MeasureRule& rule = rules.measures[i];
    if (rule.chest != chest) continue;
    std::string number, unit;
    if (!rule.column.empty()) {
      const auto column =
          std::find_if(product.columns.begin(), product.columns.end(), [&](const auto& c) { return c.first == i; });
      if (column == product.columns.end() || column->second.empty()) continue;
      number = column->second;
      unit = number.substr(std::min(number.size(), number.find_last_of("0123456789") + 1));
    } else {
      const re2::StringPiece text(product.description);
      const bool hit = rule.match->NumberOfCapturingGroups() > 1
                           ? re2::RE2::PartialMatch(text, *rule.match, &number, &unit)
                           : re2::RE2::PartialMatch(text, *rule.match, &number);
      if (!hit) continue;
    }
    const std::optional<double> value = number_in(number);
    const double cm = value ? std::round(*value * unit_cm(unit, rule.unit_cm) * 100) / 100 : 0;
    if (cm >= 5 && cm <= 300) return cm;
    plan.notes.push_back("rule " + rule.name + ": \"" + one_line(number, 40) +
                         "\" is not a length between 5 and 300 cm; it is not used");
  }
  return {};
}

void set_mannequins(const Product& product, const Rules& rules, CatalogItem& item) {
  item.mannequins = rules.mannequins;
  if (!rules.mannequins_from_sizes) return;
  for (const char* known : {"XS", "S", "M", "L", "XL", "XXL"})
    for (const std::string& size : product.sizes)
      if (lower(size) == lower(known)) add_once(item.mannequins, known);
}

}  // namespace

std::optional<CatalogItem> make_item(const Product& product, const Rules& rules, const ImageRoot* root,
                                     const std::string& file, ItemPlan& plan, std::string& left_out) {
  CatalogItem item;
  item.sku = folder_name(product.id);
  if (item.sku != product.id) item.product_id = product.id;
  item.title = shortened(product.title, 1000);
  item.line = product.line;
  plan.handle = product.handle;
  plan.ids = product.ids;
  plan.sizes = product.sizes;
  plan.notes = product.notes;
  const std::string where = file + (product.line > 0 ? ":" + std::to_string(product.line) : "");
  const std::string who = "\"" + one_line(product.id, 80) + "\"";
  const auto refuse = [&](Error error) {
    item.refusal = std::make_shared<const Error>(std::move(error));
    return item;
  };
  if (product.refusal) return refuse(*product.refusal);
  if (const std::string status = lower(product.status);
      std::find(rules.left_out_status.begin(), rules.left_out_status.end(), status) != rules.left_out_status.end()) {
    left_out = "its status is " + one_line(status, 40);
    return {};
  }

  const Text title{"title", product.title}, tags{"tags", product.tags};
  const Match garment =
      match(rules.garments, {{"type", product.type}, {"category", product.category}, tags, title}, "");
  plan.garment_rule = garment.why;
  item.garment = garment.rule != nullptr ? garment.rule->value : rules.default_garment;
  if (item.garment.empty()) {
    const std::string why = garment.rule != nullptr ? "no garment of ours by rule " + garment.rule->name
                                                    : "no rule finds a garment in its type, category, tags or title";
    if (!rules.refuse_no_garment) {
      left_out = why;
      return {};
    }
    return refuse(refusal(Cause::unusable, "NO_GARMENT", where, "product " + who + ": " + why,
                          "Add a rule to \"garments\", or set \"default_garment\"."));
  }
  const Match neckline = match(rules.necklines, {title, tags, {"description", product.description}}, item.garment);
  if (neckline.rule != nullptr && !neckline.rule->value.empty()) {
    item.neckline = neckline.rule->value;
    plan.neckline_rule = neckline.why;
  }
  const Match fabric = match(rules.fabrics, {{"material", product.material}, title, tags}, item.garment);
  if (fabric.rule != nullptr) {
    item.fabric = fabric.rule->value;
    plan.fabric_rule = fabric.why;
  }
  item.chest_cm = measure(product, rules, true, plan);
  item.length_cm = measure(product, rules, false, plan);
  set_mannequins(product, rules, item);

  plan.pictures = choose_pictures(product, rules);
  for (PicturePlan& picture : plan.pictures) {
    std::string* const target = picture.role == "front"        ? &item.front
                                : picture.role == "back"       ? &item.back
                                : picture.role == "front_mask" ? &item.front_mask
                                : picture.role == "back_mask"  ? &item.back_mask
                                                               : nullptr;
    if (target == nullptr) continue;
    if (picture.role == "front") plan.front_rule = picture.rule;
    if (picture.role == "back") plan.back_rule = picture.rule;
    *target = picture.source;
    if (root == nullptr) continue;
    const ImageRoot::Found found = root->find(picture.source);
    *target = found.file;
    if (found.file.empty() && !item.refusal)
      item.refusal = std::make_shared<const Error>(
          refusal(Cause::missing, "PICTURE_MISSING", where, "product " + who + ", " + picture.role + ": " + found.why,
                  "Put the picture below the image root under the name that the feed gives it."));
  }
  if (item.refusal) return item;
  if (item.front.empty())
    return refuse(
        refusal(Cause::unusable, "NO_FRONT", where,
                "product " + who +
                    (product.pictures.empty() ? " has no pictures" : ": no rule says which picture is the front"),
                "Name the files SKU_front.jpg and SKU_back.jpg, write alt texts, or add a rule to "
                "\"pictures\"."));
  if (item.back.empty()) {
    item.back_mask.clear();
    if (!rules.mirror_missing_back)
      return refuse(refusal(Cause::unusable, "NO_BACK", where,
                            "product " + who + ": no rule says which picture is the back",
                            "Add a picture or a rule, or set \"no_back\": \"mirror\" to make backs from the fronts."));
    item.mirror_back = true;
  }
  return item;
}

}  // namespace vitrine::input
