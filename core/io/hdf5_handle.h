#pragma once
#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>

namespace sprung {

/// A number of HDF5 and what gives it back.
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
  /// Leaves it as it is, for ever.
  void abandon() { id_ = -1; }
  /// Negative where closing failed.
  herr_t reset() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// "No space left on device" from HDF5's own record of what went wrong; else what it says itself.
[[nodiscard]] std::string hdf5_reason();

/// As it is in memory.
template <class Value>
[[nodiscard]] hid_t hdf5_type();
template <>
[[nodiscard]] hid_t hdf5_type<double>();
template <>
[[nodiscard]] hid_t hdf5_type<float>();
template <>
[[nodiscard]] hid_t hdf5_type<int>();
template <>
[[nodiscard]] hid_t hdf5_type<std::uint8_t>();
template <>
[[nodiscard]] hid_t hdf5_type<std::uint64_t>();

/// How files are opened here: no locks of HDF5's own, which network file systems refuse, and nothing printed.
[[nodiscard]] Hdf5Handle hdf5_access();

}  // namespace sprung
