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
