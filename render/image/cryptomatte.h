#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sprung {

/// MurmurHash3 (x86, 32 bits, seed 0) of A. Appleby, by which Cryptomatte identifies names.
[[nodiscard]] std::uint32_t murmur_hash(std::string_view text);

/// A name as a number in a picture: the bits of its hash as a float that is neither denormal nor infinite nor NaN.
/// Source: J. Friedman and A. C. Jones, Cryptomatte specification 1.2.0 (2018).
[[nodiscard]] float matte_number(std::string_view name);

/// Keys and values of a file's metadata for the mattes of these names in layers CryptoObject00, CryptoObject01, ...
[[nodiscard]] std::vector<std::pair<std::string, std::string>> matte_metadata(const std::vector<std::string>& names);

/// The names in such a manifest, in its order.
[[nodiscard]] std::vector<std::string> names_in_manifest(std::string_view manifest);

}  // namespace sprung
