#include "render/image/exr.h"

#include <tinyexr.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/files.h"
#include "core/types.h"

namespace sprung {

namespace {

struct Channel {
  const char* name;
  Passes::Plane* plane;
};

/// Sorted by name, as the format requires.
std::array<Channel, 14> channels_of(Passes& passes) {
  return {{{"Depth.Z", &passes.depth},
           {"IndexOB.X", &passes.id},
           {"Normal.X", &passes.normal[0]},
           {"Normal.Y", &passes.normal[1]},
           {"Normal.Z", &passes.normal[2]},
           {"Position.X", &passes.position[0]},
           {"Position.Y", &passes.position[1]},
           {"Position.Z", &passes.position[2]},
           {"UV.U", &passes.uv[0]},
           {"UV.V", &passes.uv[1]},
           {"Vector.W", &passes.motion[3]},
           {"Vector.X", &passes.motion[0]},
           {"Vector.Y", &passes.motion[1]},
           {"Vector.Z", &passes.motion[2]}}};
}

/// The library's message, which the caller must free.
std::string taken(const char* message) {
  std::string text = message == nullptr ? "unknown reason" : message;
  FreeEXRErrorMessage(message);
  return text;
}

struct FileHeader : EXRHeader {
  FileHeader() : EXRHeader() { InitEXRHeader(this); }
  ~FileHeader() { FreeEXRHeader(this); }
  FileHeader(const FileHeader&) = delete;
  FileHeader& operator=(const FileHeader&) = delete;
};

struct FileImage : EXRImage {
  FileImage() : EXRImage() { InitEXRImage(this); }
  ~FileImage() { FreeEXRImage(this); }
  FileImage(const FileImage&) = delete;
  FileImage& operator=(const FileImage&) = delete;
};

[[noreturn]] void fail_reading(const std::filesystem::path& file, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, file.string() + ": cannot read the passes: " + reason);
}

Passes passes_of(const EXRHeader& header, const EXRImage& image, const std::filesystem::path& file) {
  Passes passes(image.width, image.height);
  for (const Channel& wanted : channels_of(passes)) {
    int found = 0;
    while (found < header.num_channels && std::strcmp(header.channels[found].name, wanted.name) != 0) ++found;
    if (found == header.num_channels || header.pixel_types[found] != TINYEXR_PIXELTYPE_FLOAT) {
      fail_reading(file, std::string("it has no channel of floats ") + wanted.name);
    }
    std::memcpy(wanted.plane->data(), image.images[found], wanted.plane->size() * sizeof(float));
  }
  return passes;
}

}  // namespace

void write_exr(const Passes& passes, const std::filesystem::path& file) {
  // The library's structs have no const.
  auto channels = channels_of(const_cast<Passes&>(passes));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  std::array<EXRChannelInfo, channels.size()> infos{};
  std::array<int, channels.size()> types{};
  std::array<unsigned char*, channels.size()> planes{};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::strncpy(infos[i].name, channels[i].name, sizeof(infos[i].name) - 1);
    types[i] = TINYEXR_PIXELTYPE_FLOAT;
    planes[i] = reinterpret_cast<unsigned char*>(channels[i].plane->data());
  }
  EXRHeader header{};
  InitEXRHeader(&header);
  header.num_channels = isize(channels);
  header.channels = infos.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  EXRImage image{};
  InitEXRImage(&image);
  image.images = planes.data();
  image.width = passes.width;
  image.height = passes.height;
  image.num_channels = header.num_channels;

  PartialFile partial(file);
  const char* message = nullptr;
  if (SaveEXRImageToFile(&image, &header, partial.path().c_str(), &message) != TINYEXR_SUCCESS) {
    throw Error(ErrorKind::kFailed, "cannot write '" + file.string() + "': " + taken(message));
  }
  partial.publish();
}

Passes read_exr(const std::filesystem::path& file) {
  EXRVersion version{};
  if (ParseEXRVersionFromFile(&version, file.c_str()) != TINYEXR_SUCCESS) fail_reading(file, "it is no OpenEXR file");
  const char* message = nullptr;
  FileHeader header;
  if (ParseEXRHeaderFromFile(&header, &version, file.c_str(), &message) != TINYEXR_SUCCESS) {
    fail_reading(file, taken(message));
  }
  FileImage image;
  if (LoadEXRImageFromFile(&image, &header, file.c_str(), &message) != TINYEXR_SUCCESS) {
    fail_reading(file, taken(message));
  }
  return passes_of(header, image, file);
}

}  // namespace sprung
