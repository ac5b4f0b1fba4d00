#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <span>

#include "app/commands/animate.h"
#include "app/commands/command_line.h"
#include "app/commands/export.h"
#include "app/commands/film.h"
#include "app/commands/inspect.h"
#include "app/commands/materials.h"
#include "app/commands/render.h"
#include "app/commands/simulate.h"
#include "app/commands/sweep.h"
#include "app/console/interrupt.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr int kFailed = int(ErrorKind::kFailed);

/// The exit code.
int run(int argc, const char* const* argv, Console& console) {
  const CommandLine line = parse_command_line(argc, argv);
  console.quiet = line.scene.quiet;
  console.verbose = line.scene.verbose;
  switch (line.command) {
    case CommandLine::Command::kShowText:
      fmt::print("{}", line.text);
      break;
    case CommandLine::Command::kMaterials:
      fmt::print("{}", list_materials(line.materials));
      break;
    case CommandLine::Command::kAnimate:
      animate(line.scene, console);
      break;
    case CommandLine::Command::kSimulate:
      run_simulation(line.scene, console);
      break;
    case CommandLine::Command::kRender:
      render_cache(line.scene, console);
      break;
    case CommandLine::Command::kExport:
      export_run(line.scene, console);
      break;
    case CommandLine::Command::kFilm:
      make_film(line.scene, console);
      break;
    case CommandLine::Command::kSweep:
      sweep(line.scene, console);
      break;
    case CommandLine::Command::kInspect:
      run_inspect(line.scene, console);
      break;
    case CommandLine::Command::kValidate:
      return validate(line.validate, console) ? 0 : kFailed;
    case CommandLine::Command::kCompare:
      return compare(line.compare) ? 0 : kFailed;
  }
  return 0;
}

/// The exit code that fits how it ended.
int exit_code(int argc, const char* const* argv) {
  Console console = Console::of_process();
  const std::span words(argv, argc);
  console.log_json =
      std::count(words.begin(), words.end(), std::string_view("--log-json")) > 0;  // of mistakes in the others too
  catch_interrupts();
  hold_standard_files();
  try {
    const int code = run(argc, argv, console);
    flush_results();
    return code;
  } catch (const Interrupted&) {
    console.warn("interrupted");
    return kInterruptedExitCode;
  } catch (const Error& error) {
    if (is_interrupted()) return kInterruptedExitCode;  // whatever failed, it was told to stop
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
