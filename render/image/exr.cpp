#include "render/image/exr.h"

#include <fmt/format.h>
#include <tinyexr.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/types.h"
#include "render/image/cryptomatte.h"

namespace sprung {

namespace {

struct Channel {
  std::string name;
  Passes::Plane* plane;
};

/// R, G, B, A of the layers of mattes: a number and its coverage, twice.
std::vector<Channel> matte_channels(std::array<Passes::Plane, Passes::kRanks>& numbers, Passes& passes) {
  std::vector<Channel> channels;
  for (std::size_t rank = 0; rank < Passes::kRanks; ++rank) {
    const std::string layer = fmt::format("CryptoObject{:02}.", rank / 2);
    channels.push_back({layer + (rank % 2 == 0 ? "R" : "B"), &numbers[rank]});
    channels.push_back({layer + (rank % 2 == 0 ? "G" : "A"), &passes.coverage[rank]});
  }
  return channels;
}

/// All of them, sorted by name, as the format requires. `numbers`: the mattes as Cryptomatte writes them.
std::vector<Channel> channels_of(Passes& passes, std::array<Passes::Plane, Passes::kRanks>& numbers) {
  std::vector<Channel> channels{{"R", &passes.beauty[0]},
                                {"G", &passes.beauty[1]},
                                {"B", &passes.beauty[2]},
                                {"A", &passes.beauty[3]},
                                {"AO.X", &passes.occlusion},
                                {"Shadow.X", &passes.shadow},
                                {"Depth.Z", &passes.depth},
                                {"IndexOB.X", &passes.id},
                                {"Normal.X", &passes.normal[0]},
                                {"Normal.Y", &passes.normal[1]},
                                {"Normal.Z", &passes.normal[2]},
                                {"Position.X", &passes.position[0]},
                                {"Position.Y", &passes.position[1]},
                                {"Position.Z", &passes.position[2]},
                                {"UV.A", &passes.uv[2]},
                                {"UV.U", &passes.uv[0]},
                                {"UV.V", &passes.uv[1]},
                                {"Vector.W", &passes.motion[3]},
                                {"Vector.X", &passes.motion[0]},
                                {"Vector.Y", &passes.motion[1]},
                                {"Vector.Z", &passes.motion[2]}};
  const std::vector<Channel> mattes = matte_channels(numbers, passes);
  channels.insert(channels.end(), mattes.begin(), mattes.end());
  std::sort(channels.begin(), channels.end(), [](const Channel& a, const Channel& b) { return a.name < b.name; });
  return channels;
}

/// The mattes by the numbers of their names; 0 if there is nothing.
std::array<Passes::Plane, Passes::kRanks> numbers_of(const Passes& passes) {
  std::vector<float> by_id;
  for (const std::string& name : passes.names) by_id.push_back(matte_number(name));
  std::array<Passes::Plane, Passes::kRanks> numbers;
  for (std::size_t rank = 0; rank < Passes::kRanks; ++rank) {
    for (const float id : passes.matte[rank]) {
      numbers[rank].push_back(id >= 0 && std::size_t(id) < by_id.size() ? by_id[std::size_t(id)] : 0);
    }
  }
  return numbers;
}

/// The other way round.
void find_ids(const std::array<Passes::Plane, Passes::kRanks>& numbers, Passes& passes) {
  std::map<float, float> ids;
  for (std::size_t id = 0; id < passes.names.size(); ++id) ids[matte_number(passes.names[id])] = float(id);
  for (std::size_t rank = 0; rank < Passes::kRanks; ++rank) {
    for (std::size_t i = 0; i < numbers[rank].size(); ++i) {
      const auto known = ids.find(numbers[rank][i]);
      passes.matte[rank][i] = known == ids.end() ? -1 : known->second;
    }
  }
}

EXRAttribute text_attribute(const std::string& name, std::string& value) {
  EXRAttribute attribute{};
  std::strncpy(attribute.name, name.c_str(), sizeof(attribute.name) - 1);
  std::strncpy(attribute.type, "string", sizeof(attribute.type) - 1);
  attribute.value = reinterpret_cast<unsigned char*>(value.data());
  attribute.size = int(value.size());
  return attribute;
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
  std::array<Passes::Plane, Passes::kRanks> numbers = passes.coverage;
  for (const Channel& wanted : channels_of(passes, numbers)) {
    int found = 0;
    while (found < header.num_channels && header.channels[found].name != wanted.name) ++found;
    if (found == header.num_channels || header.pixel_types[found] != TINYEXR_PIXELTYPE_FLOAT) {
      fail_reading(file, "it has no channel of floats " + wanted.name);
    }
    std::memcpy(wanted.plane->data(), image.images[found], wanted.plane->size() * sizeof(float));
  }
  for (int i = 0; i < header.num_custom_attributes; ++i) {
    const EXRAttribute& attribute = header.custom_attributes[i];
    if (!std::string_view(attribute.name).ends_with("/manifest")) continue;
    passes.names = names_in_manifest({reinterpret_cast<const char*>(attribute.value), std::size_t(attribute.size)});
  }
  find_ids(numbers, passes);
  return passes;
}

}  // namespace

void write_exr(const Passes& passes, const std::filesystem::path& file) {
  std::array<Passes::Plane, Passes::kRanks> numbers = numbers_of(passes);
  // The library's structs have no const.
  const std::vector<Channel> channels =
      channels_of(const_cast<Passes&>(passes), numbers);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  std::vector<EXRChannelInfo> infos(channels.size());
  std::vector<int> types(channels.size(), TINYEXR_PIXELTYPE_FLOAT);
  std::vector<unsigned char*> planes(channels.size());
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::strncpy(infos[i].name, channels[i].name.c_str(), sizeof(infos[i].name) - 1);
    planes[i] = reinterpret_cast<unsigned char*>(channels[i].plane->data());
  }
  std::vector<std::pair<std::string, std::string>> metadata = matte_metadata(passes.names);
  std::vector<EXRAttribute> attributes;
  attributes.reserve(metadata.size());
  for (auto& [name, value] : metadata) attributes.push_back(text_attribute(name, value));
  EXRHeader header{};
  InitEXRHeader(&header);
  header.num_channels = isize(channels);
  header.channels = infos.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.custom_attributes = attributes.data();
  header.num_custom_attributes = isize(attributes);
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
