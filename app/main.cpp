#include <fmt/format.h>

#include <exception>
#include <new>

#include "app/animate.h"
#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/materials.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr int kFailed = static_cast<int>(ErrorKind::kFailed);
constexpr int kInterrupted = 130;

void run(int argc, const char* const* argv, Console& console) {
  const CommandLine line = parse_command_line(argc, argv);
  console.quiet = line.animate.quiet;
  console.verbose = line.animate.verbose;
  switch (line.command) {
    case CommandLine::Command::kShowText:
      fmt::print("{}", line.text);
      break;
    case CommandLine::Command::kMaterials:
      fmt::print("{}", materials_table());
      break;
    case CommandLine::Command::kAnimate:
      animate(line.animate, console);
      break;
  }
}

/// The exit code that fits how it ended.
int exit_code(int argc, const char* const* argv) {
  Console console = Console::of_process();
  catch_interrupts();
  try {
    run(argc, argv, console);
    return 0;
  } catch (const Interrupted&) {
    console.warn("interrupted");
    return kInterrupted;
  } catch (const Error& error) {
    if (is_interrupted()) return kInterrupted;  // the film's child process hears Ctrl-C too
    console.error(error.what());
    return static_cast<int>(error.kind());
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
