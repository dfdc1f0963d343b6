// SPDX-License-Identifier: GPL-3.0-or-later
// Tops and bottoms of the sample catalogue worn together, laid into one model as the show room does in the browser.
#include "run.hpp"

using namespace vitrine::test;

namespace {

const std::string scripts = std::string(VITRINE_SOURCE_DIR) + "/tests/outfits/";

/// Two tops, two bottoms and the dress of the sample catalogue at draft quality, with copies for a web page.
fs::path converted(const fs::path& folder) {
  for (const char* row : {"vest vest-sailor", "t_shirt t-shirt-dots", "skirt skirt-garden", "trousers trousers-indigo",
                          "dress dress-meadow"}) {
    const std::string text = row, garment = text.substr(0, text.find(' ')), sku = text.substr(text.find(' ') + 1);
    const Outcome run = run_vitrine("-q convert --front '" + sample + sku + "-front.jpg' --back '" + sample + sku +
                                    "-back.jpg' --garment " + garment + " --name " + sku +
                                    " --quality draft --compress --out '" + (folder / sku).string() + "'");
    EXPECT_EQ(run.exit_code, 0) << sku << ": " << run.text;
  }
  return folder;
}

Outcome node(const std::string& script, const std::string& arguments) {
  Outcome run;
  FILE* pipe = popen(("node '" + scripts + script + "' " + arguments + " 2>&1 </dev/null").c_str(), "r");
  if (!pipe) return run;
  char buffer[4096];
  for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) run.text.append(buffer, n);
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

}  // namespace

TEST(Outfits, keep_cloth_off_cloth_and_off_the_body_in_valid_gltf_and_refuse_what_is_no_pair) {
  const fs::path folder = converted(scratch());
  const Outcome measured = node("outfits.mjs", "'" + folder.string() + "'");
  EXPECT_EQ(measured.exit_code, 0) << measured.text << "\n(or npm ci was not run in tests/outfits)";
  const Outcome refused = node("refusals.mjs", "'" + folder.string() + "' vest-sailor skirt-garden dress-meadow");
  EXPECT_EQ(refused.exit_code, 0) << refused.text;
}
