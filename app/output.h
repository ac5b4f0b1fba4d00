#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// Where pictures go: numbered PNG files in a folder, or a film; or where their passes go, numbered EXR files.
struct Output {
  enum class Kind { kPictures, kPasses, kFilm };
  Kind kind = Kind::kPictures;
  std::filesystem::path folder{};  // that the pictures or the film lie in
  std::string before{};            // a picture's name is before + number + after
  std::string after{};
  int digits = 0;                // leading zeros up to that many digits
  std::filesystem::path film{};  // the file of a film

  /// The file of the picture, or of its passes, with this number; the first is 1.
  [[nodiscard]] std::filesystem::path picture(int number) const;
};

/// Throws Error(kUsage) where the words after --output, which name none of the files with these endings, look like a
/// file and not like a folder: "film.xyz", unless there is such a folder. `examples` says what to give.
void check_folder_name(std::string_view words, std::span<const std::string_view> endings, std::string_view examples);

/// What the words after --output mean: "dir/" or "dir" (frame_0001.png ... in it), "dir/f_{:04}.png" or "{:04d}" or
/// "{}", the same with ".exr", "film.mp4", ".webm", ".gif". Throws Error(kUsage) for a name with any other ending,
/// unless such a folder exists.
[[nodiscard]] Output parse_output(std::string_view words);

/// All of them. Throws Error(kUsage) where two are the same place in whatever spelling.
[[nodiscard]] std::vector<Output> parse_outputs(const std::vector<std::string>& words);

/// The numbered pictures of this output that exist, in order of their names.
[[nodiscard]] std::vector<std::filesystem::path> existing_pictures(const Output& output);

/// Throws where the output cannot be made, before any work is lost: Error(kUsage) where it exists and `overwrite` is
/// not set, Error(kFailed) where its folder cannot be made or written, or a film's ffmpeg is missing. Leaves nothing.
void check_output(const Output& output, bool overwrite);

}  // namespace sprung
