// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine::showroom {

/// A mannequin that items are worn by.
struct WornBody {
  std::string sex;             ///< "woman", "man" or empty
  std::string label;           ///< folder of a size run, or the mannequin's source
  std::array<double, 8> cm{};  ///< [cm] in the order of body_measures; all 0: not told
  bool operator==(const WornBody&) const = default;
};
constexpr const char* body_measures[] = {"height", "bust",       "under_bust", "waist",
                                         "hip",    "inside_leg", "arm",        "neck_base"};

/// A length of the garment lying flat, between two named points of the front photo.
struct FlatMeasure {
  std::string name;
  double cm = 0;
};

/// An item on one mannequin.
struct Look {
  std::string size;              ///< name of its folder in a size run, else empty
  std::filesystem::path folder;  ///< with dressed.glb
  int body = -1;                 ///< index of its WornBody
  std::string fabric;
  std::vector<FlatMeasure> flat;
};

/// What an outfit can be put together of.
enum class Part { none, top, bottom };

struct ShownItem {
  std::string sku, garment, title, neckline;
  std::vector<std::string> colours;  ///< families, the commonest first; at most two
  Part part = Part::none;
  std::string front, back;  ///< photo files as the report names them; back may be empty
  std::vector<Look> looks;  ///< at least one
};

struct ShownCatalogue {
  std::vector<ShownItem> items;  ///< in the report's order
  std::vector<WornBody> bodies;
  std::vector<std::string> warnings;
};

/// Items that are ok or partly so, from report.jsonl and the report.json of each look.
Result<ShownCatalogue> read_catalogue(const std::filesystem::path& folder);

/// A text of a stranger made fit to be shown: valid UTF-8, one line, without characters that turn the direction of what
/// follows, at most `most` code points (then with an ellipsis).
std::string shown_text(const std::string& text, std::size_t most);

}  // namespace vitrine::showroom
