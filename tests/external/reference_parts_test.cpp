#include "tests/external/external_mesh.h"
#include "tests/support/part_reference.h"

namespace sprung {
namespace {

class ExternalReferenceParts : public testing::TestWithParam<PartCase> {};

TEST_P(ExternalReferenceParts, DisplacementsStressesAndReactions) {
  expect_reference(GetParam(), test::external_mesh(""));
}

INSTANTIATE_TEST_SUITE_P(
    All, ExternalReferenceParts,
    testing::Values(PartCase{"plate_holes", "pull_x", "--fix x-low --load x-high:100N:+x"},
                    PartCase{"plate_holes", "bend_z", "--fix x-low --load x-high:10N:-z"},
                    PartCase{"large_block_obb", "bend_z",
                             "--fix box=-1e9,-5,-1e9,1e9,7.8,1e9 --load box=-1e9,2894.8,-1e9,1e9,2910,1e9:1000N:-z"},
                    PartCase{"large_block_obb", "push_x",
                             "--fix box=-1e9,-5,-1e9,1e9,7.8,1e9 --load box=-1e9,2894.8,-1e9,1e9,2910,1e9:1000N:+x"}));

}  // namespace
}  // namespace sprung
