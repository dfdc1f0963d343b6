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
    {"name": "not-made", "match": "\\b(jumpsuits?|playsuits?|rompers?|overalls|dungarees|bodysuits?|swimsuits?|bikinis?|bras?|skorts?|jackets?|coats?|blazers?|waistcoats?|hoodies?|cardigans?|kimonos?|ponchos?|dress shirts?|shoes?|boots?|bags?|hats?|socks?|tights|scarf|scarves|belts?|gift cards?)\\b", "garment": ""},
    {"name": "dress-trousers", "match": "\\bdress (pants?|trousers?)\\b", "garment": "trousers"},
    {"name": "dress-short-sleeve", "match": "\\b(sun|slip|shirt|mini|midi|maxi)?dress(es)?\\b|^2271$", "with": "\\bshort[ _-]?sleeved?s?\\b|\\b(t-?shirt|tee)[ -]?dress(es)?\\b", "garment": "dress_short_sleeve"},
    {"name": "dress-long-sleeve", "match": "\\b(sun|slip|shirt|mini|midi|maxi)?dress(es)?\\b|^2271$", "with": "\\blong[ _-]?sleeved?s?\\b|\\b(sweater|sweatshirt|jumper)[ -]?dress(es)?\\b", "garment": "dress_long_sleeve"},
    {"name": "dress", "match": "\\b(sun|slip|shirt|mini|midi|maxi)?dress(es)?\\b|\\bpinafores?\\b|^2271$", "garment": "dress"},
    {"name": "skirt", "match": "\\bskirts?\\b|^1581$", "garment": "skirt"},
    {"name": "shorts", "match": "\\b(shorts|bermudas?)\\b|^207$", "garment": "shorts"},
    {"name": "trousers", "match": "\\b(trousers?|pants?|jeans|chinos?|slacks|joggers|sweatpants|leggings?|palazzos?|culottes)\\b|^204$", "garment": "trousers"},
    {"name": "sleeveless-top", "match": "\\b(t[ -]?shirts?|tees?|tops?|sweaters?|jumpers?|pullovers?)\\b", "with": "\\b(vests?|tank[ -]?tops?|tanks?|singlets?|sleeveless|camisoles?)\\b", "garment": "vest"},
    {"name": "long-sleeved-top", "match": "\\b(t[ -]?shirts?|tees?|tops?)\\b", "with": "\\blong[ _-]?sleeved?s?\\b", "garment": "long_sleeve"},
    {"name": "short-sleeved-top", "match": "\\b(tops?|sweaters?|sweatshirts?|jumpers?|pullovers?)\\b", "with": "\\bshort[ _-]?sleeved?s?\\b|\\bt[ -]?shirts?\\b|\\btees?\\b", "garment": "t_shirt"},
    {"name": "vest", "match": "\\b(vests?|tank[ -]?tops?|tanks?|singlets?|sleeveless|camisoles?)\\b", "garment": "vest"},
    {"name": "long-sleeve", "match": "\\blong[ _-]?sleeved?s?\\b|\\b(sweaters?|sweatshirts?|jumpers?|pullovers?)\\b", "garment": "long_sleeve"},
    {"name": "t-shirt", "match": "\\bt[ _-]?shirts?\\b|\\btees?\\b|\\bshort[ _-]?sleeved?s?\\b", "garment": "t_shirt"}
  ],
  "necklines": [
    {"name": "v-neck", "match": "\\bv[ -]?necks?(line)?\\b", "neckline": "neck_v", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve"]},
    {"name": "square-neck", "match": "\\bsquare[ -]?necks?(line)?\\b", "neckline": "neck_square", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve"]},
    {"name": "boat-neck", "match": "\\b(boat|bateau)[ -]?necks?(line)?\\b", "neckline": "neck_boat", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve"]},
    {"name": "round-neck", "match": "\\b(u|scoop|crew|round)[ -]?necks?(line)?\\b", "neckline": "neck_u", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve"]}
  ],
  "fabrics": [
    {"name": "denim", "match": "\\bdenim\\b", "fabric": "denim", "garments": ["dress", "dress_short_sleeve", "dress_long_sleeve", "skirt", "trousers", "shorts"]},
    {"name": "jeans", "match": "\\bjeans\\b", "fabric": "denim", "garments": ["trousers", "shorts"]},
    {"name": "wool", "match": "\\b(wool|tweed|twill)\\b", "fabric": "wool_twill", "garments": ["dress", "dress_short_sleeve", "dress_long_sleeve", "skirt", "trousers", "shorts"]},
    {"name": "sweatshirt", "match": "\\b(sweatshirt|sweatpants|joggers|fleece|french terry)\\b", "fabric": "sweatshirt", "garments": ["long_sleeve", "trousers", "shorts"]},
    {"name": "rib", "match": "\\brib(bed)?\\b", "fabric": "rib_knit", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve"]},
    {"name": "satin", "match": "\\b(satin|silk|charmeuse)\\b", "fabric": "satin", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve", "skirt", "trousers", "shorts"]},
    {"name": "woven", "match": "\\b(poplin|woven|linen)\\b", "fabric": "cotton_woven", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve", "skirt", "trousers", "shorts"]},
    {"name": "jersey", "match": "\\bjersey\\b", "fabric": "jersey", "garments": ["vest", "t_shirt", "long_sleeve", "dress", "dress_short_sleeve", "dress_long_sleeve", "skirt", "trousers", "shorts"]}
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
