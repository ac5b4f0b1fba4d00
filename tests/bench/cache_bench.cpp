// Writes the frames of a cache into new ones, to the last bit and with errors of a fraction of the film's size, reads
// them back, and prints kilobytes per frame and megabytes of positions and velocities per second of processor time.
// Argument: a cache (.h5).
#include <fmt/format.h>

#include <ctime>

#include "core/error.h"
#include "core/simulation/cache.h"

namespace {

using namespace sprung;

struct Frames {
  std::vector<CachedFrame> frames;
  std::vector<std::vector<Points>> positions;
  std::vector<std::vector<Points>> velocities;
  double megabytes = 0;  // as they are in memory
};

Frames frames_of(const CacheReader& cache) {
  Frames all;
  for (std::size_t frame = 0; frame < cache.frame_count(); ++frame) {
    all.frames.push_back(cache.frame(frame));
    all.positions.push_back(cache.positions(frame));
    all.velocities.push_back(cache.velocities(frame));
    for (const Points& points : all.positions.back()) all.megabytes += 2e-6 * sizeof(double) * double(points.size());
  }
  return all;
}

std::vector<const Points*> addresses(const std::vector<Points>& all) {
  std::vector<const Points*> list;
  for (const Points& points : all) list.push_back(&points);
  return list;
}

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

void write(const std::filesystem::path& file, const CacheHeader& header, const Frames& all) {
  CacheWriter writer(file, header, 0);
  for (std::size_t i = 0; i < all.frames.size(); ++i) {
    writer.append(all.frames[i], addresses(all.positions[i]), addresses(all.velocities[i]), {});
  }
  writer.publish();
  writer.close();
}

double size_of(const std::filesystem::path& file) { return double(std::filesystem::file_size(file)); }

void print_row(const std::filesystem::path& file, CacheHeader header, const Frames& all, double share, double fps) {
  header.position_error = share * header.simulation.size;
  header.velocity_error = header.position_error * fps;
  const double begin = processor_seconds();
  write(file, header, all);
  const double written = processor_seconds();
  const CacheReader reader(file);
  for (std::size_t frame = 0; frame < reader.frame_count(); ++frame) {
    static_cast<void>(reader.positions(frame));
    static_cast<void>(reader.velocities(frame));
  }
  const double read = processor_seconds();
  const double bytes = size_of(file);
  write(file, header, {});
  const double bytes_of_frames = bytes - size_of(file);
  const std::string error = share > 0 ? fmt::format("{:g} of the size", share) : "none";
  fmt::print("| {} | {:.0f} | {:.0f} | {:.1f} | {:.0f} | {:.0f} |\n", error, 1e-3 * (bytes - bytes_of_frames),
             1e-3 * bytes_of_frames / double(all.frames.size()), 1e6 * all.megabytes / bytes_of_frames,
             all.megabytes / (written - begin), all.megabytes / (read - written));
  std::filesystem::remove(file);
}

void print_table(const std::filesystem::path& file) {
  const CacheReader cache(file);
  const Frames all = frames_of(cache);
  const double fps = all.frames.size() > 1 ? 1 / (all.frames[1].progress - all.frames[0].progress) : 24;
  long nodes = 0;
  for (const SoftBody& body : cache.header().simulation.world.bodies) nodes += body.grid.node_count();
  fmt::print("{} nodes, {} frames\n", nodes, all.frames.size());
  fmt::print(
      "| error allowed | kB without frames | kB a frame | times smaller than in memory | MB/s written | MB/s read |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  std::filesystem::path trial = file;
  trial += ".bench.h5";
  for (const double share : {0.0, 1e-6, 1e-5, 1e-4}) print_row(trial, cache.header(), all, share, fps);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: cache_bench RUN.h5\n");
    return 2;
  }
  try {
    print_table(argv[1]);
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
