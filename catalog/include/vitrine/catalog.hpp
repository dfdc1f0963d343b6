// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// One row of a manifest.
struct CatalogItem {
  std::string sku;      ///< unique; also the name of the item's folder: [A-Za-z0-9._-], not beginning with . or -
  std::string garment;  ///< garment type, e.g. "vest"
  std::string neckline = "auto";  ///< neckline id, or "auto"
  std::string front, back;        ///< photo files; back is empty with mirror_back
  /// Make the back panel from the front's mirrored silhouette, because the shop has no back photo. Each row has either
  /// this or a back photo.
  bool mirror_back = false;
  std::string front_mask, back_mask;  ///< mask files, or empty
  std::optional<double> chest_cm;     ///< [cm] flat width the garment type names: armpit to armpit, a skirt's waist
  std::optional<double> length_cm;    ///< [cm]
  std::string fabric;                 ///< fabric of the garment type, or empty for its default
  std::string title;                  ///< for people
  std::string copyright;              ///< line kept in the item's files, or empty
  int line = 0;                       ///< of the manifest, for messages
  /// Size run: mannequins as --mannequin takes them, or the sizes XS, S, M, L, XL, XXL. Empty = the run's own.
  std::vector<std::string> mannequins;
  std::string product_id;  ///< the shop's own id where that cannot be a folder's name; else empty
  /// Set when a feed's product cannot be converted: it has its place in the reports, but there is nothing to run.
  std::shared_ptr<const Error> refusal;
};

/// Reads a manifest: CSV (RFC 4180: commas, quotes, line breaks in quotes; LF or CRLF; UTF-8 with or without BOM), the
/// first row names the columns. Paths are relative to the manifest's folder. At most 64 MB and 1,000,000 rows.
/// `warnings` receives one sentence per column that is not known; when null they are logged.
/// Errors: missing (66: MANIFEST_MISSING), unusable (65: MANIFEST_TOO_LARGE, MANIFEST_EMPTY, MANIFEST_ENCODING,
/// MANIFEST_CSV, MANIFEST_COLUMN, MANIFEST_VALUE, SKU_UNSAFE, SKU_DUPLICATE), each with file, line and column.
Result<std::vector<CatalogItem>> read_manifest(const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace vitrine
