#include "tests/soak/mutation.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace sprung::test {
namespace {

/// At most `most`, small values as often as large ones.
std::size_t size_up_to(std::size_t most, std::mt19937_64& random) {
  const std::size_t bound = most >> random() % 16;
  return bound == 0 ? 0 : random() % (bound + 1);
}

/// A number in a text, or four bytes of a binary file, becomes one that no program expects.
void blow_up_number(std::string& bytes, std::size_t at, std::mt19937_64& random) {
  static const std::array<std::string, 10> kWords{
      "4294967295", "99999999999999", "-1", "nan", "1e308", "-1e-320", "0", "inf", "2147483648", "65536"};
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto begin = std::find_if(bytes.begin() + std::ptrdiff_t(at), bytes.end(), is_digit);
  const bool is_near = begin - bytes.begin() - std::ptrdiff_t(at) < 20 && begin != bytes.end();
  if (is_near && random() % 4 != 0) {
    bytes.replace(begin, std::find_if_not(begin, bytes.end(), is_digit), kWords[random() % kWords.size()]);
    return;
  }
  static const std::array<std::string, 4> kBinary{"\xFF\xFF\xFF\xFF", "\xFF\xFF\xFF\x7F", std::string(4, '\0'),
                                                  std::string("\0\0\xC0\x7F", 4)};
  bytes.replace(at, 4, kBinary[random() % kBinary.size()]);
}

void mutate(std::string& bytes, const std::string& other, std::mt19937_64& random) {
  const std::size_t at = random() % bytes.size();
  const std::size_t length = size_up_to(bytes.size() - at, random);
  switch (random() % 8) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 << random() % 8));
      break;
    case 2:
      bytes[at] = static_cast<char>(random());
      break;
    case 3:
      for (std::size_t i = 0; i < std::min<std::size_t>(length, 64); ++i)
        bytes.insert(at, 1, static_cast<char>(random()));
      break;
    case 4:
      bytes.erase(at, length);
      break;
    case 5:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 6:
      bytes.replace(at, length, other.substr(random() % (other.size() + 1), length));
      break;
    default:
      blow_up_number(bytes, at, random);
  }
}

}  // namespace

std::string mutated(std::string bytes, const std::string& other, std::mt19937_64& random) {
  for (auto left = 1 + random() % 4; left > 0 && !bytes.empty(); --left) mutate(bytes, other, random);
  return bytes;
}

}  // namespace sprung::test
