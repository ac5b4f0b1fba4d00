#include "app/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.h"
#include "render/film.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> kOtherFiles{".avi", ".mov",  ".mkv",  ".jpg",  ".jpeg", ".exr", ".bmp",
                                                       ".tga", ".tiff", ".webp", ".apng", ".m4v",  ".h5",  ".obj"};

[[noreturn]] void refuse(std::string_view words, std::string_view reason) {
  throw Error(ErrorKind::kUsage,
              fmt::format("--output {}: {}; give a folder, a pattern like frame_{{:04}}.png, or a film (.mp4, .webm, "
                          ".gif)",
                          words, reason));
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// The number of digits in "{:04}", "{:04d}", "{:4}", "{}", "{:d}".
int digits_of(std::string_view words, std::string_view inside) {
  if (inside.starts_with(':')) inside.remove_prefix(1);
  if (inside.ends_with('d')) inside.remove_suffix(1);
  if (inside.empty()) return 0;
  const bool is_number = std::all_of(inside.begin(), inside.end(), [](char c) { return c >= '0' && c <= '9'; });
  const int digits = is_number && inside.size() <= 2 ? std::stoi(std::string(inside)) : -1;
  if (digits < 0 || digits > 9) refuse(words, "the number's place must look like {:04}");
  return digits;
}

Output parse_pattern(std::string_view words) {
  const fs::path path(words);
  const std::string name = path.filename().string();
  const auto open = name.find('{');
  const auto close = name.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) {
    refuse(words, "the number's place must stand in the file's name");
  }
  Output output;
  output.folder = path.parent_path();
  output.before = name.substr(0, open);
  output.after = name.substr(close + 1);
  output.digits = digits_of(words, std::string_view(name).substr(open + 1, close - open - 1));
  if (output.after.find_first_of("{}") != std::string::npos) refuse(words, "a name has one number");
  if (lower(fs::path(output.after).extension().string()) != ".png" && lower(output.after) != ".png") {
    refuse(words, "pictures are PNG files");
  }
  return output;
}

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

fs::path or_here(const fs::path& folder) { return folder.empty() ? fs::path(".") : folder; }

/// Without making anything: the folder, or the nearest one above it that exists, can be written.
void check_folder(const fs::path& folder) {
  fs::path existing = fs::absolute(or_here(folder)).lexically_normal();
  while (!fs::exists(existing) && existing.has_parent_path() && existing != existing.parent_path()) {
    existing = existing.parent_path();
  }
  if (!fs::is_directory(existing)) {
    throw Error(ErrorKind::kFailed,
                fmt::format("cannot write to '{}': '{}' is not a folder", folder.string(), existing.string()));
  }
  if (access(existing.c_str(), W_OK) != 0) {
    throw Error(ErrorKind::kFailed,
                fmt::format("cannot write to '{}': no permission in '{}'", folder.string(), existing.string()));
  }
}

}  // namespace

fs::path Output::picture(int number) const { return folder / fmt::format("{}{:0{}}{}", before, number, digits, after); }

Output parse_output(std::string_view words) {
  if (words.empty()) refuse("''", "the name is empty");
  const bool is_folder = words.ends_with('/');
  if (!is_folder && words.find_first_of("{}") != std::string_view::npos) return parse_pattern(words);
  const fs::path path(words);
  if (!is_folder && is_film(path)) return {.kind = Output::Kind::kFilm, .folder = path.parent_path(), .film = path};
  const std::string ending = lower(path.extension().string());
  if (!is_folder && ending == ".png") refuse(words, "a single picture cannot hold a film");
  if (!is_folder && std::find(kOtherFiles.begin(), kOtherFiles.end(), ending) != kOtherFiles.end()) {
    refuse(words, fmt::format("'{}' files cannot be written", ending));
  }
  return {.kind = Output::Kind::kPictures, .folder = path, .before = "frame_", .after = ".png", .digits = 4};
}

std::vector<fs::path> existing_pictures(const Output& output) {
  std::vector<fs::path> found;
  if (output.kind != Output::Kind::kPictures || !fs::is_directory(or_here(output.folder))) return found;
  for (const fs::directory_entry& entry : fs::directory_iterator(or_here(output.folder))) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= output.before.size() + output.after.size()) continue;
    if (!name.starts_with(output.before) || !name.ends_with(output.after)) continue;
    const auto digits = name.size() - output.before.size() - output.after.size();
    if (is_number(std::string_view(name).substr(output.before.size(), digits))) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

void check_output(const Output& output, bool overwrite) {
  check_folder(output.folder);
  if (output.kind == Output::Kind::kFilm) {
    require_ffmpeg();
    if (fs::is_directory(output.film)) refuse(output.film.string(), "it is a folder");
    if (!overwrite && fs::exists(output.film)) {
      throw Error(ErrorKind::kUsage, fmt::format("'{}' exists; say --overwrite to replace it", output.film.string()));
    }
    return;
  }
  const std::vector<fs::path> pictures = existing_pictures(output);
  if (!overwrite && !pictures.empty()) {
    throw Error(ErrorKind::kUsage, fmt::format("'{}' and {} more pictures exist; say --overwrite to replace them",
                                               pictures.front().string(), pictures.size() - 1));
  }
}

}  // namespace sprung
