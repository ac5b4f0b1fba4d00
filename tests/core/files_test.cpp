#include "core/files.h"

#include <gtest/gtest.h>

#include <span>
#include <string_view>

#include "tests/support/error_message.h"

namespace sprung {
namespace {

/// A file may vanish between the check that it can be read and the reading.
TEST(ReadFile, NamesAFileThatIsNotThere) {
  const std::string message = error_message(ErrorKind::kBadInput, [] { (void)read_file("no/such/mesh.ply"); });
  EXPECT_NE(message.find("no/such/mesh.ply"), std::string::npos) << message;
}

/// Values from the FNV reference: draft-eastlake-fnv, "Test Vectors".
TEST(Hash, IsTheReferences) {
  const auto hash = [](std::string_view text) { return hash_of(std::as_bytes(std::span(text.data(), text.size()))); };
  EXPECT_EQ(hash(""), 0xcbf29ce484222325U);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8U);
}

}  // namespace
}  // namespace sprung
