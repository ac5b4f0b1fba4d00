#include "tests/support/part_reference.h"

namespace sprung {
namespace {

class ReferenceParts : public testing::TestWithParam<PartCase> {};

TEST_P(ReferenceParts, DisplacementsStressesAndReactions) { expect_reference(GetParam(), SPRUNG_SOURCE_DIR); }

INSTANTIATE_TEST_SUITE_P(All, ReferenceParts,
                         testing::Values(PartCase{"bracket", "fix_x_low", "--fix x-low --load x-high:50N:-y"},
                                         PartCase{"bracket", "fix_y_high", "--fix y-high --load x-high:50N:-y"},
                                         PartCase{"bracket_bent", "fix_x_low", "--fix x-low --load x-high:50N:-y"},
                                         PartCase{"bracket_bent", "fix_y_high", "--fix y-high --load x-high:50N:-y"}));

}  // namespace
}  // namespace sprung
