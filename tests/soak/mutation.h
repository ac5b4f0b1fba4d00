#pragma once
#include <cstdint>
#include <random>
#include <string>

namespace sprung::test {

/// The bytes of a file after one to four random damages: cut short, bits flipped, bytes inserted, taken out or doubled,
/// a piece of `other` put in, a number blown up. The same for the same state of the generator.
[[nodiscard]] std::string mutated(std::string bytes, const std::string& other, std::mt19937_64& random);

}  // namespace sprung::test
