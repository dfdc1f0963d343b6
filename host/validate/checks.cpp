// SPDX-License-Identifier: GPL-3.0-or-later
// The table of all checks. Nothing is checked that is not in it, and docs/VALIDATE.md is printed from it.
#include <algorithm>

#include "vitrine/validate.hpp"

namespace vitrine {
namespace {

constexpr CheckInfo load_checks[] = {
    {"load.file", 1, "The file is there, ends in .vitrine.so, and nobody but root and you can change or swap it."},
    {"load.library", 1, "The file is a whole shared library for this machine."},
    {"load.start", 1, "It loads with all symbols resolved, and nothing in it crashes, hangs, throws or exits."},
    {"load.entry", 1, "It exports vitrine_plugin_entry."},
};

constexpr CheckInfo more_template_checks[] = {
    {"pose.simple", 3, "The outline of a pose does not cross or touch itself, but where a limb lies on the trunk."},
    {"pose.mirror", 3, "Mirror partners lie at about one height, and on the same sides of each other in every pose."},
    {"pose.radius", 3, "A search circle reaches at most three times as far as the nearest other feature lies."},
    {"pose.size", 3, "A pose fills its box: its features span at least six tenths of it in both directions."},
    {"landmark.side", 3, "A feature on a landmark of the left lies left of one on the same landmark of the right."},
    {"landmark.mirror", 3, "Mirror partners lie on landmarks that are partners too."},
    {"seam.length", 3, "Edges sewn together are at most three times as long as each other, in every pose."},
    {"seam.direction", 3, "Edges sewn together run the same way round, so that no seam is twisted."},
    {"limb.chain", 3, "A limb follows one arm or leg of its own side, from the trunk outwards."},
    {"anchor.top", 3, "A garment hangs by its upper half."},
    {"neck.edge", 3, "A neck edge runs from left to right along the top."},
    {"neckline.form", 3, "A neckline goes down once and up once, and no deeper than twice its width."},
    {"fabric.believable", 3, "Fabrics are as heavy, stiff and rough as clothes are."},
};

constexpr CheckInfo later_checks[] = {
    {"pipeline.features", 4, "In a photo drawn from each pose, feature points are found where they were drawn."},
    {"pipeline.panels", 4, "That photo gives panels whose seams pair, and a mesh, with every neckline."},
    {"pipeline.drape", 4, "Each neckline and fabric is sewn and comes to rest on the default mannequin, at draft."},
    {"pipeline.residual", 4, "At rest, the forces left are at most a hundredth of the weight."},
    {"pipeline.seams", 4, "Seams close to 2 mm before they are welded."},
    {"pipeline.body", 4, "No cloth lies deeper than 1 mm inside the mannequin."},
    {"pipeline.pieces", 4, "The sewn cloth is one piece."},
    {"pipeline.size", 4, "The dressed garment is of a size that a person wears."},
    {"pipeline.files", 4, "A whole conversion writes models and a preview."},
    {"pipeline.photos", 4, "Photos given with --photo are converted."},
    {"determinism.repeat", 5, "The same conversion gives the same bytes twice."},
    {"determinism.process", 5, "Another process reads the same tables and writes the same bytes."},
    {"determinism.tables", 5, "The tables are the same bytes after all conversions as before."},
    {"hardening.exports", 6, "It exports its entry and nothing else."},
    {"hardening.needs", 6, "It needs no library but those of the C and C++ languages, and no symbol of the host."},
    {"hardening.search", 6, "It has no RPATH or RUNPATH."},
    {"hardening.segments", 6, "No memory of it is both writable and executable, and its stack is not executable."},
    {"hardening.readonly", 6, "All tables and texts lie in memory that is read-only after loading."},
    {"hardening.size", 6, "Its image takes at most 16 MB."},
    {"hardening.memory", 6, "Loading it takes at most 64 MB of address space and one second of processor time."},
    {"hardening.threads", 6, "Loading it starts no thread and no process."},
    {"hardening.files", 6, "Loading it leaves no file or connection open."},
    {"hardening.output", 6, "Loading it prints nothing."},
    {"hardening.environment", 6, "Loading it changes no environment variable, working folder or file mode mask."},
    {"hardening.signals", 6, "Loading it sets no signal handler, signal mask, timer or handler of the C++ runtime."},
    {"hardening.numbers", 6, "Loading it changes neither the locale nor rounding or other floating-point modes."},
    {"hardening.stays", 6, "It stays in memory."},
};

bool is_descriptor_rule(std::string_view name) {
  for (const char* group : {"entry.", "memory.", "span.", "text."})
    if (name.starts_with(group)) return true;
  return false;
}

std::vector<CheckInfo> all_checks() {
  std::vector<CheckInfo> all(std::begin(load_checks), std::end(load_checks));
  for (const int level : {2, 3})
    for (const AdoptionRule& rule : adoption_rules())
      if (is_descriptor_rule(rule.name) == (level == 2)) all.push_back({rule.name, level, rule.description});
  all.insert(all.end(), std::begin(more_template_checks), std::end(more_template_checks));
  all.insert(all.end(), std::begin(later_checks), std::end(later_checks));
  return all;
}

}  // namespace

std::span<const CheckInfo> plugin_checks() {
  static const std::vector<CheckInfo> all = all_checks();
  return all;
}

std::string_view level_name(int level) {
  constexpr std::string_view names[] = {"load", "descriptor", "template", "pipeline", "determinism", "hardening"};
  return level >= 1 && level <= max_check_level ? names[level - 1] : std::string_view();
}

}  // namespace vitrine
