// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "pages.hpp"
#include "pictures.hpp"
#include "vitrine/escaped.hpp"
#include "vitrine/export.hpp"
#include "vitrine/showroom.hpp"

namespace vitrine {
namespace {

using namespace showroom;
namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* mark = "showroom.json";  // tells a site of ours from a folder of somebody's
constexpr std::size_t cards_in_page = 24, cards_in_chunk = 200, eager_cards = 6;
constexpr std::uintmax_t most_model = 64u << 20;  // [byte]

Error cannot_write(const fs::path& place, const std::string& why) {
  return {Cause::unwritable, "SITE_DIR", place.string() + " cannot be written: " + why,
          "make room on the disk, or name a folder with --out that you may write to", "showroom"};
}

Result<std::string> read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in)
    return Error{Cause::missing, "SHOWROOM_ASSETS", file.string() + ": the show room's pages are not there",
                 "build with npm and VITRINE_SHOWROOM=ON, or install Vitrine anew", "showroom"};
  return text.str();
}

/// The same file under a second name where the disk can do that, else a copy.
std::optional<Error> link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::create_hard_link(from, to, failed);
  if (failed) fs::copy_file(from, to, failed);
  if (failed) return cannot_write(to, failed.message());
  return std::nullopt;
}

class Site {
 public:
  Site(const ShowroomOptions& options, fs::path root) : options_(options), root_(std::move(root)) {}

  std::optional<Error> write(const ShownCatalogue& all, ShowroomSummary& summary) {
    if (auto e = copy_assets()) return e;
    for (const ShownItem& item : all.items)
      if (auto e = write_item(item, all, summary)) return e;
    if (auto e = write_lists(all)) return e;
    summary.items = static_cast<int>(all.items.size());
    summary.mannequins = static_cast<int>(all.bodies.size());
    for (const ShownItem& item : all.items) {
      summary.outfit_tops += item.part == Part::top;
      summary.outfit_bottoms += item.part == Part::bottom;
    }
    return std::nullopt;
  }

 private:
  std::optional<Error> copy_assets() {
    std::error_code failed;
    for (const char* part : {"app", "vendor"}) {
      if (!fs::is_directory(fs::path(options_.assets) / part, failed)) {
        const auto missing = read_text(fs::path(options_.assets) / part);
        return missing ? cannot_write(root_, "no assets") : missing.error();
      }
      fs::copy(fs::path(options_.assets) / part, root_ / part, fs::copy_options::recursive, failed);
      if (failed) return cannot_write(root_ / part, failed.message());
    }
    return std::nullopt;
  }

  /// A page from its template, with what all pages have filled in.
  std::optional<Error> page(const char* source, const fs::path& place, const std::function<void(Page&)>& fill) {
    const auto text = read_text(fs::path(options_.assets) / "templates" / source);
    if (!text) return text.error();
    Page page(*text);
    page.text("lang", options_.language).text("shop", options_.title);
    fill(page);
    const auto done = page.done();
    if (!done) return done.error();
    return write_file((root_ / place).string(), *done);
  }

  std::optional<Error> write_item(const ShownItem& item, const ShownCatalogue& all, ShowroomSummary& summary) {
    const fs::path folder = root_ / "item" / item.sku;
    std::error_code failed;
    for (const Look& look : item.looks) {
      const fs::path place = look.size.empty() ? folder : folder / look.size;
      fs::create_directories(place, failed);
      if (failed) return cannot_write(place, failed.message());
      for (const char* file : {"dressed.glb", "garment.glb"})
        if (auto e = link_or_copy(look.folder / file, place / file)) return e;
      if (auto e = write_page_copy(look, place)) return e;
      if (auto e = write_poster(look.folder / "preview.png", place / "poster.webp", 600, 82)) return e;
    }
    if (auto e = write_poster(item.looks.front().folder / "preview.png", folder / "card.webp", 300, 72)) return e;
    const bool front = write_side(item, item.front, folder / "front.jpg", summary);
    const bool back = write_side(item, item.back, folder / "back.jpg", summary);

    const std::string title = shown_text(item.title, 120);
    const std::string poster = place_in_item(item.looks.front(), "poster.webp");
    const auto common = [&](Page& p) {
      p.text("title", title)
          .text("alt", alt_of(item))
          .html("poster", poster)
          .html("data", json_for_page(item_json(item, all.bodies)));
    };
    if (auto e = page("item.html", fs::path("item") / item.sku / "index.html", [&](Page& p) {
          common(p);
          p.text("heading", item.title).text("sku", item.sku).html("facts", facts_html(item));
          p.html("photos", photos_html(item, front, back)).html("sizes", sizes_html(item));
          p.html("outfit", item.part == Part::none ? std::string()
                                                   : "<a class=\"button\" href=\"../../outfits.html#" +
                                                         std::string(item.part == Part::top ? "top=" : "bottom=") +
                                                         item.sku + "\">Wear it with…</a>");
        }))
      return e;
    return page("embed.html", fs::path("item") / item.sku / "embed.html", common);
  }

  static std::string sizes_html(const ShownItem& item) {
    if (item.looks.size() < 2) return "";
    std::string html = "<fieldset class=\"sizes\"><legend>Size</legend>\n";
    for (std::size_t i = 0; i < item.looks.size(); ++i)
      html += "<label><input type=\"radio\" name=\"size\" value=\"" + std::to_string(i) + "\"" +
              (i == 0 ? " checked" : "") + "><span>" + escaped(size_label(item.looks[i].size)) + "</span></label>\n";
    return html + "</fieldset>\n";
  }

  /// "woman-m" is "M" to a shopper.
  static std::string size_label(const std::string& size) {
    for (const char* sex : {"woman-", "man-"})
      if (size.rfind(sex, 0) == 0) {
        std::string label = size.substr(std::string(sex).size());
        std::transform(label.begin(), label.end(), label.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        return label;
      }
    return size;
  }

  static std::optional<Error> write_page_copy(const Look& look, const fs::path& place) {
    std::error_code failed;
    if (fs::is_regular_file(fs::symlink_status(look.folder / "dressed-page.glb", failed)))
      return link_or_copy(look.folder / "dressed-page.glb", place / "dressed-page.glb");
    const std::uintmax_t size = fs::file_size(look.folder / "dressed.glb", failed);
    if (failed || size > most_model) return cannot_write(place, "dressed.glb is larger than 64 MB");
    std::ifstream in(look.folder / "dressed.glb", std::ios::binary);
    Bytes glb(size);
    in.read(reinterpret_cast<char*>(glb.data()), static_cast<std::streamsize>(size));
    const auto small = compress_glb(glb);
    if (!small) return small.error();
    return write_file((place / "dressed-page.glb").string(), *small);
  }

  /// Whether there is a photo to be shown; a lost one is no reason to do without the item.
  bool write_side(const ShownItem& item, const std::string& named, const fs::path& out,
                  ShowroomSummary& summary) const {
    if (named.empty()) return false;
    fs::path photo(named);
    if (photo.is_relative() && !options_.photo_root.empty()) photo = fs::path(options_.photo_root) / photo;
    const auto failed = write_photo(photo, out);
    if (failed) summary.warnings.push_back(item.sku + ": shown without a photo, " + failed->message);
    return !failed;
  }

  std::optional<Error> write_lists(const ShownCatalogue& all) {
    std::error_code failed;
    fs::create_directories(root_ / "data", failed);
    std::map<std::string, int> types, necklines, colours;
    std::string cards, links;
    for (std::size_t i = 0; i < all.items.size(); ++i) {
      const ShownItem& item = all.items[i];
      ++types[item.garment];
      if (!item.neckline.empty()) ++necklines[item.neckline];
      for (const std::string& colour : item.colours) ++colours[colour];
      if (i < cards_in_page) cards += card_html(item, i < eager_cards);
      links += "<li><a href=\"item/" + item.sku + "/index.html\" dir=\"auto\">" + escaped(shown_text(item.title, 120)) +
               "</a></li>\n";
    }
    const std::size_t chunks = (all.items.size() + cards_in_chunk - 1) / cards_in_chunk;
    for (std::size_t c = 0; c < chunks; ++c) {
      Json list = Json::array();
      for (std::size_t i = c * cards_in_chunk; i < std::min(all.items.size(), (c + 1) * cards_in_chunk); ++i)
        list.push_back(card_json(all.items[i]));
      if (auto e =
              write_file((root_ / "data" / ("items-" + std::to_string(c) + ".json")).string(), json_for_page(list)))
        return e;
    }
    const std::string count = std::to_string(all.items.size());
    if (auto e = write_file((root_ / "data/outfits.json").string(), json_for_page(outfits_json(all)))) return e;
    if (auto e = page("index.html", "index.html", [&](Page& p) {
          p.html("cards", cards).html("count", count).html("chunks", std::to_string(chunks));
          p.html("types", options_html(types)).html("necklines", options_html(necklines));
          p.html("colours", options_html(colours));
        }))
      return e;
    if (auto e = page("all.html", "all.html", [&](Page& p) { p.html("links", links).html("count", count); })) return e;
    if (auto e = page("outfits.html", "outfits.html", [](Page&) {})) return e;
    if (auto e =
            page("size.html", "size.html", [&](Page& p) { p.html("data", json_for_page(bodies_json(all.bodies))); }))
      return e;
    return write_file((root_ / mark).string(), "{\"generator\":\"vitrine showroom\",\"items\":" + count + "}\n");
  }

  const ShowroomOptions& options_;
  fs::path root_;
};

/// Whether the folder may be replaced: not there, empty, or a site of ours.
bool replaceable(const fs::path& out) {
  std::error_code failed;
  if (!fs::exists(fs::symlink_status(out, failed))) return true;
  if (!fs::is_directory(fs::symlink_status(out, failed))) return false;
  return fs::is_empty(out, failed) || fs::is_regular_file(out / mark, failed);
}

/// The new site in the old one's place. Where the file system cannot exchange two names, there is none for a moment.
std::optional<Error> put_in_place(const fs::path& fresh, const fs::path& out) {
  std::error_code failed;
  if (fs::exists(out, failed)) {
    if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, out.c_str(), RENAME_EXCHANGE) == 0) {
      fs::remove_all(fresh, failed);
      return std::nullopt;
    }
    fs::remove_all(out, failed);
    if (failed) return cannot_write(out, failed.message());
  }
  fs::rename(fresh, out, failed);
  if (failed) return cannot_write(out, failed.message());
  return std::nullopt;
}

}  // namespace

Result<ShowroomSummary> make_showroom(const ShowroomOptions& options) {
  fs::path out = fs::absolute(options.out).lexically_normal();
  if (out.filename().empty()) out = out.parent_path();
  if (!replaceable(out))
    return Error{Cause::usage, "SITE_FOLDER", out.string() + " holds something that is no show room of Vitrine's",
                 "name a new folder with --out, or remove what is there", "showroom"};
  const auto catalogue = fs::weakly_canonical(options.catalogue);
  if (catalogue == fs::weakly_canonical(out))
    return Error{Cause::usage, "SITE_FOLDER", "the site's folder is the catalogue's", "name another with --out",
                 "showroom"};
  auto all = read_catalogue(options.catalogue);
  if (!all) return all.error();
  const fs::path fresh = out.parent_path() / ("." + out.filename().string() + ".partial");
  std::error_code failed;
  fs::remove_all(fresh, failed);
  fs::create_directories(fresh, failed);
  if (failed) return cannot_write(fresh, failed.message());
  ShowroomSummary summary;
  summary.warnings = all->warnings;
  auto error = Site(options, fresh).write(*all, summary);
  if (!error) error = put_in_place(fresh, out);
  if (error) {
    fs::remove_all(fresh, failed);
    return *error;
  }
  return summary;
}

}  // namespace vitrine
