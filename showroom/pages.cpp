// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages.hpp"

#include <cstdio>

#include "vitrine/escaped.hpp"

namespace vitrine::showroom {
namespace {

using Json = nlohmann::json;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string kind_of(const ShownItem& item) {
  return spoken(item.garment) + (item.neckline.empty() ? "" : " · " + spoken(item.neckline));
}

std::string centimetres(double cm) {
  char text[32];
  std::snprintf(text, sizeof text, "%g cm", cm);
  return text;
}

std::string row(const std::string& name, const std::string& value, const std::string& attribute = "") {
  return "<div><dt>" + escaped(name) + "</dt><dd" + attribute + ">" + escaped(value) + "</dd></div>\n";
}

}  // namespace

Page& Page::text(const std::string& name, const std::string& value) {
  return html(name, escaped(value));
}

Page& Page::html(const std::string& name, std::string value) {
  values_[name] = std::move(value);
  return *this;
}

Result<std::string> Page::done() const {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t open = source_.find("{{", at), close = source_.find("}}", open);
    if (open == std::string::npos || close == std::string::npos) return out + source_.substr(at);
    const std::string name = source_.substr(open + 2, close - open - 2);
    const auto found = values_.find(name);
    if (found == values_.end())
      return Error{Cause::unusable, "SHOWROOM_ASSETS", "a page of the show room asks for \"" + name + "\"",
                   "install Vitrine anew: program and pages are of different versions", "showroom"};
    out += source_.substr(at, open - at) + found->second;
    at = close + 2;
  }
}

std::string json_for_page(const Json& json) {
  std::string out;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<' || c == '>' || c == '&' || c == '\'') {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      out += code;
    } else {
      out += c;
    }
  }
  return out;
}

std::string spoken(const std::string& id) {
  std::string words = id;
  if (id.rfind("neck_", 0) == 0) words = id.substr(5) + " neck";
  if (id == "t_shirt") words = "T-shirt";
  for (char& c : words)
    if (c == '_') c = ' ';
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

std::string place_in_item(const Look& look, const std::string& file) {
  return look.size.empty() ? file : look.size + "/" + file;
}

std::string alt_of(const ShownItem& item) {
  return shown_text(item.title, 120) + " (" + spoken(item.garment) + ") on a mannequin";
}

std::string card_html(const ShownItem& item, bool eager) {
  const std::string place = "item/" + item.sku + "/";
  return "<li class=\"card\"><a href=\"" + place + "index.html\"><img src=\"" + place + "card.webp\" alt=\"" +
         escaped(alt_of(item)) + "\" width=\"300\" height=\"400\" " +
         (eager ? "decoding=\"async\"" : "loading=\"lazy\" decoding=\"async\"") +
         "><span class=\"name\" dir=\"auto\">" + escaped(shown_text(item.title, 120)) + "</span><span class=\"kind\">" +
         escaped(kind_of(item)) + "</span></a></li>\n";
}

Json card_json(const ShownItem& item) {
  Json card{{"s", item.sku}, {"t", shown_text(item.title, 120)}, {"g", item.garment}, {"c", item.colours}};
  if (!item.neckline.empty()) card["n"] = item.neckline;
  return card;
}

std::string facts_html(const ShownItem& item) {
  const Look& look = item.looks.front();
  std::string html = row("Type", spoken(item.garment));
  if (!item.neckline.empty()) html += row("Neckline", spoken(item.neckline));
  if (!item.colours.empty()) html += row("Colour", spoken(joined(item.colours)));
  if (!look.fabric.empty()) html += row("Draped as", spoken(look.fabric));
  for (const FlatMeasure& m : look.flat)
    html += row(m.name, centimetres(m.cm), " data-flat=\"" + escaped(m.name) + "\"");
  html += row("Article", item.sku);
  return html;
}

std::string photos_html(const ShownItem& item, bool front, bool back) {
  std::string html;
  const auto add = [&](bool there, const char* file, const char* side) {
    if (there)
      html += std::string("<figure><a href=\"") + file + "\"><img src=\"" + file + "\" alt=\"" +
              escaped(shown_text(item.title, 120)) + ", photo of the " + side +
              "\" loading=\"lazy\" decoding=\"async\"></a><figcaption>" + (side[0] == 'f' ? "Front" : "Back") +
              "</figcaption></figure>\n";
  };
  add(front, "front.jpg", "front");
  add(back, "back.jpg", "back");
  return html;
}

Json item_json(const ShownItem& item, const std::vector<WornBody>& bodies) {
  Json looks = Json::array();
  for (const Look& look : item.looks) {
    Json flat = Json::object();
    for (const FlatMeasure& m : look.flat) flat[m.name] = centimetres(m.cm);
    Json one{{"size", look.size},
             {"model", place_in_item(look, "dressed-page.glb")},
             {"garment", place_in_item(look, "garment.glb")},
             {"poster", place_in_item(look, "poster.webp")},
             {"flat", std::move(flat)}};
    if (look.body >= 0) one["body"] = bodies_json({bodies[static_cast<std::size_t>(look.body)]}).at(0);
    looks.push_back(std::move(one));
  }
  return {{"sku", item.sku}, {"alt", alt_of(item)}, {"looks", std::move(looks)}};
}

std::string options_html(const std::map<std::string, int>& counts) {
  std::string html;
  for (const auto& [id, count] : counts)
    html +=
        "<option value=\"" + escaped(id) + "\">" + escaped(spoken(id)) + " (" + std::to_string(count) + ")</option>";
  return html;
}

Json bodies_json(const std::vector<WornBody>& bodies) {
  Json list = Json::array();
  for (const WornBody& body : bodies) {
    Json one{{"label", body.label}, {"sex", body.sex}};
    if (body.cm[0] > 0) one["cm"] = body.cm;
    list.push_back(std::move(one));
  }
  return list;
}

Json outfits_json(const ShownCatalogue& all) {
  Json tops = Json::array(), bottoms = Json::array();
  for (const ShownItem& item : all.items) {
    if (item.part == Part::none) continue;
    Json looks = Json::array();
    for (const Look& look : item.looks) looks.push_back({look.size, look.body});
    (item.part == Part::top ? tops : bottoms)
        .push_back({{"s", item.sku}, {"t", shown_text(item.title, 120)}, {"a", alt_of(item)}, {"l", std::move(looks)}});
  }
  return {{"bodies", bodies_json(all.bodies)}, {"tops", std::move(tops)}, {"bottoms", std::move(bottoms)}};
}

}  // namespace vitrine::showroom
