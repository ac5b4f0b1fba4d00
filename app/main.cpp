#include <algorithm>
#include <exception>
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
  Console console = Console::of_process();
  const std::span words(argv, argc);
  console.log_json =
      std::count(words.begin(), words.end(), std::string_view("--log-json")) > 0;  // of mistakes in the others too
  catch_interrupts();
  hold_standard_files();
  try {
    const int code = run_command_line(argc, argv, console);
    flush_results();
    return code;
  } catch (const Interrupted&) {
    console.warn("interrupted");
    return kInterruptedExitCode;
  } catch (const Error& error) {
    if (is_interrupted()) return kInterruptedExitCode;  // the interrupt is the reason of whatever failed
    console.error(error.what());
    return int(error.kind());
  } catch (const std::bad_alloc&) {
    console.error("out of memory; fewer bricks, fewer frames or a smaller mesh need less");
    return kFailed;
  } catch (const std::exception& error) {
    console.error(error.what());
    return kFailed;
  }
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) { return sprung::exit_code(argc, argv); }
