#include "core/io/hdf5_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <map>
#include <numeric>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/types.h"

namespace sprung {
namespace {

constexpr std::size_t kChunkBytes = 1 << 18;
constexpr unsigned kCompressionLevel = 1;  // higher levels gain little on positions

/// Owns an identifier of HDF5.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    if (this == &other) return *this;
    reset();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
    return *this;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  [[nodiscard]] hid_t get() const { return id_; }
  /// Never closes it.
  void abandon() { id_ = -1; }
  /// Closes; negative on failure.
  herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

constexpr std::string_view kSystemMessage = "error message = '";

/// Keeps the error message of the system if there is one, else the innermost description.
herr_t find_reason(unsigned depth, const H5E_error2_t* error, void* data) {
  std::string& reason = *static_cast<std::string*>(data);
  const std::string description = error->desc == nullptr ? "" : error->desc;
  const auto begin = description.find(kSystemMessage);
  if (begin != std::string::npos) {
    const auto first = begin + kSystemMessage.size();
    reason = description.substr(first, description.find('\'', first) - first);
    return 1;
  }
  if (depth == 0) reason = description;
  return 0;
}

/// "No space left on device" from the error stack of HDF5; else its own description.
std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_reason, &reason);
  if (reason.find("signature not found") != std::string::npos) return "it is not an HDF5 file, as caches are";
  if (reason.find("truncated file") != std::string::npos) return "it is cut short; copy it or simulate it again";
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

/// The type of a value in memory.
template <class Value>
hid_t hdf5_type() {
  if constexpr (std::is_same_v<Value, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Value, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<Value, int>) return H5T_NATIVE_INT;
  if constexpr (std::is_same_v<Value, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<Value, std::uint64_t>) return H5T_NATIVE_UINT64;
}

/// Access without HDF5's own file locks, which network file systems refuse, and without messages on stderr.
Hdf5Handle hdf5_access() {
  H5dont_atexit();  // else it would close what was abandoned
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_file_locking(access.get(), 0, 1);
  return access;
}

std::vector<hsize_t> sizes(const ArrayShape& shape) { return {shape.begin(), shape.end()}; }

std::size_t product(std::span<const std::size_t> counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{1}, std::multiplies<>());
}

Hdf5Handle space_of(const ArrayShape& shape) {
  const std::vector<hsize_t> counts = sizes(shape);
  return {H5Screate_simple(isize(counts), counts.data(), nullptr), H5Sclose};
}

/// Creates missing groups on the way to a name.
Hdf5Handle link_properties() {
  Hdf5Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties.get(), 1);
  return properties;
}

/// Chunked and compressed. Chunks have one row along the axes before `axis` and are cut along that one.
Hdf5Handle dataset_properties(const ArrayShape& shape, std::size_t axis, std::size_t value_bytes) {
  ArrayShape chunk = shape;
  std::fill_n(chunk.begin(), axis, 1);
  std::replace(chunk.begin(), chunk.end(), std::size_t{0}, std::size_t{1});
  if (axis < chunk.size()) {
    const std::size_t row = value_bytes * product(std::span(chunk).subspan(axis + 1));
    chunk[axis] = std::clamp<std::size_t>(kChunkBytes / std::max<std::size_t>(row, 1), 1, chunk[axis]);
  }
  const std::vector<hsize_t> counts = sizes(chunk);
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(properties.get(), isize(counts), counts.data());
  H5Pset_shuffle(properties.get());
  H5Pset_deflate(properties.get(), kCompressionLevel);
  return properties;
}

/// Selects one row of a dataset along its first axis.
std::vector<hsize_t> select_row(hid_t space, std::size_t row) {
  std::vector<hsize_t> count(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, count.data(), nullptr);
  std::vector<hsize_t> start(count.size(), 0);
  start[0] = row;
  count[0] = 1;
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  return count;
}

Hdf5Handle memory_space(const std::vector<hsize_t>& count) {
  return {H5Screate_simple(isize(count), count.data(), nullptr), H5Sclose};
}

}  // namespace

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
  // HDF5 reads again what a writer may be about to change, and waits twice as long each time: its usual 100 times are
  // for ever where a writer was killed in the middle of it. These take a tenth of a second.
  constexpr unsigned kAttempts = 26;
  H5Pset_metadata_read_attempts(access.get(), kAttempts);
  // As a reader concurrent with a writer, even if there is none: a killed writer leaves its mark in the file.
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
  std::vector<hsize_t> counts(H5Sget_simple_extent_ndims(space.get()));
  H5Sget_simple_extent_dims(space.get(), counts.data(), nullptr);
  return {counts.begin(), counts.end()};
}

template <class Value>
Array<Value> Hdf5Reader::read(const std::string& name) const {
  Array<Value> array{.shape = shape_of(name), .values = {}};
  const Hdf5Handle set = open_->set(name);
  array.values.resize(product(array.shape));
  if (array.values.empty()) return array;
  open_->check(H5Dread(set.get(), hdf5_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()), name);
  return array;
}

template <class Value>
Array<Value> Hdf5Reader::read_row(const std::string& name, std::size_t row) const {
  const ArrayShape whole = shape_of(name);
  Array<Value> array{.shape = ArrayShape(whole.begin() + 1, whole.end()), .values = {}};
  array.values.resize(product(array.shape));
  if (array.values.empty()) return array;
  const Hdf5Handle set = open_->set(name);
  const Hdf5Handle space(open_->check(H5Dget_space(set.get()), name), H5Sclose);
  const Hdf5Handle memory = memory_space(select_row(space.get(), row));
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

struct Hdf5Writer::Open {
  std::filesystem::path path;
  Hdf5Handle file;
  std::map<std::string, Hdf5Handle> series;  // and slots

  /// After an error the file is left as a killed program leaves it: closing it would record a size that it never
  /// reached, and nobody could open it again.
  template <class Result>
  Result check(Result result) {
    if (result < 0) {
      const std::string reason = hdf5_reason();
      for (auto& [name, set] : series) set.abandon();
      file.abandon();
      throw Error(ErrorKind::kFailed, "cannot write '" + path.string() + "': " + reason);
    }
    return result;
  }

  Hdf5Handle make(const std::string& name, hid_t type, const Hdf5Handle& space, hid_t properties) {
    const Hdf5Handle folders = link_properties();  // outlives the call: closing it would clear the error stack
    return {check(H5Dcreate2(file.get(), name.c_str(), type, space.get(), folders.get(), properties, H5P_DEFAULT)),
            H5Dclose};
  }

  [[nodiscard]] hid_t at(const std::string& name) const { return series.at(name).get(); }
};

Hdf5Writer::Hdf5Writer(std::filesystem::path file) : open_(std::make_unique<Open>()) {
  open_->path = std::move(file);
  const Hdf5Handle access = hdf5_access();
  open_->file = {open_->check(H5Fcreate(open_->path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get())), H5Fclose};
}

Hdf5Writer::~Hdf5Writer() = default;
Hdf5Writer::Hdf5Writer(Hdf5Writer&&) noexcept = default;
Hdf5Writer& Hdf5Writer::operator=(Hdf5Writer&&) noexcept = default;

template <class Value>
void Hdf5Writer::write(const std::string& name, std::span<const Value> values, const ArrayShape& shape) {
  const bool is_empty = product(shape) == 0;
  const Hdf5Handle properties =
      is_empty ? Hdf5Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose) : dataset_properties(shape, 0, sizeof(Value));
  const Hdf5Handle set = open_->make(name, hdf5_type<Value>(), space_of(shape), properties.get());
  if (is_empty) return;
  open_->check(H5Dwrite(set.get(), hdf5_type<Value>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
}

void Hdf5Writer::write_text(const std::string& name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), text.size() + 1);
  const Hdf5Handle set = open_->make(name, type.get(), Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose), H5P_DEFAULT);
  open_->check(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()));
}

void Hdf5Writer::write_texts(const std::string& name, const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string all;
  for (const std::string& text : texts) all += text + std::string(width - text.size(), '\0');
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), width);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  const Hdf5Handle set = open_->make(name, type.get(), space_of({texts.size()}), H5P_DEFAULT);
  if (texts.empty()) return;
  open_->check(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()));
}

template <class Value>
void Hdf5Writer::make_series(const std::string& name, const ArrayShape& row) {
  ArrayShape shape{1};
  shape.insert(shape.end(), row.begin(), row.end());
  const Hdf5Handle properties = dataset_properties(shape, 1, sizeof(Value));
  std::vector<hsize_t> now = sizes(shape);
  std::vector<hsize_t> most = now;
  now[0] = 0;
  most[0] = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(isize(now), now.data(), most.data()), H5Sclose);
  open_->series[name] = open_->make(name, hdf5_type<Value>(), space, properties.get());
}

void Hdf5Writer::make_slots(const std::string& name, std::size_t rows, std::size_t columns) {
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_alloc_time(properties.get(), H5D_ALLOC_TIME_EARLY);
  open_->series[name] = open_->make(name, hdf5_type<double>(), space_of({rows, columns}), properties.get());
}

void Hdf5Writer::start_series() { open_->check(H5Fstart_swmr_write(open_->file.get())); }

template <class Value>
void Hdf5Writer::append(const std::string& name, std::span<const Value> row) {
  const hid_t set = open_->at(name);
  const Hdf5Handle before(open_->check(H5Dget_space(set)), H5Sclose);
  std::vector<hsize_t> shape(H5Sget_simple_extent_ndims(before.get()));
  H5Sget_simple_extent_dims(before.get(), shape.data(), nullptr);
  const hsize_t last = shape[0]++;
  open_->check(H5Dset_extent(set, shape.data()));
  if (row.empty()) return;
  const Hdf5Handle space(open_->check(H5Dget_space(set)), H5Sclose);
  const Hdf5Handle memory = memory_space(select_row(space.get(), last));
  open_->check(H5Dwrite(set, hdf5_type<Value>(), memory.get(), space.get(), H5P_DEFAULT, row.data()));
  open_->check(H5Dflush(set));
}

void Hdf5Writer::fill_slot(const std::string& name, std::size_t row, std::span<const double> values) {
  if (values.empty()) return;
  const hid_t set = open_->at(name);
  const Hdf5Handle space(open_->check(H5Dget_space(set)), H5Sclose);
  const std::vector<hsize_t> count = select_row(space.get(), row);
  assert(values.size() == count[1]);
  const Hdf5Handle memory = memory_space(count);
  open_->check(H5Dwrite(set, hdf5_type<double>(), memory.get(), space.get(), H5P_DEFAULT, values.data()));
  open_->check(H5Dflush(set));
}

void Hdf5Writer::close() {
  for (auto& [name, set] : open_->series) open_->check(set.reset());
  open_->series.clear();
  open_->check(open_->file.reset());
}

void Hdf5Writer::rename(std::filesystem::path file) { open_->path = std::move(file); }

template void Hdf5Writer::write(const std::string&, std::span<const double>, const ArrayShape&);
template void Hdf5Writer::write(const std::string&, std::span<const float>, const ArrayShape&);
template void Hdf5Writer::write(const std::string&, std::span<const int>, const ArrayShape&);
template void Hdf5Writer::write(const std::string&, std::span<const std::uint8_t>, const ArrayShape&);
template void Hdf5Writer::write(const std::string&, std::span<const std::uint64_t>, const ArrayShape&);
template void Hdf5Writer::make_series<double>(const std::string&, const ArrayShape&);
template void Hdf5Writer::make_series<float>(const std::string&, const ArrayShape&);
template void Hdf5Writer::make_series<std::uint64_t>(const std::string&, const ArrayShape&);
template void Hdf5Writer::append(const std::string&, std::span<const double>);
template void Hdf5Writer::append(const std::string&, std::span<const float>);
template void Hdf5Writer::append(const std::string&, std::span<const std::uint64_t>);

}  // namespace sprung
