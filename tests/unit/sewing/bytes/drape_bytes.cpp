// SPDX-License-Identifier: GPL-3.0-or-later
// Prints every byte that a few drapes come to, as hashes. Built twice, as released and plainly (no optimisation to
// speak of, no AVX2): a test compares what both print.
#include <cstdio>
#include <cstring>

#include "scene.hpp"
#include "vitrine/sewing.hpp"

int main() {
  using namespace vitrine;
  for (const auto& [name, outline] : {std::pair{"vest", scene::vest()}, std::pair{"long_sleeve", scene::long_sleeve()},
                                      std::pair{"skirt", scene::skirt()}}) {
    std::vector<Pattern> levels;
    for (const double edge : {0.06, 0.04}) levels.push_back(scene::make_pattern(outline, edge));
    SewingOptions options;
    options.residual = 1e-2;
    const auto drape =
        sew_and_drape(levels, scene::place_flat(levels.front(), 0.16), scene::cotton(), scene::woman(), options);
    if (!drape) return 1;
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const auto& panel : drape->positions)
      for (const Vec3& p : panel) {
        unsigned char bytes[sizeof(Vec3)];
        std::memcpy(bytes, p.data(), sizeof bytes);
        for (const unsigned char b : bytes) hash = (hash ^ b) * 1099511628211u;
      }
    std::printf("%s %s %d steps %016llx\n", name, drape->status.c_str(), drape->levels.back().iterations,
                static_cast<unsigned long long>(hash));
  }
  return 0;
}
