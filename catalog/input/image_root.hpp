// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "vitrine/model/result.hpp"

namespace vitrine::input {

/// Whether the name ends like a picture that the photo room reads.
bool is_picture(std::string_view name);

/// The files below a folder, listed once. A feed's URL or path is only ever compared with this list, so it cannot lead
/// anywhere else, however it is written. Folders that are links are not entered; a file that is a link is listed when
/// it ends below the root, as the file it stands for.
class ImageRoot {
 public:
  /// Errors: IMAGE_ROOT (66), IMAGE_ROOT_TOO_LARGE (65) beyond 2,000,000 files; folders deeper than 32 are not entered.
  static Result<ImageRoot> open(const std::string& folder);

  struct Found {
    std::string file;  ///< empty where there is none
    std::string why;   ///< then: the reason
  };
  /// The file for a URL or path: its whole path below the root, else the longest tail of it that is there, else the
  /// only file anywhere below with its name.
  Found find(std::string_view source) const;

  const std::string& folder() const { return folder_; }
  /// Paths below the root, in the order of their bytes.
  std::vector<std::string> files() const;

 private:
  std::string folder_;
  std::unordered_map<std::string, std::string> files_;      ///< path below the root → file; empty: below it as named
  std::unordered_map<std::string, std::string> only_name_;  ///< file name → path below the root; empty: several
};

/// The path of a URL or of a file name in its parts: without scheme, host, query and fragment, percent codes decoded.
/// Empty where it has a part that is "..", empty or has a control character.
std::vector<std::string> path_parts(std::string_view source);

}  // namespace vitrine::input
