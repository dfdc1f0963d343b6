// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise.hpp"
#include "photo_maker.hpp"

namespace vitrine::support {
namespace {

double distance(const Rgb& a, const Rgb& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Rgb random_colour(Dice& dice) {
  return {dice.range(20, 240), dice.range(20, 240), dice.range(20, 240)};
}

}  // namespace

double contrast(const PhotoSpec& spec) {
  double least = distance(spec.board, spec.colour);
  if (spec.rib > 0 || has_waist(spec.garment)) least = std::min(least, distance(spec.board, spec.trim));
  if (spec.fabric != Fabric2d::plain) least = std::min(least, distance(spec.board, spec.second));
  if (spec.fabric == Fabric2d::floral) least = std::min(least, distance(spec.board, spec.third));
  return least;
}

const char* id_of(GarmentKind kind) {
  switch (kind) {
    case GarmentKind::vest:
      return "vest";
    case GarmentKind::long_sleeve:
      return "long_sleeve";
    case GarmentKind::skirt:
      return "skirt";
    case GarmentKind::t_shirt:
      return "t_shirt";
    case GarmentKind::dress:
      return "dress";
    case GarmentKind::trousers:
      return "trousers";
    case GarmentKind::shorts:
      return "shorts";
  }
  return "";
}

const char* id_of(NeckKind kind) {
  switch (kind) {
    case NeckKind::u:
      return "neck_u";
    case NeckKind::v:
      return "neck_v";
    case NeckKind::square:
      return "neck_square";
    case NeckKind::boat:
      return "neck_boat";
  }
  return "";
}

PhotoSpec random_spec(std::uint32_t seed, GarmentKind garment) {
  Dice dice(seed * 3 + static_cast<std::uint32_t>(garment));
  PhotoSpec s;
  s.garment = garment;
  s.seed = seed;
  // Boat necks are sold on T-shirts and dresses.
  s.neck = static_cast<NeckKind>(dice.pick(garment == GarmentKind::t_shirt || garment == GarmentKind::dress ? 4 : 3));
  if (garment == GarmentKind::vest) {
    s.neck_half = dice.range(6.5, 10);
    s.shoulder_half = s.neck_half + dice.range(3, 8);
    s.neck_depth = dice.range(9, 19);
    s.armhole_depth = dice.range(19, 25);
    s.chest = std::max(dice.range(38, 56), 2 * s.shoulder_half + 5);
    s.hem = s.chest * dice.range(0.94, 1.2);
    s.length = dice.range(50, 72);
    s.rib = dice.pick(3) == 0 ? 0 : dice.range(1, 2.2);
  } else if (garment == GarmentKind::long_sleeve) {
    s.neck_half = dice.range(7.5, 11);
    s.chest = dice.range(43, 56);
    s.shoulder_half = s.chest * dice.range(0.41, 0.45);
    s.shoulder_drop = dice.range(2.5, 4.5);
    s.neck_depth = dice.range(7, 15);
    s.armhole_depth = s.shoulder_drop + s.chest * dice.range(0.39, 0.43);
    s.hem = s.chest * dice.range(0.92, 1.05);
    s.length = dice.range(56, 70);
    s.sleeve_length = s.armhole_depth - s.shoulder_drop + dice.range(39, 43);
    s.sleeve_angle = dice.range(26, 34);
    s.sleeve_width = s.chest * dice.range(0.34, 0.37);
    s.cuff_width = s.chest * dice.range(0.19, 0.21);
    s.hem_rib = dice.pick(2) == 0 ? 0 : dice.range(4, 7);
  } else if (has_legs(garment)) {
    const bool shorts = garment == GarmentKind::shorts;
    s.chest = dice.range(33, 46);
    s.hip = s.chest * dice.range(1.12, 1.3);
    s.rise = s.chest * dice.range(0.58, 0.75);
    s.hip_depth = s.rise * dice.range(0.6, 0.75);
    const double cut = dice.unit();  // from tapered over straight to wide
    s.hem = s.hip / 2 * (shorts ? 0.95 + 0.35 * cut : 0.5 + 0.8 * cut);
    s.length = s.rise + (shorts ? dice.range(5, 28) : s.chest * dice.range(1.35, 2.1));
    s.leg_angle = shorts ? dice.range(4, 16) : dice.range(1.5, 12);
    s.waistband = dice.range(2.5, 4.5);
  } else if (garment == GarmentKind::t_shirt) {
    s.chest = dice.range(43, 58);
    s.shoulder_half = s.chest * dice.range(0.42, 0.46);
    s.shoulder_drop = dice.range(2.5, 5);
    s.neck_half = s.neck == NeckKind::boat ? s.shoulder_half * dice.range(0.6, 0.75) : dice.range(7.5, 11);
    s.neck_depth = s.neck == NeckKind::boat ? 2 * s.neck_half * dice.range(0.16, 0.24) : dice.range(8, 16);
    s.armhole_depth = s.shoulder_drop + s.chest * dice.range(0.39, 0.43);
    s.hem = s.chest * dice.range(0.95, 1.1);
    s.length = s.chest * dice.range(1.25, 1.5);
    s.sleeve_length = s.chest * dice.range(0.36, 0.46);
    s.sleeve_angle = dice.range(42, 60);
    s.sleeve_width = s.chest * dice.range(0.38, 0.42);
    s.cuff_width = s.chest * dice.range(0.32, 0.37);
  } else if (garment == GarmentKind::dress) {
    s.chest = dice.range(38, 52);
    s.shoulder_half = s.chest * dice.range(0.34, 0.42);
    s.shoulder_drop = dice.range(1.5, 3);
    s.neck_half =
        s.neck == NeckKind::boat ? s.shoulder_half * dice.range(0.65, 0.78) : s.shoulder_half - dice.range(4, 8);
    s.neck_depth = s.neck == NeckKind::boat ? 2 * s.neck_half * dice.range(0.16, 0.24) : dice.range(8, 17);
    s.armhole_depth = dice.range(19, 24);
    s.length = s.chest * dice.range(2.05, 2.6);
    s.waist_level = dice.range(16, 20) / (s.length - s.armhole_depth);
    s.waist_share = dice.range(0.8, 0.98);
    s.hip = s.chest * dice.range(1.06, 1.16);
    s.hip_depth = dice.range(18, 22);
    s.hem = s.hip * dice.range(1.0, 1.6);
    s.rib = dice.pick(3) == 0 ? 0 : dice.range(1, 2.2);
    s.hem_curve = dice.range(0.2, 1.5);
  } else {
    s.chest = dice.range(30, 44);
    s.length = dice.range(36, 75);
    s.hip = s.chest + dice.range(8, 12);
    s.hem = dice.pick(2) == 0 ? s.hip * dice.range(0.98, 1.1) : s.hip * dice.range(1.3, 1.8);
    s.gathers = s.hem > 1.3 * s.hip ? dice.range(0.5, 1) : 0;
    s.waistband = dice.range(2.5, 4.5);
    s.hem_curve = s.gathers > 0 ? dice.range(2, 5) : dice.range(0.2, 1);
  }
  s.fabric = static_cast<Fabric2d>(dice.pick(has_waist(garment) ? 7 : 6));
  s.pattern = dice.range(1.6, 4);
  s.motif = !has_waist(garment) && s.fabric == Fabric2d::plain && dice.pick(2) == 0;
  s.creases = dice.range(0.4, 1.3);
  s.tilt = dice.range(-3, 3);
  s.falloff = dice.range(0, 0.22);
  s.grain = dice.range(0.3, 1.5);
  s.shadow = dice.range(0.4, 1);
  s.noise = dice.range(0.5, 5);
  const double grey = dice.pick(2) == 0 ? dice.range(205, 242) : dice.range(24, 62);
  s.board = {grey + dice.range(-6, 6), grey + dice.range(-6, 6), grey + dice.range(-6, 6)};
  // Shops choose a board on which the garment shows.
  do {
    s.colour = random_colour(dice);
    s.second = random_colour(dice);
    s.third = random_colour(dice);
    s.trim = random_colour(dice);
  } while (contrast(s) < 70);
  s.width = has_sleeves(garment) ? 540 : 450;
  s.height = has_sleeves(garment) ? 470 : 550;
  s.fill = dice.range(0.72, 0.9);
  return s;
}

}  // namespace vitrine::support
