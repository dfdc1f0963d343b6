// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common.hpp"

namespace vitrine::cli {

/// The mannequins of a catalogue by name, each made when it is first needed, before the worker that needs it is forked.
/// A name is what --mannequin takes, or a size: XS, S, M, L, XL, XXL of the sex that --sex says (woman).
class MannequinShelf {
 public:
  static constexpr std::size_t most = 64;  ///< different ones in a run; each holds some 50 MB

  explicit MannequinShelf(const MannequinOptions& options) : options_(options) {}

  /// Text that changes whenever the mannequin's shape or name would: its measurements or its file's content.
  const std::string& identity(const std::string& name);
  /// Makes it, if that was not done. Error: what makes it impossible; the same at every call.
  Result<std::shared_ptr<const Body>> make(const std::string& name);
  /// "XS" for size XS, else the name or file name without its ending: a folder's name.
  static std::string folder_of(const std::string& name);
  /// Error: USAGE when two mannequins of a size run would share a folder, or a name makes none.
  static std::optional<Error> check_run(const std::vector<std::string>& names);

 private:
  MannequinOptions named(const std::string& name) const;

  const MannequinOptions& options_;
  std::map<std::string, std::string> identities_;
  std::map<std::string, Result<std::shared_ptr<const Body>>> bodies_;
};

/// SHA-256 [hex] of a file's content, or empty.
std::string hash_of_file(const std::string& path);

}  // namespace vitrine::cli
