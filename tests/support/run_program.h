#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/temp_folder.h"

namespace sprung {

/// How the built program ended and what it printed.
struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Runs build/.../sprung with these words (a shell line) in a folder; `environment` like "NAME=value".
inline ProgramRun run_program(const TempFolder& folder, const std::string& words, const std::string& environment = "") {
  const std::string command = "cd '" + folder.path().string() + "' && " + environment + " '" SPRUNG_PROGRAM "' " +
                              words + " >program.out 2>program.err </dev/null";
  const int status = std::system(command.c_str());
  ProgramRun run;
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.out = text_of(folder.path() / "program.out");
  run.err = text_of(folder.path() / "program.err");
  return run;
}

}  // namespace sprung
