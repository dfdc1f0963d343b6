// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "text.hpp"
#include "vitrine/catalog_input.hpp"

namespace vitrine {
namespace {

using Json = nlohmann::ordered_json;

/// The last part of a path or address: what fits a table.
std::string short_name(const std::string& source) {
  std::string name = source.substr(0, source.find_first_of("?#"));
  while (!name.empty() && name.back() == '/') name.pop_back();
  return input::one_line(name.substr(name.rfind('/') + 1), 60);
}

/// Files that an item names and that are not there: nothing reads them yet.
std::vector<std::string> missing_files(const CatalogItem& item) {
  std::vector<std::string> missing;
  for (const std::string* file : {&item.front, &item.back, &item.front_mask, &item.back_mask}) {
    std::error_code failed;
    if (!file->empty() && !std::filesystem::is_regular_file(*file, failed)) missing.push_back(*file);
  }
  return missing;
}

/// Columns of a width that their longest cell asks for; counts characters, not bytes.
std::string table_of(const std::vector<std::vector<std::string>>& rows) {
  const auto width_of = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
  };
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += row[i] + std::string(i + 1 < row.size() ? widths[i] - width_of(row[i]) + 2 : 0, ' ');
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::string by_rule(const std::string& value, const std::string& rule) {
  return value + (rule.empty() || rule == "manifest" || value.empty() ? "" : " (" + rule + ")");
}

Json error_json(const Error& error) {
  return {{"code", error.code}, {"message", error.message}, {"remedy", error.remedy}, {"exit_code", error.exit_code()}};
}

}  // namespace

std::string plan_table(const CatalogInput& input) {
  std::vector<std::vector<std::string>> rows{{"SKU", "GARMENT", "FRONT", "BACK", "MIRROR", "MISSING"}};
  std::size_t refused = 0;
  std::map<std::string, std::size_t> reasons;
  for (std::size_t i = 0; i < input.items.size(); ++i) {
    const CatalogItem& item = input.items[i];
    const ItemPlan plan = i < input.plan.size() ? input.plan[i] : ItemPlan{};
    std::string missing;
    if (item.refusal) {
      ++refused;
      missing = item.refusal->code;
    } else if (input.pictures_found) {
      for (const std::string& file : missing_files(item)) missing += (missing.empty() ? "" : ", ") + short_name(file);
    }
    rows.push_back({item.sku, by_rule(item.garment, plan.garment_rule),
                    by_rule(short_name(item.front), plan.front_rule), by_rule(short_name(item.back), plan.back_rule),
                    item.mirror_back ? "yes" : "no", missing.empty() ? "-" : missing});
  }
  std::string out = table_of(rows);
  for (const CatalogItem& item : input.items)
    if (item.refusal) out += "refused: " + item.refusal->message + "\n         " + item.refusal->remedy + "\n";
  for (std::size_t i = 0; i < input.plan.size(); ++i)
    for (const std::string& note : input.plan[i].notes) out += "note: " + input.items[i].sku + ": " + note + "\n";
  for (const LeftOut& product : input.left_out) ++reasons[product.reason];
  for (const auto& [reason, count] : reasons) {
    out += "left out: " + std::to_string(count) + (count == 1 ? " product: " : " products: ") + reason + " (";
    std::size_t named = 0;
    for (const LeftOut& product : input.left_out)
      if (product.reason == reason && ++named <= 5) out += (named > 1 ? ", " : "") + product.id;
    out += named > 5 ? ", ...)\n" : ")\n";
  }
  for (const std::string& warning : input.warnings) out += "warning: " + warning + "\n";
  out += std::string(name_of(input.kind)) + ": " + std::to_string(input.items.size() - refused) + " to convert, " +
         std::to_string(refused) + " refused, " + std::to_string(input.left_out.size()) + " left out";
  out += input.pictures_found ? "\n" : "; pictures not looked for (no --image-root)\n";
  return out;
}

std::string plan_json(const CatalogInput& input) {
  Json all{{"kind", name_of(input.kind)}, {"pictures_found", input.pictures_found}};
  Json items = Json::array(), left = Json::array();
  for (std::size_t i = 0; i < input.items.size(); ++i) {
    const CatalogItem& item = input.items[i];
    Json entry{{"sku", item.sku}, {"status", item.refusal ? "refused" : "convert"}};
    if (!item.product_id.empty()) entry["product_id"] = item.product_id;
    entry["line"] = item.line;
    entry["title"] = item.title;
    entry["garment"] = item.garment;
    entry["neckline"] = item.neckline;
    entry["fabric"] = item.fabric;
    entry["front"] = item.front;
    entry["back"] = item.back;
    entry["mirror_back"] = item.mirror_back;
    if (!item.front_mask.empty()) entry["front_mask"] = item.front_mask;
    if (!item.back_mask.empty()) entry["back_mask"] = item.back_mask;
    if (item.chest_cm) entry["chest_cm"] = *item.chest_cm;
    if (item.length_cm) entry["length_cm"] = *item.length_cm;
    if (!item.mannequins.empty()) entry["mannequin"] = item.mannequins;
    if (item.refusal) entry["refusal"] = error_json(*item.refusal);
    if (!item.refusal && input.pictures_found)
      if (const auto missing = missing_files(item); !missing.empty()) entry["missing"] = missing;
    if (i < input.plan.size()) {
      const ItemPlan& plan = input.plan[i];
      if (!plan.handle.empty()) entry["handle"] = plan.handle;
      entry["ids"] = plan.ids;
      entry["sizes"] = plan.sizes;
      entry["rules"] = {{"garment", plan.garment_rule},
                        {"neckline", plan.neckline_rule},
                        {"fabric", plan.fabric_rule},
                        {"front", plan.front_rule},
                        {"back", plan.back_rule}};
      Json pictures = Json::array();
      for (const PicturePlan& p : plan.pictures)
        pictures.push_back(
            {{"source", p.source}, {"position", p.position}, {"alt", p.alt}, {"role", p.role}, {"rule", p.rule}});
      entry["pictures"] = std::move(pictures);
      entry["notes"] = plan.notes;
    }
    items.push_back(std::move(entry));
  }
  for (const LeftOut& product : input.left_out)
    left.push_back({{"id", product.id}, {"line", product.line}, {"reason", product.reason}});
  all["items"] = std::move(items);
  all["left_out"] = std::move(left);
  all["warnings"] = input.warnings;
  return all.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vitrine
