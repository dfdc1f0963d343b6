// SPDX-License-Identifier: GPL-3.0-or-later
#include <re2/re2.h>

#include <algorithm>
#include <array>

#include "image_root.hpp"
#include "rules.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

constexpr std::size_t roles = 6;

/// The alt text without the product's title: "Open back top, front" says front, whatever the garment is called.
std::string alt_words(const std::string& alt, const std::string& title) {
  if (title.empty()) return alt;
  std::string text = lower(alt);
  const auto at = text.find(lower(title));
  if (at == std::string::npos) return alt;
  return trimmed(alt.substr(0, at) + alt.substr(at + title.size()));
}

void drop_name(std::string& words, const std::string& name) {
  if (name.empty() || words.compare(0, name.size(), name) != 0) return;
  if (words.size() == name.size())
    words.clear();
  else if (words[name.size()] == '-')
    words.erase(0, name.size() + 1);
}

struct Candidate {
  int picture = -1;
  std::size_t rank = 0;  // of the rule in its group
};

}  // namespace

std::string stem_of(std::string_view source, const Rules& rules) {
  const std::vector<std::string> parts = path_parts(source);
  std::string stem = parts.empty() ? "" : shortened(parts.back(), 300);
  if (const auto dot = stem.rfind('.'); dot != std::string::npos && dot > 0) stem.erase(dot);
  for (bool again = true; again && !stem.empty();) {
    again = false;
    for (const Pattern& tail : rules.tails) {
      std::string shorter = stem;
      if (re2::RE2::Replace(&shorter, *tail, "") && shorter.size() < stem.size() && !shorter.empty()) {
        stem = shorter;
        again = true;
      }
    }
  }
  return stem;
}

std::string file_words(std::string_view source, const Product& product, const Rules& rules) {
  std::string words = slug(stem_of(source, rules));
  // The product's own name is no hint: "open-back-top-1" is picture 1 of "open-back-top".
  for (const std::string* name : {&product.handle, &product.id, &product.title}) {
    const std::size_t before = words.size();
    drop_name(words, slug(shortened(*name, 300)));
    if (words.size() != before) break;
  }
  return words;
}

std::vector<PicturePlan> choose_pictures(const Product& product, const Rules& rules) {
  struct Texts {
    std::string file, alt;
  };
  const std::size_t n = product.pictures.size();
  std::vector<PicturePlan> plans(n);
  std::vector<Texts> texts(n);
  std::vector<Role> role(n, Role::none);
  for (std::size_t i = 0; i < n; ++i) {
    const Picture& p = product.pictures[i];
    plans[i] = {p.source, p.alt, p.position > 0 ? p.position : static_cast<int>(i) + 1, "", ""};
    texts[i] = {file_words(p.source, product, rules), alt_words(p.alt, product.title)};
  }
  std::array<int, roles> taken;
  taken.fill(-1);
  const auto at = [](Role r) { return static_cast<std::size_t>(r); };
  for (std::size_t g = 0; g < rules.pictures.size(); ++g) {
    const auto& group = rules.pictures[g];
    std::array<Candidate, roles> best{};
    std::vector<std::size_t> rule_of(n, group.size());
    std::vector<Role> said(n, Role::none);
    for (std::size_t i = 0; i < n; ++i) {
      if (role[i] != Role::none) continue;
      for (std::size_t r = 0; r < group.size() && said[i] == Role::none; ++r) {
        const PictureRule& rule = group[r];
        const bool hit = rule.field == PictureRule::Field::position ? plans[i].position == rule.position
                         : rule.field == PictureRule::Field::alt
                             ? !texts[i].alt.empty() && found_in(rule.match, texts[i].alt)
                             : found_in(rule.match, texts[i].file);
        if (!hit) continue;
        said[i] = rule.role;
        rule_of[i] = r;
        Candidate& b = best[at(rule.role)];
        // The better rule, then the earlier picture.
        if (b.picture < 0 || r < b.rank ||
            (r == b.rank && plans[i].position < plans[static_cast<std::size_t>(b.picture)].position))
          b = {static_cast<int>(i), r};
      }
    }
    const bool had_front = taken[at(Role::front)] >= 0, had_back = taken[at(Role::back)] >= 0;
    if (had_front && had_back) break;
    const bool front = best[at(Role::front)].picture >= 0, back = best[at(Role::back)].picture >= 0;
    // A shop that names its fronts names its backs: a guess does not complete what a name began, but for the first
    // picture, which is nearly always the front. Between the names and the last resort, half a pair is no pair.
    const bool last = g + 1 == rules.pictures.size();
    const bool half = g > 0 && !last && !had_back && !had_front && front != back;
    for (std::size_t i = 0; i < n; ++i) {
      if (said[i] == Role::none) continue;
      const bool chosen = best[at(said[i])].picture == static_cast<int>(i);
      const bool refused = half || taken[at(said[i])] >= 0 || (g > 0 && had_front && said[i] == Role::back);
      if (said[i] != Role::other && (refused || !chosen)) {
        // Named as a second front, say: no front for us, and no guess later.
        if (g == 0) {
          role[i] = Role::other;
          plans[i].rule = group[rule_of[i]].name + " (another is taken)";
        }
        continue;
      }
      role[i] = said[i];
      plans[i].rule = group[rule_of[i]].name;
      if (said[i] != Role::other) taken[at(said[i])] = static_cast<int>(i);
    }
  }
  for (std::size_t i = 0; i < n; ++i) plans[i].role = name_of(role[i] == Role::none ? Role::other : role[i]);
  return plans;
}

}  // namespace vitrine::input
