// SPDX-License-Identifier: GPL-3.0-or-later
// report.html: one file for a browser, that needs nothing beside it to be looked at, and asks nobody for anything.
#include <algorithm>
#include <cstdio>

#include "atomic_file.hpp"
#include "report_files.hpp"

namespace vitrine {
namespace {

constexpr std::size_t most_cards = 10'000;            // some 50 MB with thumbnails; report.jsonl has them all
constexpr std::size_t largest_thumbnail = 64u << 10;  // [byte]

// Nothing but what is in the file itself may be loaded or run.
constexpr const char* head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>Catalogue report</title>
<style>
:root { --ink: #1d2126; --soft: #5c6570; --line: #d9dde2; --ground: #f5f6f8; --ok: #1b7f4b; --bad: #b3341f; --ours: #7a3fa0; --wait: #8a6d00; }
* { box-sizing: border-box; }
body { margin: 0; font: 15px/1.45 system-ui, sans-serif; color: var(--ink); background: var(--ground); }
main { max-width: 1280px; margin: 0 auto; padding: 24px; }
h1 { font-size: 22px; margin: 0 0 4px; } h2 { font-size: 16px; margin: 0 0 8px; }
.lead { color: var(--soft); margin: 0 0 20px; } .warn { color: var(--bad); font-weight: 600; }
.tables { display: flex; flex-wrap: wrap; gap: 24px; margin-bottom: 24px; align-items: flex-start; }
table { border-collapse: collapse; background: #fff; border: 1px solid var(--line); }
th, td { padding: 6px 12px; text-align: left; border-bottom: 1px solid var(--line); } td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
th { font-weight: 600; color: var(--soft); font-size: 13px; }
form { display: flex; flex-wrap: wrap; gap: 12px; align-items: center; position: sticky; top: 0; background: var(--ground); padding: 12px 0; z-index: 1; }
input, select { font: inherit; padding: 6px 10px; border: 1px solid var(--line); border-radius: 6px; background: #fff; } input { width: 280px; }
#shown { color: var(--soft); }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(270px, 1fr)); gap: 14px; }
article { background: #fff; border: 1px solid var(--line); border-radius: 8px; overflow: hidden; display: flex; flex-direction: column; }
article[hidden] { display: none; }
.shot { height: 220px; background: #eceef1; display: flex; align-items: center; justify-content: center; color: var(--soft); }
.shot img { max-width: 100%; max-height: 220px; display: block; }
.text { padding: 10px 12px 12px; overflow-wrap: anywhere; } .text p { margin: 4px 0 0; } .text .title { color: var(--soft); } .text .remedy { color: var(--soft); font-size: 13px; }
.name { display: flex; justify-content: space-between; gap: 8px; font-weight: 600; }
.status { font-size: 12px; font-weight: 600; padding: 1px 8px; border-radius: 10px; color: #fff; background: var(--ours); white-space: nowrap; align-self: start; }
.status.ok { background: var(--ok); } .status.refused, .status.partly { background: var(--bad); } .status.not_run { background: var(--wait); }
.figures { color: var(--soft); font-size: 13px; font-variant-numeric: tabular-nums; } a { color: inherit; }
</style>
</head>
<body>
<main>
)";

constexpr const char* script = R"(<script>
const cards = [...document.querySelectorAll('article')];
const text = document.getElementById('text'), status = document.getElementById('status'), garment = document.getElementById('garment');
const code = document.getElementById('code'), shown = document.getElementById('shown');
function filter() {
  const words = text.value.toLowerCase().split(/\s+/).filter(Boolean);
  let n = 0;
  for (const card of cards) {
    const fits = (!status.value || card.dataset.status === status.value) && (!garment.value || card.dataset.garment === garment.value) &&
      (!code.value || card.dataset.code === code.value) && words.every(w => card.dataset.text.includes(w));
    card.hidden = !fits;
    n += fits;
  }
  shown.textContent = n + ' of ' + cards.length + ' shown';
}
for (const field of [text, status, garment, code]) field.addEventListener('input', filter);
filter();
</script>
</main>
</body>
</html>
)";

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= bytes.size() - i ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string figures(const nlohmann::ordered_json& json) {
  const auto number = [&](const char* key, const char* format) -> std::string {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number()) return "";
    char text[64];
    std::snprintf(text, sizeof text, format, found->get<double>());
    return text;
  };
  std::string line = number("seam_gap_mm_max", "seams %.2f mm");
  if (const std::string depth = number("penetration_mm_max", "%.2f mm inside"); !depth.empty())
    line += (line.empty() ? "" : " · ") + depth;
  if (const auto sizes = json.find("sizes"); sizes != json.end() && sizes->is_array())
    line += (line.empty() ? "" : " · ") + std::to_string(sizes->size()) + " sizes";
  return line;
}

std::string share(const StatusCounts& c) {
  char text[16];
  std::snprintf(text, sizeof text, "%.1f %%", c.total > 0 ? 100.0 * c.ok / c.total : 100.0);
  return text;
}

std::string card(const ParsedLine& line, const std::filesystem::path& root) {
  const auto& json = line.json;
  const bool made = line.status == ItemStatus::ok || line.status == ItemStatus::partly;
  const std::string folder = made ? line.sku : line.status == ItemStatus::refused ? "quarantine/" + line.sku : "";
  const std::string code = text_of(json, "code"), message = text_of(json, "message"), title = text_of(json, "title");
  const std::string garment = text_of(json, "garment"), status = name_of(line.status);
  std::string html = "<article data-status=\"" + status + "\" data-garment=\"" + escaped(garment) + "\" data-code=\"" +
                     escaped(code) + "\" data-text=\"" +
                     escaped(lower(line.sku + " " + title + " " + garment + " " + code + " " + message)) + "\">\n";
  const std::string thumbnail = folder.empty() ? "" : read_whole(root / folder / "thumb.jpg");
  if (!thumbnail.empty() && thumbnail.size() <= largest_thumbnail)
    html += "<div class=\"shot\"><img alt=\"\" loading=\"lazy\" src=\"data:image/jpeg;base64," + base64(thumbnail) +
            "\"></div>\n";
  else
    html += "<div class=\"shot\">no picture</div>\n";
  const std::string name = escaped(line.sku);
  html += "<div class=\"text\"><div class=\"name\"><span>" +
          (folder.empty() ? name : "<a href=\"" + escaped(folder) + "/\">" + name + "</a>") +
          "</span><span class=\"status " + status + "\">" + status + "</span></div>\n";
  html += "<p class=\"title\">" + escaped(title.empty() ? garment : title + ", " + garment) + "</p>\n";
  if (line.status != ItemStatus::ok) {
    html += "<p><b>" + escaped(code) + "</b> " + escaped(message) + "</p>\n";
    if (const std::string remedy = text_of(json, "remedy"); !remedy.empty())
      html += "<p class=\"remedy\">" + escaped(remedy) + "</p>\n";
  }
  if (const std::string f = figures(json); !f.empty()) html += "<p class=\"figures\">" + f + "</p>\n";
  return html + "</div></article>\n";
}

template <class Counts>
std::string choice(const char* id, const char* all, const Counts& counts) {
  std::string html = std::string("<select id=\"") + id + "\"><option value=\"\">" + all + "</option>";
  for (const auto& entry : counts) html += "<option>" + escaped(entry.first) + "</option>";
  return html + "</select>\n";
}

}  // namespace

std::string report_html(const std::vector<ParsedLine>& lines, const ReportScope& scope,
                        const std::filesystem::path& root) {
  StatusCounts all;
  std::map<std::string, StatusCounts> garments;
  std::map<std::string, int> statuses, codes;
  for (const ParsedLine& line : lines) {
    count(all, line.status);
    count(garments[text_of(line.json, "garment")], line.status);
    ++statuses[name_of(line.status)];
    if (line.status != ItemStatus::ok) ++codes[text_of(line.json, "code")];
  }
  std::string html = head;
  html += "<h1>" + std::to_string(all.ok) + " of " + std::to_string(all.total) +
          " items converted</h1>\n<p class=\"lead\">" + share(all) + " of the catalogue; ";
  std::string rest;
  for (const auto& [status, n] : statuses)
    if (status != "ok") rest += (rest.empty() ? "" : ", ") + std::to_string(n) + " " + status;
  html += (rest.empty() ? "nothing refused, nothing failed" : rest) + ".</p>\n";
  if (!scope.missing.empty()) {
    html += "<p class=\"warn\">Shards without a report:";
    for (const int shard : scope.missing) html += " " + std::to_string(shard);
    html += " of " + std::to_string(scope.shards) + "; " + std::to_string(scope.items - lines.size()) +
            " items of the catalogue are not in this report.</p>\n";
  }
  html +=
      "<div class=\"tables\"><table><tr><th>Garment</th><th class=\"n\">Items</th><th class=\"n\">Converted</th>"
      "<th class=\"n\">Success</th></tr>\n";
  for (const auto& [garment, c] : garments)
    html += "<tr><td>" + escaped(garment) + "</td><td class=\"n\">" + std::to_string(c.total) +
            "</td><td class=\"n\">" + std::to_string(c.ok) + "</td><td class=\"n\">" + share(c) + "</td></tr>\n";
  html += "</table>\n";
  if (!codes.empty()) {
    html += "<table><tr><th>Reason</th><th class=\"n\">Items</th></tr>\n";
    for (const auto& [code, n] : codes)
      html += "<tr><td>" + escaped(code) + "</td><td class=\"n\">" + std::to_string(n) + "</td></tr>\n";
    html += "</table>\n";
  }
  html +=
      "</div>\n<form onsubmit=\"return false\"><input id=\"text\" type=\"search\" placeholder=\"SKU, title or "
      "message\" "
      "aria-label=\"Filter\">\n";
  html += choice("status", "every status", statuses) + choice("garment", "every garment", garments) +
          choice("code", "every reason", codes) + "<span id=\"shown\"></span></form>\n<div class=\"cards\">\n";
  // What wants looking at comes first.
  std::size_t cards = 0;
  for (const bool well : {false, true})
    for (const ParsedLine& line : lines)
      if ((line.status == ItemStatus::ok) == well && cards < most_cards) {
        html += card(line, root);
        ++cards;
      }
  html += "</div>\n";
  if (cards < lines.size())
    html += "<p class=\"lead\">The first " + std::to_string(cards) + " items; report.jsonl has all " +
            std::to_string(lines.size()) + ".</p>\n";
  return html + script;
}

}  // namespace vitrine
