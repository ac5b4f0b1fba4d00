#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <span>

#include "app/commands/commands.h"
#include "app/console/interrupt.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr int kFailed = int(ErrorKind::kFailed);

/// Runs the program and maps its outcome to an exit code.
int exit_code(int argc, const char* const* argv) {
  static Console console = Console::of_process();  // for whatever ends the program
  const std::span words(argv, argc);
  console.log_json =
      std::count(words.begin(), words.end(), std::string_view("--log-json")) > 0;  // for mistakes in the others too
  catch_interrupts(console);
  reserve_standard_files();
  try {
    const int code = run_command_line(argc, argv, console);
    flush_results();
    return is_interrupted() ? interrupted_exit_code() : code;
  } catch (const Interrupted&) {
    report_interruption(console);
    return interrupted_exit_code();
  } catch (const Error& error) {
    if (is_interrupted()) {  // which caused the failure
      report_interruption(console);
      return interrupted_exit_code();
    }
    console.error(error.what());
    return int(error.kind());
  } catch (const std::filesystem::filesystem_error& error) {
    console.error(fmt::format("cannot use '{}': {}", error.path1().string(), error.code().message()));
    return kFailed;
  } catch (const std::bad_alloc&) {
    console.error("out of memory; fewer bricks, fewer frames or a smaller mesh need less");
    return kFailed;
  } catch (const std::exception& error) {
    console.error(std::ferror(stdout) == 0 ? std::string(error.what())
                                           : fmt::format("cannot write the results to stdout: {}", error.what()));
    return kFailed;
  }
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) { return sprung::exit_code(argc, argv); }
