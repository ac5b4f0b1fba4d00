#include "core/io/hdf5_handle.h"

namespace sprung {
namespace {

constexpr std::string_view kSystemsWords = "error message = '";

/// Keeps the innermost description, or the system's words where there are any.
herr_t find_reason(unsigned depth, const H5E_error2_t* error, void* data) {
  std::string& reason = *static_cast<std::string*>(data);
  const std::string description = error->desc == nullptr ? "" : error->desc;
  const auto begin = description.find(kSystemsWords);
  if (begin != std::string::npos) {
    const auto first = begin + kSystemsWords.size();
    reason = description.substr(first, description.find('\'', first) - first);
    return 1;
  }
  if (depth == 0) reason = description;
  return 0;
}

}  // namespace

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_reason, &reason);
  return reason.empty() ? "HDF5 gives no reason" : reason;
}

template <>
hid_t hdf5_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t hdf5_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t hdf5_type<int>() {
  return H5T_NATIVE_INT;
}
template <>
hid_t hdf5_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
hid_t hdf5_type<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}

Hdf5Handle hdf5_access() {
  H5dont_atexit();  // else it would close what was abandoned
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_file_locking(access.get(), 0, 1);
  return access;
}

}  // namespace sprung
