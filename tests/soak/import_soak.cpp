#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <fstream>
#include <map>
#include <sstream>

#include "core/error.h"
#include "core/mesh/io/read_mesh.h"
#include "tests/external/external_mesh.h"
#include "tests/soak/mesh_corpus.h"
#include "tests/soak/mutation.h"
#include "tests/soak/trials.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"

namespace sprung::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestMesh = 100'000;                   // bytes of a mesh that is worth many mutations
constexpr long kMaxKilobytes = kSanitized ? LONG_MAX : 1'000'000;  // readers have no limit of memory under ASan
constexpr double kMaxSeconds = 20;  // the limit of time of the reader, with some room on a busy machine

struct Options : Trials {
  std::string corpus;
};

struct Sample {
  std::string extension;
  std::string bytes;
};

std::string bytes_of(const fs::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

std::vector<Sample> samples_in(const TempFolder& folder) {
  std::vector<fs::path> files = write_mesh_corpus(folder.path());
  for (const fs::path& file : files) static_cast<void>(read_mesh(file));  // throws if one is not a sound file at all
  if (fs::exists(external_mesh(""))) {
    for (const auto& entry : fs::recursive_directory_iterator(external_mesh(""))) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || entry.file_size() > kLargestMesh) continue;
      if (extension != ".md" && extension != ".png" && extension != ".txt") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<Sample> samples;
  for (const fs::path& file : files) samples.push_back({file.extension().string(), bytes_of(file)});
  return samples;
}

long peak_kilobytes(decltype(RUSAGE_SELF) whose) {
  rusage usage{};
  getrusage(whose, &usage);
  return usage.ru_maxrss;
}

/// How reading ended, in one word; `fault` describes what must not happen.
std::string read(const fs::path& file, std::string& fault) {
  try {
    static_cast<void>(read_mesh(file));
    return "read";
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool is_clear = message.starts_with(file.string() + ":") && message.find('\n') == std::string::npos;
    if (!is_clear || error.kind() != ErrorKind::kBadInput) fault = "not one clear line: " + message;
    if (message.find("crashed") != std::string::npos) return "reader crashed";
    if (message.find("gave up") != std::string::npos) return "took too long";
    if (message.find("of memory") != std::string::npos) return "took too much memory";
    return "refused";
  }
}

class Soak {
 public:
  explicit Soak(const Options& options) : options_(options), samples_(samples_in(folder_)) {}

  /// How many mutations failed.
  int run() {
    for (std::uint32_t i = options_.first; i < options_.first + options_.count; ++i) read_one(i);
    fmt::print("seed {}: {} mutations of {} files:", options_.seed, options_.count, std::ssize(samples_));
    for (const auto& [outcome, count] : outcomes_) fmt::print(" {} {},", outcome, count);
    fmt::print(" {} failed; {:.2f} ms a file, the longest {:.2f} s; most memory {} MB, of the readers {} MB\n", failed_,
               1000 * seconds_ / std::max(1U, options_.count), longest_, peak_kilobytes(RUSAGE_SELF) / 1000,
               peak_kilobytes(RUSAGE_CHILDREN) / 1000);
    return failed_;
  }

 private:
  void read_one(std::uint32_t index) {
    std::seed_seq sequence{options_.seed, index};
    std::mt19937_64 random(sequence);
    const Sample& sample = samples_[random() % samples_.size()];
    const Sample& other = samples_[random() % samples_.size()];
    const fs::path file = folder_.path() / ("mutant" + sample.extension);
    std::ofstream(file, std::ios::binary) << mutated(sample.bytes, other.bytes, random);

    std::string fault;
    const auto start = std::chrono::steady_clock::now();
    const std::string outcome = read(file, fault);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > kMaxSeconds) fault = fmt::format("took {:.1f} s", seconds);
    const long memory = std::max(peak_kilobytes(RUSAGE_SELF), peak_kilobytes(RUSAGE_CHILDREN));
    if (memory > kMaxKilobytes) fault = fmt::format("took {} MB", memory / 1000);

    ++outcomes_[outcome];
    seconds_ += seconds;
    longest_ = std::max(longest_, seconds);
    failed_ += fault.empty() ? 0 : 1;
    if (options_.verbose || !fault.empty()) {
      fmt::print("seed {} mutation {} of a {} file: {} in {:.3f} s {}\n", options_.seed, index, sample.extension,
                 outcome, seconds, fault);
    }
    std::fflush(stdout);
  }

  Options options_;
  TempFolder folder_;
  std::vector<Sample> samples_;
  std::map<std::string, int> outcomes_;
  int failed_ = 0;
  double seconds_ = 0;
  double longest_ = 0;
};

}  // namespace
}  // namespace sprung::test

int main(int argc, char** argv) {
  sprung::test::Options options;
  options.count = 1000;
  CLI::App app(
      "Reads randomly damaged mesh files and fails where one crashes the program, takes over 20 s or 1 GB, or is "
      "refused by anything but one clear line.");
  options.add_options(app, "mutation");
  app.add_option("--write-corpus", options.corpus, "only write the undamaged files into this folder");
  CLI11_PARSE(app, argc, argv);
  if (options.corpus.empty()) return sprung::test::Soak(options).run() == 0 ? 0 : 1;
  std::filesystem::create_directories(options.corpus);
  fmt::print("wrote {} files\n", sprung::test::write_mesh_corpus(options.corpus).size());
  return 0;
}
