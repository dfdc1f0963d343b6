// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "product.hpp"
#include "vitrine/model/result.hpp"

namespace re2 {
class RE2;
}

namespace vitrine::input {

/// A regular expression (RE2: linear time, whatever the text), not case-sensitive.
using Pattern = std::shared_ptr<const re2::RE2>;
bool found_in(const Pattern& pattern, std::string_view text);

enum class Role { none, front, back, front_mask, back_mask, other };
const char* name_of(Role role);

struct PictureRule {
  std::string name;
  enum class Field { file, alt, position } field = Field::file;
  Pattern match;     ///< of file and alt
  int position = 0;  ///< of position
  Role role = Role::none;
};

/// A text of the product names a garment, neckline or fabric.
struct TextRule {
  std::string name;
  Pattern match;
  Pattern with;                       ///< of a garment, may be missing: found in any of the texts as well
  std::string value;                  ///< empty for a garment: the product is left out
  std::vector<std::string> garments;  ///< only of these; empty = of all
};

struct MeasureRule {
  std::string name;
  bool chest = true;   ///< or length
  std::string column;  ///< name of the feed's column, normalised; or empty: look in the description
  Pattern match;       ///< group 1 is the number, group 2 (may be missing) the unit
  double unit_cm = 1;  ///< [cm] where the text names no unit
};

/// How products become items. Lists are tried in their order; the first that matches decides.
struct Rules {
  std::map<std::string, std::string, std::less<>> columns;  ///< the feed's name of a column, normalised → ours
  std::vector<Pattern> tails;  ///< what platforms add to file names, cut off before matching
  /// Groups of picture rules, from the surest to a guess.
  std::vector<std::vector<PictureRule>> pictures;
  std::vector<TextRule> garments, necklines, fabrics;
  std::vector<MeasureRule> measures;
  std::string default_garment;
  bool refuse_no_garment = false;  ///< else products without a garment are left out
  bool mirror_missing_back = false;
  std::vector<std::string> left_out_status{};
  std::vector<std::string> mannequins;
  bool mannequins_from_sizes = false;
};

/// Reads a rules file on top of the built-in rules: a key that it has replaces the built-in one. Empty path: the
/// built-in rules. Errors: MANIFEST_MISSING (66), RULES (65) naming the key.
Result<Rules> read_rules(const std::string& path);
Result<Rules> parse_rules(std::string_view text, const std::string& file);

/// Name of a column without case, underscores, blanks at the ends and Google's "g:".
std::string plain_column(std::string_view name);

/// Decides about the pictures; fills `role` and `rule` of each, in the order of the pictures.
std::vector<PicturePlan> choose_pictures(const Product& product, const Rules& rules);
/// A picture's file name without folders, extension and platform tails.
std::string stem_of(std::string_view source, const Rules& rules);
/// The words of a picture's file name without extension, platform tails and the product's own name.
std::string file_words(std::string_view source, const Product& product, const Rules& rules);

class ImageRoot;
/// The product as an item; nullopt with `left_out` set where it is no garment. `root` may be null: pictures keep the
/// names that the feed has.
std::optional<CatalogItem> make_item(const Product& product, const Rules& rules, const ImageRoot* root,
                                     const std::string& file, ItemPlan& plan, std::string& left_out);

}  // namespace vitrine::input
