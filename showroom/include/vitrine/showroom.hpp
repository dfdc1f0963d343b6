// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine {

/// A static site made of a finished catalogue (docs/SHOWROOM.md).
struct ShowroomOptions {
  std::string catalogue;   ///< folder with report.jsonl and the items' folders
  std::string out;         ///< folder of the site; made anew in one step
  std::string assets;      ///< folder with templates/, app/ and vendor/, as installed
  std::string photo_root;  ///< where photos with relative paths lie; empty = the current folder
  std::string title = "Show room";
  std::string language = "en";  ///< BCP 47 tag of the titles, for the pages' lang attribute
};

struct ShowroomSummary {
  int items = 0, outfit_tops = 0, outfit_bottoms = 0, mannequins = 0;
  std::vector<std::string> warnings;  ///< what was left out and why, one sentence each
};

/// Writes the site beside `out` under a temporary name and puts it in place by renaming: a half-written site is never
/// seen. The same catalogue gives the same bytes. Files of an earlier site are gone afterwards; a folder that holds
/// something else is not touched. Errors: missing (66: NO_CATALOGUE, SHOWROOM_ASSETS), unusable (65: REPORT_LINE,
/// EMPTY_CATALOGUE), usage (64: SITE_FOLDER), unwritable (73: SITE_DIR).
Result<ShowroomSummary> make_showroom(const ShowroomOptions& options);

struct ServeOptions {
  std::string site;
  int port = 0;  ///< 0: a free one
};

/// Shows the folder's files on 127.0.0.1 until `stop` says so (asked ten times a second). Only GET and HEAD, only
/// files inside the folder, links are not followed out of it. `ready` is told the port. Errors: missing (66: NO_SITE),
/// unwritable (73: PORT).
Result<int> serve_site(const ServeOptions& options, const std::function<void(int port)>& ready,
                       const std::function<bool()>& stop);

}  // namespace vitrine
