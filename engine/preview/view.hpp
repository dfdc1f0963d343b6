// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "camera.hpp"
#include "texture_lookup.hpp"
#include "vitrine/preview.hpp"
#include "vitrine/rays.hpp"

namespace vitrine {

/// One view of the subject, drawn into `picture` (RGB, or RGBA without a ground) from column `left` on.
void draw_view(std::span<const RenderMesh> meshes, std::span<const TextureLookup> textures, const Tracer& tracer,
               const Framing& framing, const Camera& camera, const PreviewOptions& options, Image& picture, int left);

}  // namespace vitrine
