// SPDX-License-Identifier: GPL-3.0-or-later
#include "vitrine/catalog_input.hpp"

namespace vitrine {

std::string default_rules() {
  // Of two fields the surer comes first: people write alt texts, programs write file names, positions are a habit.
  return R"rules({
  "columns": {},
  "file_name_tails": [
    "[-_][0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}$",
    "[-_](pico|icon|thumb|small|compact|medium|large|grande|original|master)$",
    "[-_][0-9]{2,5}x[0-9]{0,5}(_crop_[a-z]+)?(@[23]x)?$",
    "-scaled$",
    "-e[0-9]{9,13}$"
  ],
  "pictures": [
    [
      {"name": "file-front-mask", "file": "(^|-)front-mask$", "is": "front_mask"},
      {"name": "file-back-mask", "file": "(^|-)back-mask$", "is": "back_mask"},
      {"name": "file-other", "file": "(^|-)(side|details?|close-?up|zoom|model|worn|look|lifestyle|swatch|label|size-?(chart|guide)|pack(aging)?)(-?[0-9]{1,3})?$", "is": "other"},
      {"name": "alt-other", "alt": "\\b(details?|close-?up|swatch|size (chart|guide)|lifestyle|side view|from the side|worn|on model)\\b", "is": "other"},
      {"name": "alt-back", "alt": "^\\W*(the )?(back|rear|behind)\\W*$|\\b(back|rear)[- ](view|side|image|photo|picture|shot)\\b|^\\W*(the )?(back|rear) of\\b|[-–—|,:;(/]\\s*(the )?(back|rear)\\W*$|\\bfrom (the )?(back|behind)\\b|\\b(rückseite|rückansicht|von hinten|vue de dos|vista trasera)\\b", "is": "back"},
      {"name": "alt-front", "alt": "^\\W*(the )?front\\W*$|\\bfront[- ](view|side|image|photo|picture|shot)\\b|^\\W*(the )?front of\\b|[-–—|,:;(/]\\s*(the )?front\\W*$|\\bfrom (the )?front\\b|\\b(vorderseite|vorderansicht|von vorne|vue de face|vista frontal)\\b", "is": "front"},
      {"name": "file-back", "file": "(^|-|[0-9])(back|rear|rueckseite|rückseite|hinten|dos|espalda|retro)(-(view|side))?(-[0-9]{1,2})?$|(^|-)b$", "is": "back"},
      {"name": "file-front", "file": "(^|-|[0-9])(front|vorderseite|vorne|face|devant|frente|fronte)(-(view|side))?(-[0-9]{1,2})?$|(^|-)f$", "is": "front"}
    ],
    [
      {"name": "file-number-1", "file": "(^|-)0*1$", "is": "front"},
      {"name": "file-number-2", "file": "(^|-)0*2$", "is": "back"}
    ],
    [
      {"name": "position-1", "position": 1, "is": "front"},
      {"name": "position-2", "position": 2, "is": "back"}
    ]
  ],
  "garments": [
    {"name": "not-made", "match": "\\b(dress(es)?|jumpsuits?|rompers?|jackets?|coats?|hoodies?|cardigans?|shoes?|bags?|hats?|socks?|scarf|scarves|belts?|gift cards?)\\b", "garment": ""},
    {"name": "skirt", "match": "\\bskirts?\\b|^1581$", "garment": "skirt"},
    {"name": "vest", "match": "\\b(vests?|tank[ -]?tops?|tanks?|singlets?|sleeveless|camisoles?)\\b", "garment": "vest"},
    {"name": "long-sleeve", "match": "\\blong[ _-]?sleeved?s?\\b|\\b(sweaters?|sweatshirts?|jumpers?|pullovers?)\\b", "garment": "long_sleeve"}
  ],
  "necklines": [
    {"name": "v-neck", "match": "\\bv[ -]?necks?(line)?\\b", "neckline": "neck_v", "garments": ["vest", "long_sleeve"]},
    {"name": "square-neck", "match": "\\bsquare[ -]?necks?(line)?\\b", "neckline": "neck_square", "garments": ["vest", "long_sleeve"]},
    {"name": "round-neck", "match": "\\b(u|scoop|crew|round)[ -]?necks?(line)?\\b", "neckline": "neck_u", "garments": ["vest", "long_sleeve"]}
  ],
  "fabrics": [
    {"name": "denim", "match": "\\bdenim\\b", "fabric": "denim", "garments": ["skirt"]},
    {"name": "wool", "match": "\\b(wool|tweed|twill)\\b", "fabric": "wool_twill", "garments": ["skirt"]},
    {"name": "sweatshirt", "match": "\\b(sweatshirt|fleece|french terry)\\b", "fabric": "sweatshirt", "garments": ["long_sleeve"]},
    {"name": "rib", "match": "\\brib(bed)?\\b", "fabric": "rib_knit", "garments": ["vest", "long_sleeve"]},
    {"name": "satin", "match": "\\b(satin|silk|charmeuse)\\b", "fabric": "satin", "garments": ["vest", "long_sleeve", "skirt"]},
    {"name": "woven", "match": "\\b(poplin|woven|linen)\\b", "fabric": "cotton_woven", "garments": ["vest", "long_sleeve", "skirt"]},
    {"name": "jersey", "match": "\\bjersey\\b", "fabric": "jersey", "garments": ["vest", "long_sleeve", "skirt"]}
  ],
  "measures": [
    {"name": "chest-in-text", "is": "chest_cm", "match": "\\b(?:pit to pit|armpit to armpit|chest width|flat chest)\\b[^0-9]{0,12}([0-9]{1,3}(?:[.,][0-9]{1,2})?) ?(cm|mm|in\\b|inch|\")"},
    {"name": "length-in-text", "is": "length_cm", "match": "\\b(?:total length|body length|back length|neck to hem|waist to hem)\\b[^0-9]{0,12}([0-9]{1,3}(?:[.,][0-9]{1,2})?) ?(cm|mm|in\\b|inch|\")"}
  ],
  "default_garment": "",
  "no_garment": "leave_out",
  "no_back": "refuse",
  "leave_out_status": ["archived"],
  "mannequins": []
}
)rules";
}

}  // namespace vitrine
