#pragma once
#include <string>

#include "core/error.h"

namespace sprung {

/// What the Error says that `work` throws; empty where it throws none.
template <class Work>
std::string error_message(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace sprung
