#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// A cube of 1, open at the top.
void write_open_box(const TempFolder& folder) {
  std::ofstream(folder.path() / "box.off") << "OFF\n8 5 0\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n0 1 0\n1 1 0\n1 1 1\n0 1 1\n"
                                              "4 0 1 2 3\n4 0 4 5 1\n4 1 5 6 2\n4 2 6 7 3\n4 3 7 4 0\n";
}

void write_square(const TempFolder& folder) {
  std::ofstream(folder.path() / "square.off") << "OFF\n4 1 0\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n4 0 1 2 3\n";
}

TEST(RepairOption, AutoSaysWhatItDid) {
  const TempFolder folder;
  write_open_box(folder);
  const ProgramRun run = run_program(folder, "simulate box.off --bricks 4 --duration 0.05 -o out");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("filled 1 hole (1 flat, 0 smooth)"), std::string::npos) << run.err;
}

TEST(RepairOption, StrictAndOffRefuseAnOpenMesh) {
  const TempFolder folder;
  write_open_box(folder);
  const ProgramRun strict = run_program(folder, "simulate box.off --repair strict -o out");
  EXPECT_EQ(strict.exit_code, 3);
  EXPECT_NE(strict.err.find("filled 1 hole"), std::string::npos) << strict.err;
  const ProgramRun off = run_program(folder, "simulate box.off --repair off -o out");
  EXPECT_EQ(off.exit_code, 3);
  EXPECT_NE(off.err.find("4 open edges in 1 loop"), std::string::npos) << off.err;
  EXPECT_EQ(run_program(folder, "simulate box.off --repair of -o out").exit_code, 2);
}

TEST(ThicknessOption, MakesASquareAPlate) {
  const TempFolder folder;
  write_square(folder);
  const ProgramRun flat = run_program(folder, "simulate square.off -o out");
  EXPECT_EQ(flat.exit_code, 3);
  EXPECT_NE(flat.err.find("the surface is flat (y extent 0)"), std::string::npos) << flat.err;
  const ProgramRun plate = run_program(folder,
                                       "simulate square.off --size 20cm --thickness 2cm --brick-size 2cm "
                                       "--duration 0.05 -o out");
  EXPECT_EQ(plate.exit_code, 0) << plate.err;
  EXPECT_EQ(plate.err.find("larger than the shell"), std::string::npos) << plate.err;
  const ProgramRun thin = run_program(folder,
                                      "simulate square.off --size 20cm --thickness 5mm --brick-size 2cm "
                                      "--duration 0.05 -o thin");
  EXPECT_EQ(thin.exit_code, 0) << thin.err;
  EXPECT_NE(thin.err.find("bricks of 5 mm would be right"), std::string::npos) << thin.err;
}

TEST(ThicknessOption, IsAKeyOfABody) {
  const TempFolder folder;
  write_square(folder);
  const ProgramRun run = run_program(folder, "animate square.off --thickness 3mm --repair strict --print-scene");
  EXPECT_NE(run.out.find("thickness = 0.003"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("repair = \"strict\""), std::string::npos) << run.out;
}

}  // namespace
}  // namespace sprung
