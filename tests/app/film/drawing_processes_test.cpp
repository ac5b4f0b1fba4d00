#include "app/film/drawing_processes.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <iterator>

#include "core/error.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

Image picture(std::size_t value) {
  Image image(3, 2);
  for (std::uint8_t& part : image.pixels) part = static_cast<std::uint8_t>(value);
  return image;
}

Error error_of(const DrawingProcesses::Work& work) {
  try {
    DrawingProcesses processes(1, work);
    processes.finish();
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::kUsage, "none"};
}

TEST(DrawingProcesses, SendInOrder) {
  constexpr std::size_t kEach = 1000;  // more than a pipe holds
  DrawingProcesses processes(3, [](std::size_t process, const DrawingProcesses::Send& send) {
    for (std::size_t i = 0; i < kEach; ++i) send(picture(10 * process + i % 10));
  });
  for (std::size_t i = 0; i < kEach; ++i) {
    for (std::size_t process = 0; process < 3; ++process) {
      const Image image = processes.receive(process).value();
      ASSERT_EQ(image.width, 3);
      ASSERT_EQ(image.pixels, picture(10 * process + i % 10).pixels);
    }
  }
  EXPECT_FALSE(processes.receive(1));
  processes.finish();
}

TEST(DrawingProcesses, WhatTheyThrowIsThrownHere) {
  const Error own = error_of([](auto, const auto&) { throw Error(ErrorKind::kBadInput, "picture 7: too dark"); });
  EXPECT_EQ(own.kind(), ErrorKind::kBadInput);
  EXPECT_STREQ(own.what(), "picture 7: too dark");
  const Error other = error_of([](auto, const auto&) { throw std::bad_alloc(); });
  EXPECT_EQ(other.kind(), ErrorKind::kFailed);
}

TEST(DrawingProcesses, OneThatIsKilledIsSaid) {
  const Error error = error_of([](auto, const auto&) { std::raise(SIGKILL); });
  EXPECT_EQ(error.kind(), ErrorKind::kFailed);
  EXPECT_NE(std::string(error.what()).find("signal 9"), std::string::npos) << error.what();
}

TEST(DrawingProcesses, AreStoppedWhereNobodyAsksOn) {
  DrawingProcesses processes(2, [](auto, const DrawingProcesses::Send& send) {
    while (true) send(picture(1));
  });
  static_cast<void>(processes.receive(1));
}

TEST(DrawingProcesses, WorkerThreadsEndAndBeginAnew) {
  const auto threads = [] {
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
  };
  const auto work = [] {
    std::atomic<int> sum = 0;
    tbb::parallel_for(0, 1000, [&](int i) { sum += i; });
    return sum.load();
  };
  const auto before = threads();
  EXPECT_EQ(work(), 499500);
  ASSERT_TRUE(end_worker_threads());
  EXPECT_EQ(threads(), before);
  EXPECT_EQ(work(), 499500);
}

}  // namespace
}  // namespace sprung
