// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vitrine/host/adopt.hpp"
#include "vitrine/plugin.hpp"
#include "vitrine/templates/necklines.hpp"
#include "vitrine/templates/torso.hpp"

namespace vitrine {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::array entry_garments = {templates::vest};
constexpr std::array entry_necklines = {templates::neck_v};
vitrine_plugin sound_entry() {
  return {.magic = VITRINE_MAGIC,
          .abi_major = VITRINE_ABI_MAJOR,
          .abi_minor = VITRINE_ABI_TARGET_MINOR,
          .size = sizeof(vitrine_plugin),
          .vendor = "Example",
          .id = "org.example.some",
          .version = "1.2.3",
          .garments = sdk::span(entry_garments),
          .necklines = sdk::span(entry_necklines),
          .extension = nullptr};
}

TEST(AdoptEntry, takes_a_sound_plugin) {
  const vitrine_plugin entry = sound_entry();
  const auto plugin = adopt(&entry, "some.vitrine.so");
  ASSERT_TRUE(plugin) << plugin.error().message;
  EXPECT_EQ(plugin->identity.id, "org.example.some");
  EXPECT_EQ(plugin->identity.vendor, "Example");
  EXPECT_EQ(plugin->garments.size(), 1u);
  EXPECT_EQ(plugin->necklines.size(), 1u);
}

TEST(AdoptEntry, other_major_names_both_versions_and_both_remedies) {
  vitrine_plugin entry = sound_entry();
  for (const std::uint32_t major : {0u, 2u}) {
    entry.abi_major = major;
    const auto plugin = adopt(&entry, "some.vitrine.so");
    ASSERT_FALSE(plugin);
    EXPECT_EQ(plugin.error().code, "PLUGIN_ENTRY_ABI_MAJOR");
    EXPECT_THAT(plugin.error().message, AllOf(HasSubstr("ABI " + std::to_string(major) + ".0"), HasSubstr("ABI 1.0")));
    EXPECT_THAT(plugin.error().remedy, AllOf(testing::ContainsRegex("[Rr]ebuild the plugin"), HasSubstr("vitrine")));
  }
}

TEST(AdoptEntry, newer_minor_names_both_versions_and_both_remedies) {
  vitrine_plugin entry = sound_entry();
  entry.abi_minor = 7;
  const auto plugin = adopt(&entry, "some.vitrine.so");
  ASSERT_FALSE(plugin);
  EXPECT_EQ(plugin.error().code, "PLUGIN_ENTRY_ABI_MINOR");
  EXPECT_THAT(plugin.error().message, AllOf(HasSubstr("ABI 1.7"), HasSubstr("ABI 1.0")));
  EXPECT_THAT(plugin.error().remedy, AllOf(HasSubstr("Update vitrine"), HasSubstr("rebuild the plugin")));
}

// Whatever the rest holds: nothing behind the four frozen fields may be read before they are right.
TEST(AdoptEntry, looks_at_the_version_before_anything_else) {
  struct {
    std::uint32_t magic = VITRINE_MAGIC, major = 9, minor = 9, size = 16;
  } head;
  EXPECT_EQ(adopt(&head, "x").error().code, "PLUGIN_ENTRY_ABI_MAJOR");
  head.magic = 0x12345678;
  EXPECT_EQ(adopt(&head, "x").error().code, "PLUGIN_ENTRY_MAGIC");
  head.magic = VITRINE_MAGIC, head.major = VITRINE_ABI_MAJOR, head.minor = VITRINE_ABI_MINOR;
  EXPECT_EQ(adopt(&head, "x").error().code, "PLUGIN_ENTRY_SIZE");
  EXPECT_EQ(adopt(nullptr, "x").error().code, "PLUGIN_ENTRY_MAGIC");
}

TEST(AdoptEntry, reads_a_descriptor_that_has_grown) {
  struct {
    vitrine_plugin entry = sound_entry();
    std::uint64_t more = 0xdeadbeef;
  } grown;
  grown.entry.size = sizeof grown;
  EXPECT_TRUE(adopt(&grown, "x"));
}

TEST(AdoptEntry, refuses_bad_identities) {
  const auto code = [](const char* id, const char* version) {
    vitrine_plugin entry = sound_entry();
    entry.id = id, entry.version = version;
    const auto plugin = adopt(&entry, "x");
    return plugin ? std::string("adopted") : plugin.error().code;
  };
  EXPECT_EQ(code("org.example.a-b_c2", "0.0.1-rc.1+build.5"), "adopted");
  for (const char* id : {"poncho", "org..poncho", "Org.example", ".org.example", "org.example.", "org/example.x"})
    EXPECT_EQ(code(id, "1.0.0"), "PLUGIN_ENTRY_ID") << id;
  for (const char* version : {"1", "1.0", "1.0.0.0", "v1.0.0", "01.0.0", "1.0.0-", "1.0.0 "})
    EXPECT_EQ(code("org.example", version), "PLUGIN_ENTRY_ID") << version;
  EXPECT_EQ(code(nullptr, "1.0.0"), "PLUGIN_TEXT_PRESENT");
}

TEST(AdoptEntry, refuses_an_empty_plugin_and_repeated_ids) {
  vitrine_plugin entry = sound_entry();
  entry.garments = {}, entry.necklines = {};
  EXPECT_EQ(adopt(&entry, "x").error().code, "PLUGIN_ENTRY_CONTENT");
  const std::array twice = {templates::vest, templates::vest};
  entry.garments = sdk::span(twice);
  EXPECT_EQ(adopt(&entry, "x").error().code, "PLUGIN_NAME_UNIQUE");
}

}  // namespace
}  // namespace vitrine
