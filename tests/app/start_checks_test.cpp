#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace sprung {
namespace {

ProgramRun inspect(const std::string& options, const std::string& scene = "") {
  const TempFolder folder;
  static_cast<void>(folder.write("cube.obj", kCubeObj));
  static_cast<void>(folder.write("scene.toml", scene));
  return run_program(folder, "inspect " + (scene.empty() ? "cube.obj " : std::string("scene.toml ")) + options);
}

TEST(StartChecks, RefuseBodiesAtOnePlace) {
  const std::string cube = "[[body]]\nmesh = \"cube.obj\"\nsize = 0.1\nbricks = 4\nposition = ";
  EXPECT_EQ(inspect("", cube + "[0, 1, 0]\n" + cube + "[0, 1.11, 0]\n").exit_code, 0);
  const ProgramRun same = inspect("", cube + "[0, 1, 0]\n" + cube + "[0, 1, 0]\n");
  EXPECT_EQ(same.exit_code, 3);
  EXPECT_NE(same.err.find("inside body 2; bodies may overlap by one brick"), std::string::npos) << same.err;
}

TEST(StartChecks, TellOfBodiesThatStartInEachOther) {
  const std::string cube = "[[body]]\nmesh = \"cube.obj\"\nsize = 0.1\nbricks = 4\nposition = ";
  const std::string three = cube + "[0, 1, 0]\n" + cube + "[0, 1.098, 0]\n" + cube + "[0, 1.197, 0]\n";
  const auto simulate = [](const std::string& scene) {
    const TempFolder folder;
    static_cast<void>(folder.write("cube.obj", kCubeObj));
    static_cast<void>(folder.write("scene.toml", scene));
    return run_program(folder, "simulate scene.toml -o run.h5 --duration 1ms");
  };
  const ProgramRun overlapping = simulate(three);
  EXPECT_EQ(overlapping.exit_code, 0);
  EXPECT_NE((overlapping.out + overlapping.err)
                .find("bodies 1 and 2 start 2 mm inside each other; 2 pairs of bodies do, these the deepest"),
            std::string::npos)
      << overlapping.out << overlapping.err;
  const ProgramRun touching = simulate(cube + "[0, 1, 0]\n" + cube + "[0, 1.1, 0]\n");
  EXPECT_EQ(touching.exit_code, 0);
  EXPECT_EQ((touching.out + touching.err).find("inside each other"), std::string::npos) << touching.err;
}

TEST(StartChecks, RefuseAShellThickerThanItsBody) {
  const ProgramRun thick = inspect("--size 20cm --bricks 4 --thickness 21cm");
  EXPECT_EQ(thick.exit_code, 3);
  EXPECT_NE(thick.err.find("a shell of 21 cm is thicker than the body is long (20 cm)"), std::string::npos)
      << thick.err;
}

TEST(StartChecks, AThickShellIsFilledAtOnce) {
  const ProgramRun half = inspect("--size 20cm --bricks 8 --thickness 10cm");
  EXPECT_EQ(half.exit_code, 0) << half.err;
  EXPECT_EQ(half.err.find("too coarse"), std::string::npos) << half.err;
}

TEST(StartChecks, WarnOfRatiosAtWhichBricksLock) {
  EXPECT_NE(inspect("--bricks 2 --model tensile --poisson 0.495").err.find("bricks lock above 0.49"),
            std::string::npos);
  EXPECT_EQ(inspect("--bricks 2 --model tensile --poisson 0.49").err.find("lock"), std::string::npos);
}

TEST(StartChecks, NameAPinThatHoldsNothing) {
  const std::string cube = "[[body]]\nmesh = \"cube.obj\"\nsize = 0.1\nbricks = 4\n";
  const std::string nothing = "[[body.pin]]\nbox = { min = [1.5, 0, 0], max = [2, 1, 1] }\n";
  const ProgramRun none = inspect("", cube + nothing);
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("the pin holds no node; its box reaches from [1.5, 0, 0] to [2, 1, 1]"), std::string::npos)
      << none.err;
  EXPECT_NE(none.err.find("10 cm x 10 cm x 10 cm"), std::string::npos) << none.err;
  const ProgramRun one = inspect("", cube + "[[body.pin]]\nbox = { min = [0, 0, 0], max = [1, 0.1, 1] }\n" + nothing);
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_NE(one.err.find("warning: cube.obj: pin 2 holds no node"), std::string::npos) << one.err;
}

TEST(StartChecks, NoticeForgottenUnits) {
  EXPECT_NE(inspect("--bricks 2 --size 12").err.find("12 m long; a length without a unit is in metres, '12cm'"),
            std::string::npos);
  EXPECT_NE(inspect("--bricks 2 --young 20").err.find("Young's modulus 20 Pa"), std::string::npos);
  EXPECT_NE(inspect("--bricks 2 --young 2").err.find("'2GPa' in gigapascals"), std::string::npos);
  EXPECT_NE(inspect("--bricks 2 --young 3e12").err.find("stiffer than diamond"), std::string::npos);
  EXPECT_NE(inspect("--bricks 2 --density 1.1").err.find("'1.1g/cm3' in grams"), std::string::npos);
  EXPECT_NE(inspect("--bricks 2 --density 1e5").err.find("heavier than any metal"), std::string::npos);
  const std::string none = inspect("--bricks 2 --size 1 --young 100").err;
  EXPECT_EQ(none.find("without a unit"), std::string::npos) << none;
}

}  // namespace
}  // namespace sprung
