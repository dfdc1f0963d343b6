// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "../input/csv.hpp"
#include "../input/text.hpp"
#include "../report_files.hpp"
#include "model_file.hpp"
#include "vitrine/catalog_feed.hpp"

namespace vitrine {
namespace {

using feed::ItemFolder;
using feed::ModelFile;
using Json = nlohmann::ordered_json;

constexpr std::size_t max_url = 2000;
constexpr double mega = 1024.0 * 1024.0;

/// What is told of an item: from the input where it was given.
struct Told {
  std::string title, handle, alt;
  std::vector<std::string> ids, sizes;
};

/// RFC 3986: all but unreserved characters and the slashes between parts are codes.
std::string percent_encoded(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '.' || c == '_' || c == '~' || c == '/';
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += plain ? std::string(1, c) : std::string(code);
  }
  return out;
}

/// Merchant Center's text format knows no line breaks or tabs inside a field; quotes as in CSV.
std::string tsv_field(const std::string& text) {
  return csv::quoted(input::one_line(text, 4096), '\t');
}

std::map<std::string, Told> told_by(const CatalogInput* input) {
  std::map<std::string, Told> all;
  if (input == nullptr) return all;
  for (std::size_t i = 0; i < input->items.size(); ++i) {
    const CatalogItem& item = input->items[i];
    Told& told = all[item.sku];
    told.title = input::one_line(item.title, 1000);
    if (i < input->plan.size()) {
      told.handle = input->plan[i].handle;
      told.ids = input->plan[i].ids;
      told.sizes = input->plan[i].sizes;
    }
    if (told.handle.empty()) told.handle = item.product_id.empty() ? item.sku : item.product_id;
  }
  return all;
}

Told told_of(const ItemFolder& item, const std::map<std::string, Told>& known) {
  const auto found = known.find(item.sku);
  Told told = found == known.end() ? Told{} : found->second;
  if (told.title.empty()) told.title = item.sku;
  if (told.handle.empty()) told.handle = item.sku;
  if (told.ids.empty()) told.ids = {item.sku};
  // Shopify and Merchant Center take 512 characters and fewer; screen readers want a phrase.
  told.alt = input::shortened(told.title, 400) + ", 3D model";
  return told;
}

/// The model that is linked: of the item itself, else of the first size.
const ModelFile* linked(const ItemFolder& item, const std::string& name) {
  for (const bool sized : {false, true})
    for (const ModelFile& model : item.models)
      if (model.name == name && model.size.empty() != sized) return &model;
  return nullptr;
}

double millimetres(double metres) {
  return std::round(metres * 1e4) / 10;
}

std::string joined_url(const std::string& base, const std::string& path) {
  return base.empty() ? "" : base + (base.back() == '/' ? "" : "/") + percent_encoded(path);
}

Json item_json(const ItemFolder& item, const Told& told, const FeedOptions& options) {
  Json entry{{"sku", item.sku}, {"ids", told.ids}, {"title", told.title}, {"alt", told.alt}, {"sizes", told.sizes}};
  if (!item.poster.empty()) {
    Json poster{{"path", item.poster}, {"bytes", item.poster_bytes}};
    if (!options.base_url.empty()) poster["url"] = joined_url(options.base_url, item.poster);
    entry["poster"] = std::move(poster);
  }
  Json models = Json::array();
  for (const ModelFile& model : item.models) {
    Json m{{"name", model.name}, {"path", model.path}};
    if (!options.base_url.empty()) m["url"] = joined_url(options.base_url, model.path);
    if (!model.size.empty()) m["mannequin"] = model.size;
    m["bytes"] = model.bytes;
    m["sha256"] = model.sha256;
    m["width_mm"] = millimetres(model.high[0] - model.low[0]);
    m["height_mm"] = millimetres(model.high[1] - model.low[1]);
    m["depth_mm"] = millimetres(model.high[2] - model.low[2]);
    models.push_back(std::move(m));
  }
  entry["models"] = std::move(models);
  return entry;
}

/// The limits of the platform; true when the item may go in.
bool keep(const ModelFile& model, const std::string& url, const FeedOptions& options, Feed& feed) {
  const double size = static_cast<double>(model.bytes) / mega;
  const bool google = options.platform == FeedPlatform::google;
  const double most = google ? 15 : 500, advised = google ? 10 : 15;
  const char* who = google ? "Google" : "Shopify";
  char mb[32];
  std::snprintf(mb, sizeof mb, "%.1f", size);
  if (url.size() > max_url) {
    feed.left_out.push_back(
        {Cause::unusable, "URL_TOO_LONG",
         model.path + ": its address has " + std::to_string(url.size()) + " characters, 2000 at most",
         "Publish the folder under a shorter address.", "catalog"});
    return false;
  }
  if (size > most) {
    feed.left_out.push_back({Cause::unusable, "MODEL_TOO_LARGE",
                             model.path + ": it has " + mb + " MB, " + who + " takes " +
                                 std::to_string(static_cast<int>(most)) + " at most",
                             "Convert it with a smaller --texture-size.", "catalog"});
    return false;
  }
  if (size > advised)
    feed.warnings.push_back(model.path + ": it has " + mb + " MB, " + who + " advises " +
                            std::to_string(static_cast<int>(advised)) + " at most");
  return true;
}

std::optional<Error> check(const FeedOptions& options) {
  const std::string& base = options.base_url;
  const bool web = base.rfind("https://", 0) == 0 || base.rfind("http://", 0) == 0;
  const std::string host = web ? base.substr(base.find("://") + 3) : "";
  const bool plain = std::all_of(base.begin(), base.end(), [](char c) { return c > 0x20 && c < 0x7F; }) &&
                     base.find_first_of("\"<>\\^`{|}?#") == std::string::npos;
  const bool optional = options.platform == FeedPlatform::items && base.empty();
  if (!optional && (!web || host.empty() || host[0] == '/' || !plain))
    return Error{Cause::usage, "BASE_URL", "\"" + input::one_line(base, 200) + "\" is not where files can be published",
                 "Give the address of the output folder as --base-url, such as https://shop.example/3d/.", "catalog"};
  if (options.model != "garment" && options.model != "dressed")
    return Error{Cause::usage, "MODEL", "\"" + input::one_line(options.model, 40) + "\" is no model of an item",
                 "Choose garment or dressed.", "catalog"};
  return {};
}

}  // namespace

Result<Feed> make_feed(const std::string& out_dir, const FeedOptions& options) {
  if (auto error = check(options)) return *error;
  Feed feed;
  const Result<std::vector<ItemFolder>> items = feed::scan(out_dir, feed.left_out);
  if (!items) return items.error();
  if (items->empty())
    return Error{Cause::unusable, "NO_MODELS", out_dir + ": no item here has a GLB",
                 "Run vitrine catalog run first, and see its report.", "catalog"};
  const std::map<std::string, Told> known = told_by(options.input);
  const bool xml = options.platform == FeedPlatform::google && options.format == FeedFormat::xml;
  Json list = Json::array();
  if (options.platform == FeedPlatform::shopify)
    feed.text = "URL handle,Media content type,Original source,Alt,Bytes\n";
  else if (xml)
    feed.text =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<rss version=\"2.0\" xmlns:g=\"http://base.google.com/ns/1.0\">\n"
        "<channel>\n<title>3D models</title>\n<link>" +
        escaped(options.base_url) + "</link>\n<description>3D models of garments</description>\n";
  else if (options.platform == FeedPlatform::google)
    feed.text = "id\tvirtual_model_link\n";

  for (const ItemFolder& item : *items) {
    const Told told = told_of(item, known);
    if (options.platform == FeedPlatform::items) {
      list.push_back(item_json(item, told, options));
      ++feed.items;
      continue;
    }
    const ModelFile* model = linked(item, options.model);
    if (model == nullptr) {
      feed.left_out.push_back({Cause::unusable, "NO_MODELS", item.sku + ": it has no " + options.model + ".glb",
                               "See the item in the run's report.", "catalog"});
      continue;
    }
    const std::string url = joined_url(options.base_url, model->path);
    if (!keep(*model, url, options, feed)) continue;
    ++feed.items;
    if (options.platform == FeedPlatform::shopify) {
      for (const std::string& field : {told.handle, std::string("MODEL_3D"), url, told.alt})
        feed.text += csv::quoted(field) + ",";
      feed.text += std::to_string(model->bytes) + "\n";
      continue;
    }
    for (const std::string& id : told.ids)
      feed.text += xml ? "<item><g:id>" + escaped(id) + "</g:id><g:virtual_model_link>" + escaped(url) +
                             "</g:virtual_model_link></item>\n"
                       : tsv_field(id) + "\t" + tsv_field(url) + "\n";
  }
  if (xml) feed.text += "</channel>\n</rss>\n";
  if (options.platform == FeedPlatform::items)
    feed.text =
        Json{{"vitrine_items", 1}, {"items", std::move(list)}}.dump(1, ' ', false, Json::error_handler_t::replace) +
        "\n";
  return feed;
}

}  // namespace vitrine
