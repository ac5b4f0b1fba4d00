#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace sprung {

/// Parses a whole word as a number, rounded to the nearest double in any locale; "nan" and "inf" are accepted, and
/// overflow is infinite. Nothing for any other word.
[[nodiscard]] std::optional<double> number_of(std::string_view word);

/// A text without a leading UTF-8 byte order mark.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

/// The subject of a message: "vertex 12", or the thing alone if it has no number.
struct Named {
  std::string_view thing;
  long number = 0;

  [[nodiscard]] std::string text() const;
};

/// The lines of a text and the words in them. Blank lines and comments from '#' to the end of the line are skipped.
class TextScanner {
 public:
  /// `name` is that of the file, for messages. The text must outlive the scanner. Lines end with LF or CR LF, or with
  /// CR alone in a text without any LF. `lines_before`: of the file, before the text.
  TextScanner(std::string_view text, std::string name, long lines_before = 0);
  TextScanner(const TextScanner&) = delete;
  TextScanner& operator=(const TextScanner&) = delete;

  /// Advances to the next line that contains a word; false at the end of the text. A backslash at the end of a line
  /// joins it with the next.
  bool next_line();
  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The next word of the line or, at its end, of the lines after; empty at the end of the text.
  std::string_view word_ahead();
  /// The rest of the line including comments, trimmed.
  std::string_view rest();
  /// The next word of the line as a number. Throws Error(kBadInput) for anything else.
  double number(const Named& what);
  /// The same, continuing on the lines after.
  double number_ahead(const Named& what);
  /// The same for an integer of at most 2^53.
  long integer_ahead(const Named& what);

  /// The number of the line, from 1.
  [[nodiscard]] long line() const { return line_; }
  /// The text after the line.
  [[nodiscard]] std::string_view after() const { return text_; }
  /// Throws Error(kBadInput) "name:line: reason".
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  void take_line();

  std::string_view text_;
  std::string name_;
  char line_end_;
  long line_;
  long lines_taken_;
  std::string_view whole_;  // of the line
  std::string_view left_;   // of the line without its comment
  std::string joined_;      // a line that was written as several
};

}  // namespace sprung
