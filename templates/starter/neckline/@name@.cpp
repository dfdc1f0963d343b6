// @Title@: a neckline as data. It starts as a boat neck; change the curve until it is yours.
#include "vitrine/check.hpp"

namespace {

namespace sdk = vitrine::sdk;

// Along the neck edge: place (0 at one side of the neck, 1 at the other) and depth (1 at the lowest point).
constexpr auto profile = std::to_array<vitrine_profile_point>({
    {0.00, 0.00},
    {0.10, 0.45},
    {0.25, 0.80},
    {0.50, 1.00},
    {0.75, 0.80},
    {0.90, 0.45},
    {1.00, 0.00},
});

constexpr auto necklines = std::to_array<vitrine_neckline>({{
    .id = "@name@",
    .title = "@Title@",
    .profile = sdk::span(profile),
    // Garment / ground in the box under the neck edge: the curve above leaves 0.32 / 0.68 = 0.47. A photo whose ratio lies
    // in [min, max) chooses this neckline; where several would do, the one whose tip is as pointed as the photo's.
    .ratio_min = 0.40,
    .ratio_max = 0.50,
    .default_depth = 0.25,  // depth / width of the neck, where the photo shows none
}});
VITRINE_CHECK(necklines[0]);

}  // namespace

VITRINE_PLUGIN(.vendor = "Example", .id = "org.example.@name@", .version = "1.0.0", .garments = {},
               .necklines = vitrine::sdk::span(necklines), .extension = nullptr);
