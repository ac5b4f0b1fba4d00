#include "core/mesh/io/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/error.h"

namespace sprung {
namespace {

constexpr std::string_view kSpace = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// A word of a damaged file for a message: shortened, without control characters.
std::string quoted(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string quote(word.substr(0, kMost));
  for (char& c : quote) {
    if (c < ' ' || c > '~') c = '?';
  }
  return word.size() > kMost ? quote + "..." : quote;
}

}  // namespace

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

std::string Named::text() const { return number > 0 ? fmt::format("{} {}", thing, number) : std::string(thing); }

TextScanner::TextScanner(std::string_view text, std::string name, long lines_before)
    : text_(text),
      name_(std::move(name)),
      line_end_(text.find('\n') == std::string_view::npos ? '\r' : '\n'),
      line_(lines_before),
      lines_taken_(lines_before) {}

void TextScanner::take_line() {
  const std::size_t end = std::min(text_.find(line_end_), text_.size());
  whole_ = trimmed(text_.substr(0, end));
  text_.remove_prefix(std::min(end + 1, text_.size()));
  ++lines_taken_;
}

bool TextScanner::next_line() {
  while (!text_.empty()) {
    line_ = lines_taken_ + 1;
    take_line();
    if (whole_.ends_with('\\')) {
      joined_.clear();
      while (whole_.ends_with('\\')) {
        joined_.append(whole_.substr(0, whole_.size() - 1)).append(" ");
        take_line();
      }
      joined_.append(whole_);
      whole_ = trimmed(joined_);
    }
    left_ = trimmed(whole_.substr(0, whole_.find('#')));
    if (!left_.empty()) return true;
  }
  left_ = {};
  whole_ = {};
  return false;
}

std::string_view TextScanner::word() {
  const std::size_t end = std::min(left_.find_first_of(kSpace), left_.size());
  const std::string_view found = left_.substr(0, end);
  left_ = left_.substr(std::min(left_.find_first_not_of(kSpace, end), left_.size()));
  return found;
}

std::string_view TextScanner::word_ahead() {
  const std::string_view found = word();
  if (!found.empty()) return found;
  return next_line() ? word() : std::string_view{};
}

std::string_view TextScanner::rest() {
  if (left_.empty()) return {};
  const std::size_t begin = left_.data() - whole_.data();
  left_ = {};
  return whole_.substr(begin);
}

double TextScanner::number(const Named& what) {
  const std::string_view found = word();
  if (found.empty()) refuse(fmt::format("{} is cut short: a number is missing", what.text()));
  const auto value = number_of(found);
  if (!value) refuse(fmt::format("{} holds '{}', which is not a number", what.text(), quoted(found)));
  return *value;
}

double TextScanner::number_ahead(const Named& what) {
  if (left_.empty() && !next_line()) refuse(fmt::format("the file ends before {}: it is cut short", what.text()));
  return number(what);
}

long TextScanner::integer_ahead(const Named& what) {
  constexpr double kMost = 0x1p53;
  const double value = number_ahead(what);
  if (!(std::abs(value) <= kMost) || value != std::floor(value)) {
    refuse(fmt::format("{} holds {}, which is not a whole number", what.text(), value));
  }
  return long(value);
}

void TextScanner::refuse(const std::string& reason) const {
  throw Error(ErrorKind::kBadInput, fmt::format("{}:{}: {}", name_, line_, reason));
}

}  // namespace sprung
