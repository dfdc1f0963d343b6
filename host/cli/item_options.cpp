// SPDX-License-Identifier: GPL-3.0-or-later
#include "item_options.hpp"

#include "common.hpp"

namespace vitrine::cli {

void ItemOptions::add_to(CLI::App& app, bool required) {
  app.add_option("--front", request.front, "Front photo")->required(required);
  app.add_option("--back", request.back, "Back photo");
  app.add_flag("--mirror-back", request.mirror_back, "Make the back from the mirrored front silhouette");
  app.add_option("--garment", garment, "Garment type (vitrine plugin list shows them)")->required(required);
  app.add_option("--neckline", neckline, "auto or the id of a neckline")->capture_default_str();
  app.add_option("--fabric", request.fabric, "One of the garment's fabrics; its first when left out");
  app.add_option("--spring-k", request.spring_k,
                 "The paper's k [N/m] of every spring of the last mesh, in place of the fabric's sheet stiffness")
      ->check(CLI::PositiveNumber);
  app.add_option("--node-mass", request.node_mass,
                 "The paper's m [kg] of every node of the last mesh, in place of the fabric's weight by area")
      ->check(CLI::PositiveNumber);
  app.add_option("--front-mask", request.front_mask, "8-bit mask: 0 background, 128 inside of the back, 255 garment");
  app.add_option("--back-mask", request.back_mask, "The same for the back photo");
  app.add_option("--chest-cm", chest_cm, "Flat width, armpit to armpit (skirts: waist), in cm")
      ->check(CLI::Range(5.0, 300.0));
  app.add_option("--length-cm", length_cm, "Flat length from top to hem, in cm")->check(CLI::Range(5.0, 300.0));
  app.add_option("--name", request.name, "Name or SKU, kept in the files")->capture_default_str();
}

std::optional<Error> ItemOptions::check() const {
  if (request.back.empty() && !request.mirror_back)
    return usage("a back photo is missing", "give --back FILE, or --mirror-back when the shop has none");
  if (!request.back.empty() && request.mirror_back)
    return usage("--back and --mirror-back exclude each other", "leave one out");
  if (!request.back_mask.empty() && request.mirror_back)
    return usage("--back-mask and --mirror-back exclude each other", "leave one out");
  return std::nullopt;
}

Result<ConvertRequest> ItemOptions::apply(const PluginRegistry& registry) const {
  ConvertRequest out = request;
  if (auto e = choose_garment(registry, garment, neckline, out)) return *e;
  out.chest = chest_cm / 100;
  out.length = length_cm / 100;
  return out;
}

}  // namespace vitrine::cli
