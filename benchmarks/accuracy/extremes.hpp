// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "dressing.hpp"

namespace vitrine::bench {

/// The cases, group by group. What they share is made once; each body runs apart.
class Extremes {
 public:
  using Take = std::function<void(const std::string& group, const std::string& name, const std::function<Outcome()>&)>;

  /// Draws its photos into `folder`; `meshes` may be empty or missing.
  Extremes(std::string folder, std::string meshes);
  void each_case(const Take& take) const;

 private:
  void constants(const Take& take) const;   ///< the paper's k and m, and that only their ratio decides
  void sheets(const Take& take) const;      ///< stretch, bend, mass, friction, gravity, residual
  void meshes(const Take& take) const;      ///< nodes and voxels
  void mannequins(const Take& take) const;  ///< built and imported bodies
  void photos(const Take& take) const;

  std::string folder_, mesh_folder_;
  PluginRegistry registry_;
  std::shared_ptr<const Body> woman_;
  SeenGarment vest_, sleeves_, trousers_;
};

}  // namespace vitrine::bench
