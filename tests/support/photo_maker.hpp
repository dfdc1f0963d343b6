// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "vitrine/model/garment_template.hpp"
#include "vitrine/model/geometry.hpp"
#include "vitrine/model/image.hpp"

/// Draws flat-lay product photos of garments whose true mask and feature points are known. The tests measure the engine
/// against that truth, and the sample catalogue consists of these pictures, so that the project needs nobody's photos.
namespace vitrine::support {

enum class GarmentKind { vest, long_sleeve, skirt, t_shirt, dress, trousers, shorts };
enum class NeckKind { u, v, square, boat };
enum class Fabric2d { plain, heather, stripes, diagonal, dots, floral, denim };
using Rgb = std::array<double, 3>;  ///< sRGB, 0-255

/// The garment plugin's and the neckline plugin's id.
const char* id_of(GarmentKind kind);
const char* id_of(NeckKind kind);
inline bool has_sleeves(GarmentKind kind) {
  return kind == GarmentKind::long_sleeve || kind == GarmentKind::t_shirt;
}

/// Everything that decides a photo. The same spec gives the same pixels. Lengths in centimetres on the flat garment.
struct PhotoSpec {
  GarmentKind garment = GarmentKind::vest;
  Side side = Side::front;
  std::uint32_t seed = 1;  ///< of the garment: asymmetry and pattern; the same for its front and back photo

  // Outline of tops. y = 0 is where the shoulder line meets the neckline.
  NeckKind neck = NeckKind::u;
  double neck_half = 8.5;        ///< [cm] half the neck width
  double neck_depth = 13;        ///< [cm] of the front
  double back_neck_depth = 2.5;  ///< [cm]
  double shoulder_half = 14;     ///< [cm] a vest's strap is shoulder_half - neck_half wide
  double shoulder_drop = 1.6;    ///< [cm] fall of the shoulder line
  double armhole_depth = 22;     ///< [cm] height of the armpit
  double waist_share = 0.95;     ///< [-] width at the waist / chest
  double waist_level = 0.42;     ///< [-] height of the waist between armpit and hem
  double sleeve_length = 60;     ///< [cm] shoulder to cuff
  double sleeve_angle = 31;      ///< [degree] from the vertical
  double sleeve_width = 17.5;    ///< [cm] flat, square to the sleeve at the armpit
  double cuff_width = 9.7;       ///< [cm] flat

  // Outline of all garments.
  double chest = 46;       ///< [cm] flat width from armpit to armpit; of a skirt: of the waist
  double hem = 46;         ///< [cm] flat width of the hem
  double length = 62;      ///< [cm] neck point (or waist) to hem, in the middle
  double hem_curve = 0.8;  ///< [cm] the middle of the hem hangs lower than its ends

  // Outline of skirts and trousers. Of trousers `hem` is the width of one leg's opening.
  double hip = 46;         ///< [cm] flat width; of dresses too
  double hip_depth = 18;   ///< [cm] below the waist; of dresses too
  double waistband = 4;    ///< [cm] height
  double waist_dip = 1.3;  ///< [cm] the front of the waist lies lower than the back

  // Outline of trousers.
  double rise = 27;      ///< [cm] waist to crotch
  double leg_angle = 3;  ///< [degree] of the inside leg from the vertical
  double touch = 0;      ///< [cm] below the crotch on which the legs lie on each other and hide it

  // Fabric.
  Fabric2d fabric = Fabric2d::plain;
  Rgb colour{184, 84, 54};
  Rgb second{240, 234, 220};  ///< stripes, dots, flowers, print
  Rgb third{90, 120, 90};     ///< leaves, flower centres
  Rgb trim{170, 76, 48};      ///< bindings and ribs
  double pattern = 2.4;       ///< [cm] period of stripes, dots, flowers
  bool motif = false;         ///< a geometric print on the chest, its small sign on the back
  double rib = 1.7;           ///< [cm] width of neck and armhole bindings
  double hem_rib = 0;         ///< [cm] ribbed hem and cuffs; 0 = turned and stitched
  double creases = 1;         ///< [-] strength of folds; 0 = ironed
  double gathers = 0;         ///< [-] strength of the hanging folds of a wide skirt

  // Board, light and camera.
  int width = 900, height = 1100;  ///< [px]
  double fill = 0.86;              ///< [-] share of the picture that the garment's larger side fills
  double tilt = 0;                 ///< [degree]
  double asymmetry = 1;            ///< [-] 0 = both halves the same
  Rgb board{236, 232, 225};
  double falloff = 0.10;  ///< [-] light lost towards the far corner
  double grain = 1;       ///< [-] of the board's paper
  double shadow = 1;      ///< [-] of the contact shadow
  double noise = 1.0;     ///< [grey levels] standard deviation of the camera's noise
};

struct MadePhoto {
  Image rgb;
  Image labels;                           ///< 1 channel of Label values
  std::map<std::string, Vec2> landmarks;  ///< [px]; left/right are sides of this picture
  double pixels_per_cm = 0;
};

MadePhoto make_photo(const PhotoSpec& spec);

/// The same garment seen from behind: higher neckline, mirrored asymmetry, its own creases.
PhotoSpec back_of(PhotoSpec front);

/// A garment, board and camera drawn at random from the range in which a shop's photo is still usable; small (450 px)
/// so that property tests can make hundreds.
PhotoSpec random_spec(std::uint32_t seed, GarmentKind garment);

inline bool has_legs(GarmentKind garment) {
  return garment == GarmentKind::trousers || garment == GarmentKind::shorts;
}
/// Whether the garment hangs from the waist.
inline bool has_waist(GarmentKind garment) {
  return garment == GarmentKind::skirt || has_legs(garment);
}

/// Smallest sRGB distance between the board and a colour of the garment's border.
double contrast(const PhotoSpec& spec);

}  // namespace vitrine::support
