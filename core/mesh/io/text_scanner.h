#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace sprung {

/// The number that a whole word is, rounded to the nearest double whatever the locale; "nan" and "inf" are numbers,
/// and one too large is infinite. Nothing where the word is anything else.
[[nodiscard]] std::optional<double> number_of(std::string_view word);

/// A text without the mark of UTF-8 that some programs put before it.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

/// What a message is about: "vertex 12", or the thing alone where it has no number.
struct Named {
  std::string_view thing;
  long number = 0;

  [[nodiscard]] std::string text() const;
};

/// The lines of a text and the words in them. Blank lines are passed over, and so is the rest of a line after '#'.
class TextScanner {
 public:
  /// `name` is that of the file, for messages. The text must outlive the scanner. Lines end with LF or CR LF, or with
  /// CR alone in a text without any LF. `lines_before`: of the file, before the text.
  TextScanner(std::string_view text, std::string name, long lines_before = 0);
  TextScanner(const TextScanner&) = delete;
  TextScanner& operator=(const TextScanner&) = delete;

  /// Goes to the next line that holds a word; false at the end of the text. A backslash at the end of a line joins it
  /// with the next.
  bool next_line();
  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The next word of the line or, at its end, of the lines after; empty at the end of the text.
  std::string_view word_ahead();
  /// What is left of the line, a '#' and what follows included, without blanks around it.
  std::string_view rest();
  /// The next word of the line as a number. Throws Error(kBadInput) where it is none;
  double number(const Named& what);
  /// The same of the lines after, too.
  double number_ahead(const Named& what);
  /// The same for a whole number of at most 2^53.
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
