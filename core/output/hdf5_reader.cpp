#include <numeric>

#include "core/error.h"
#include "core/output/hdf5_file.h"
#include "core/output/hdf5_handle.h"

namespace sprung {

struct Hdf5Reader::Open {
  std::filesystem::path path;
  Hdf5Handle file;

  template <class Result>
  Result check(Result result, const std::string& name) const {
    if (result >= 0) return result;
    const std::string what = name.empty() ? "" : name + " of ";
    throw Error(ErrorKind::kBadInput, "cannot read " + what + "'" + path.string() + "': " + hdf5_reason());
  }

  [[nodiscard]] Hdf5Handle set(const std::string& name) const {
    return {check(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), name), H5Dclose};
  }
};

Hdf5Reader::Hdf5Reader(std::filesystem::path file) : open_(std::make_unique<Open>()) {
  open_->path = std::move(file);
  const Hdf5Handle access = hdf5_access();
  // As a reader beside a writer, whether there still is one or not: a writer that was killed leaves its mark.
  const hid_t id = H5Fopen(open_->path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.get());
  open_->file = {open_->check(id, ""), H5Fclose};
}

Hdf5Reader::~Hdf5Reader() = default;
Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;
Hdf5Reader& Hdf5Reader::operator=(Hdf5Reader&&) noexcept = default;

bool Hdf5Reader::has(const std::string& name) const {
  for (auto slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
    if (H5Lexists(open_->file.get(), name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

ArrayShape Hdf5Reader::shape_of(const std::string& name) const {
  const Hdf5Handle set = open_->set(name);
  const Hdf5Handle space(open_->check(H5Dget_space(set.get()), name), H5Sclose);
  std::vector<hsize_t> counts(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
  H5Sget_simple_extent_dims(space.get(), counts.data(), nullptr);
  return {counts.begin(), counts.end()};
}

template <class Value>
Array<Value> Hdf5Reader::read(const std::string& name) const {
  Array<Value> array{.shape = shape_of(name), .values = {}};
  const Hdf5Handle set = open_->set(name);
  array.values.resize(std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>()));
  if (array.values.empty()) return array;
  open_->check(H5Dread(set.get(), hdf5_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()), name);
  return array;
}

template <class Value>
Array<Value> Hdf5Reader::read_row(const std::string& name, std::size_t row) const {
  const ArrayShape whole = shape_of(name);
  Array<Value> array{.shape = ArrayShape(whole.begin() + 1, whole.end()), .values = {}};
  array.values.resize(std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>()));
  if (array.values.empty()) return array;
  const Hdf5Handle set = open_->set(name);
  const Hdf5Handle space(open_->check(H5Dget_space(set.get()), name), H5Sclose);
  std::vector<hsize_t> start(whole.size(), 0);
  std::vector<hsize_t> count(whole.begin(), whole.end());
  start[0] = row;
  count[0] = 1;
  H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Hdf5Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  open_->check(H5Dread(set.get(), hdf5_type<Value>(), memory.get(), space.get(), H5P_DEFAULT, array.values.data()),
               name);
  return array;
}

std::string Hdf5Reader::read_text(const std::string& name) const {
  const Hdf5Handle set = open_->set(name);
  const Hdf5Handle type(open_->check(H5Dget_type(set.get()), name), H5Tclose);
  std::string text(H5Tget_size(type.get()), '\0');
  open_->check(H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), name);
  return text.substr(0, text.find('\0'));
}

std::vector<std::string> Hdf5Reader::read_texts(const std::string& name) const {
  const std::size_t count = shape_of(name).at(0);
  const Hdf5Handle set = open_->set(name);
  const Hdf5Handle type(open_->check(H5Dget_type(set.get()), name), H5Tclose);
  const std::size_t width = H5Tget_size(type.get());
  std::string all(count * width, '\0');
  if (count > 0) open_->check(H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), name);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string padded = all.substr(i * width, width);
    texts.push_back(padded.substr(0, padded.find('\0')));
  }
  return texts;
}

template Array<double> Hdf5Reader::read(const std::string&) const;
template Array<float> Hdf5Reader::read(const std::string&) const;
template Array<int> Hdf5Reader::read(const std::string&) const;
template Array<std::uint8_t> Hdf5Reader::read(const std::string&) const;
template Array<std::uint64_t> Hdf5Reader::read(const std::string&) const;
template Array<double> Hdf5Reader::read_row(const std::string&, std::size_t) const;
template Array<std::uint64_t> Hdf5Reader::read_row(const std::string&, std::size_t) const;

}  // namespace sprung
