// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "adopt_tables.hpp"

namespace vitrine {

namespace adoption {

NecklineTemplate copy_neckline(const vitrine_neckline& table, const PluginIdentity& identity) {
  NecklineTemplate copy;
  copy.id = read_name(table.id, "a neckline's id");
  const std::string where = "neckline " + in_quotes(copy.id);
  copy.title = read_text(table.title, 200, where + ": title");
  copy.plugin = identity.id;
  copy.version = identity.version;
  double deepest = 0;
  for (const vitrine_profile_point& row : read_span(table.profile, 3, 256, where + ": profile")) {
    const std::string at = where + ": profile point " + std::to_string(copy.profile.size());
    const Vec2 point(read_number(row.s, 0, 1, at + ": s"), read_number(row.depth, 0, 1, at + ": depth"));
    if (!copy.profile.empty() && !(point.x() > copy.profile.back().x()))
      throw Broken{"neckline.profile", at + ": s does not ascend"};
    deepest = std::max(deepest, point.y());
    copy.profile.push_back(point);
  }
  if (copy.profile.front() != Vec2(0, 0) || copy.profile.back() != Vec2(1, 0))
    throw Broken{"neckline.profile", where + ": the profile does not run from (0,0) to (1,0)"};
  if (deepest < 1) throw Broken{"neckline.profile", where + ": the profile does not reach depth 1"};
  copy.ratio_min = read_number(table.ratio_min, 0, 1e6, where + ": ratio_min");
  copy.ratio_max = read_number(table.ratio_max, 0, 1e6, where + ": ratio_max");
  if (!(copy.ratio_min < copy.ratio_max)) throw Broken{"number.range", where + ": ratio_min is not below ratio_max"};
  copy.default_depth = read_number(table.default_depth, 0.01, 5, where + ": default_depth");
  return copy;
}

}  // namespace adoption

}  // namespace vitrine
