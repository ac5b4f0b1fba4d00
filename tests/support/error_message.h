#pragma once
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace sprung {

/// The message of the Error that `work` throws; empty if it throws none.
template <class Work>
std::string error_message(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The same for an Error of this kind; any other, or none, is a failure.
template <class Work>
std::string error_message(ErrorKind kind, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind);
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

}  // namespace sprung
