#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "app/load/load_answer_text.h"
#include "app/validate/mapped_block.h"
#include "core/mesh/repair/faces.h"
#include "render/image/png.h"
#include "tests/support/run_program.h"

/// `sprung load` against closed forms, on its default bricks.
namespace sprung {
namespace {

std::string obj_of(const SurfaceMesh& mesh) {
  std::string text;
  for (const auto& part : mesh.parts) {
    text += fmt::format("g {}\n", part.name);
    if (&part == &mesh.parts.front()) {
      for (const auto& point : mesh.positions.rowwise()) {
        text += fmt::format("v {} {} {}\n", point[0], point[1], point[2]);
      }
    }
    for (int row = part.first_triangle; row < part.first_triangle + part.triangle_count; ++row) {
      const auto corners = mesh.triangles.row(row);
      text += fmt::format("f {} {} {}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
    }
  }
  return text;
}

/// 100 x 10 x 8 mm.
std::string bar_obj() {
  return obj_of(mapped_block({1, 1, 1}, [](const Vec3& at) -> Vec3 { return at.cwiseProduct(Vec3(100, 10, 8)); }));
}

/// A plate of 100 x 100 x 5 mm with a round hole of 10 mm radius, one quarter: the hole is about the origin.
std::string quarter_plate_obj() {
  return obj_of(mapped_block({40, 32, 1}, [](const Vec3& at) -> Vec3 {
    const double angle = at.y() * std::numbers::pi / 2;
    const Vec3 on_hole(10 * std::cos(angle), 10 * std::sin(angle), 0);
    const Vec3 on_edge = Vec3(std::cos(angle), std::sin(angle), 0) * 100 / std::max(std::cos(angle), std::sin(angle));
    const double along = at.x() * at.x();
    return (1 - along) * on_hole + along * on_edge + Vec3(0, 0, 5 * at.z());
  }));
}

/// A quarter of a tube of radii 20 and 40 mm, 10 mm long, about z.
std::string quarter_tube_obj() {
  return obj_of(mapped_block({4, 48, 1}, [](const Vec3& at) -> Vec3 {
    const double angle = at.y() * std::numbers::pi / 2;
    const double radius = 20 + 20 * at.x();
    return {radius * std::cos(angle), radius * std::sin(angle), 10 * at.z()};
  }));
}

double number(const nlohmann::json& json, const std::string& path) {
  return json.at(nlohmann::json::json_pointer(path)).get<double>();
}

/// A round bar along x, 100 mm long, of 10 mm radius.
std::string round_bar_obj() {
  return obj_of(mapped_block({1, 16, 16}, [](const Vec3& at) -> Vec3 {
    const Eigen::Vector2d square(2 * at.y() - 1, 2 * at.z() - 1);
    const double largest = square.cwiseAbs().maxCoeff();
    const Eigen::Vector2d disc = largest > 0 ? Eigen::Vector2d(10 * largest * square.normalized()) : square;
    return {100 * at.x(), disc.x(), disc.y()};
  }));
}

class Load : public testing::Test {
 protected:
  [[nodiscard]] ProgramRun run(const std::string& words) const { return run_program(folder_, "load " + words); }
  [[nodiscard]] nlohmann::json answer(const std::string& words) const {
    const ProgramRun made = run(words + " --json");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return nlohmann::json::parse(made.out);
  }

  TempFolder folder_;
  std::filesystem::path bar_ = folder_.write("bar.obj", bar_obj());
};

const std::string kSteel = " --young 200GPa --poisson 0.3 --density 7850";

/// P L^3 / (3 E I) + 1.2 P L / (G A).
TEST_F(Load, BeamBendsByItsFormula) {
  const nlohmann::json made = answer("bar.obj --fix x-low --load x-high:100N:-y" + kSteel);
  const double expected = 100 * 1e-3 / (3 * 200e9 * 8e-3 * 1e-6 / 12) + 1.2 * 100 * 0.1 / (200e9 / 2.6 * 80e-6);
  const double moved = number(made, "/displacement_m/value");
  EXPECT_NEAR(moved, expected, 0.01 * expected);
  EXPECT_NEAR(moved, expected, number(made, "/displacement_m/error") + 0.003 * expected);
  EXPECT_NEAR(number(made, "/mass_kg"), 7850 * 8e-6, 1e-6);
  // The supported end is singular; next to it, some 3 bricks away, the stress is M y / I.
  const double stress = number(made, "/von_mises_Pa/value");
  const double root = 100 * 0.1 * 5e-3 / (8e-3 * 1e-6 / 12);
  EXPECT_NEAR(stress, root, 0.1 * root);
}

TEST_F(Load, EveryKindOfLoadHasItsReaction) {
  const auto reaction = [&](const std::string& load, const std::string& quantity, int axis) {
    const nlohmann::json made = answer("bar.obj --brick-size 2mm --fix x-low --load " + load + kSteel);
    return number(made, "/reactions/0/" + quantity + "/" + std::to_string(axis));
  };
  EXPECT_NEAR(reaction("x-high:2MPa", "force_N", 0), 160, 0.01);
  EXPECT_NEAR(reaction("x-high:160N", "force_N", 0), 160, 1e-3);  // towards the inside
  EXPECT_NEAR(reaction("x-high:1kg", "force_N", 1), 9.80665, 1e-4);
  EXPECT_NEAR(reaction("x-high:1.5Nm:+x", "moment_Nm", 0), -1.5, 1e-4);
  EXPECT_NEAR(reaction("weight", "force_N", 1), 7850 * 8e-6 * 9.80665, 1e-4);
  EXPECT_NEAR(reaction("acceleration:10m/s2:+x", "force_N", 0), -7850 * 8e-6 * 10, 1e-4);
  EXPECT_NEAR(reaction("box=90,10,0,100,10,8:50N:-y", "force_N", 1), 50, 1e-3);
  EXPECT_NEAR(reaction("face=50,10,4:50N", "force_N", 1), 50, 1e-3);  // the whole upper side
  // u E A / L, with the sides free to slide.
  EXPECT_NEAR(reaction("x-high:0.01mm:+x", "force_N", 0), -1e-5 * 200e9 * 80e-6 / 0.1, 40);
}

/// Timoshenko: the middle of a bar between two slides under its own weight moves as symmetry requires.
TEST_F(Load, SlidesHoldAcrossTheirPlaneOnly) {
  const nlohmann::json made =
      answer("bar.obj --fix x-low:slide --fix y-low:slide --fix z-low:slide --load x-high:800N:out" + kSteel);
  const double strain = 800 / 80e-6 / 200e9;
  EXPECT_NEAR(number(made, "/displacement_m/vector/0"), strain * 0.1, 0.002 * strain * 0.1);
  EXPECT_NEAR(number(made, "/von_mises_Pa/value"), 1e7, 3e5);  // at the foundation, where it is not quite uniform
}

/// An L of 60 mm, 10 mm thick and 20 mm wide, with a sharp inner corner at (10, 10).
std::string angle_obj() {
  const std::vector<std::array<int, 2>> outline{{0, 0}, {60, 0}, {60, 10}, {10, 10}, {10, 60}, {0, 60}};
  std::string obj;
  for (const int z : {0, 20}) {
    for (const auto& [x, y] : outline) obj += fmt::format("v {} {} {}\n", x, y, z);
  }
  obj += "f 6 5 4 1\nf 4 3 2 1\nf 7 10 11 12\nf 7 8 9 10\n";
  for (int i = 1; i <= 6; ++i) obj += fmt::format("f {} {} {} {}\n", i, i % 6 + 1, i % 6 + 7, i + 6);
  return obj;
}

/// Whatever the bricks say there, the stress at a sharp inner corner has no bound; along the arm it is N / A + M / W.
TEST_F(Load, SharpInnerCornerIsNamedAndLeftOut) {
  static_cast<void>(folder_.write("angle.obj", angle_obj()));
  const double along_arm = 20 / 200e-6 + 20 * 0.055 / (20e-3 * 100e-6 / 6);
  for (const int bricks : {24, 48}) {
    const nlohmann::json made =
        answer(fmt::format("angle.obj --fix y-high --load x-high:20N:-y --bricks {}", bricks) + kSteel);
    EXPECT_NEAR(number(made, "/von_mises_Pa/value"), along_arm, 0.01 * along_arm) << bricks;
    ASSERT_FALSE(made.at("singular").empty()) << bricks;
    const auto position = made.at("singular")[0].at("place").get<std::array<double, 3>>();
    EXPECT_LT(std::hypot(position[0] - 10, position[1] - 10), 6) << bricks;
  }
}

/// Kirsch: three times the stress far away, at the hole. In a square plate ten times as wide as the hole, and as thick
/// as half of it, it is 3.17 times in the middle plane (finite elements: plate_with_hole in
/// tests/references/curved.json).
TEST_F(Load, HoleInAPlateTriplesTheStress) {
  static_cast<void>(folder_.write("plate.obj", quarter_plate_obj()));
  const nlohmann::json made =
      answer("plate.obj --fix x-low:slide --fix y-low:slide --fix z-low:slide --load x-high:5000N:out" + kSteel);
  const double peak = number(made, "/largest_principal_Pa/value");
  EXPECT_NEAR(peak, 31.72e6, 0.02 * 31.72e6);
}

/// Lame: u(a) = p a / E (K + nu), K = (b^2 + a^2) / (b^2 - a^2), in plane stress; hoop stress p K inside.
TEST_F(Load, ThickTubeFollowsLame) {
  static_cast<void>(folder_.write("tube.obj", quarter_tube_obj()));
  const nlohmann::json made =
      answer("tube.obj --fix x-low:slide --fix y-low:slide --fix z-low:slide --load face=14.14,14.14,5:10MPa" + kSteel);
  const double k = (1600.0 + 400) / (1600 - 400);
  const double moved = 10e6 * 0.02 / 200e9 * (k + 0.3);
  EXPECT_NEAR(number(made, "/displacement_m/value"), moved, 0.03 * moved);
  EXPECT_NEAR(number(made, "/largest_principal_Pa/value"), k * 10e6, 0.03 * k * 10e6);
}

/// theta = T L / (G J), tau = T r / J.
TEST_F(Load, RoundBarTwistsByItsFormula) {
  static_cast<void>(folder_.write("round.obj", round_bar_obj()));
  const nlohmann::json made = answer("round.obj --fix x-low --load x-high:10Nm:+x" + kSteel);
  const double polar = std::numbers::pi * std::pow(0.01, 4) / 2;
  const double moved = 10 * 0.1 / (200e9 / 2.6 * polar) * 0.01;
  EXPECT_NEAR(number(made, "/displacement_m/value"), moved, 0.03 * moved);
  const double stress = std::sqrt(3.0) * 10 * 0.01 / polar;
  EXPECT_NEAR(number(made, "/von_mises_Pa/value"), stress, 0.03 * stress);
}

/// P = pi^2 E I / (2 L)^2; f = 1.8751^2 / (2 pi L^2) sqrt(E I / (rho A)).
TEST_F(Load, ColumnBucklesLikeEulers) {
  const nlohmann::json made =
      answer("bar.obj --brick-size 1mm --fix x-low --load x-high:100N --buckling --modes 2" + kSteel);
  const double bending = 200e9 * 10e-3 * std::pow(8e-3, 3) / 12;
  const double expected = std::pow(std::numbers::pi, 2) * bending / (4 * 0.01) / 100;
  EXPECT_NEAR(number(made, "/buckling_factor/value"), expected, 0.03 * expected);
  const double frequency = std::pow(1.8751, 2) / (2 * std::numbers::pi * 0.01) * std::sqrt(bending / (7850 * 80e-6));
  EXPECT_NEAR(number(made, "/frequencies_Hz/0/value"), frequency, 0.03 * frequency);
  const nlohmann::json pulled =
      answer("bar.obj --brick-size 2mm --fix x-low --load x-high:100N:out --buckling" + kSteel);
  EXPECT_TRUE(pulled.at("buckling_factor").is_null() || number(pulled, "/buckling_factor/value") > 100 * expected);
}

/// For all directions of the bar and of the vertical.
TEST_F(Load, ColumnsBuckleAlikeAlongAllAxes) {
  for (const auto& [axis, up] : std::vector<std::pair<int, std::string>>{{1, "y"}, {2, "z"}, {2, "y"}, {1, "z"}}) {
    Vec3 sides = Vec3::Constant(10);
    sides[axis] = 100;
    static_cast<void>(folder_.write(
        "column.obj", obj_of(mapped_block({1, 1, 1}, [&](const Vec3& at) -> Vec3 { return at.cwiseProduct(sides); }))));
    const char name = char('x' + axis);
    const nlohmann::json made =
        answer(fmt::format("column.obj --brick-size 1mm --up {} --fix {}-low --load {}-high:1000N --buckling", up, name,
                           name) +
               kSteel);
    const double expected = std::pow(std::numbers::pi, 2) * 200e9 * std::pow(0.01, 4) / 12 / (4 * 0.01) / 1000;
    EXPECT_NEAR(number(made, "/buckling_factor/value"), expected, 0.05 * expected) << axis << up;
  }
}

/// About the centroid of the face, if that is not the middle of the side: M = F a.
TEST_F(Load, MomentsOfSupportsAreAboutTheirCentroids) {
  const nlohmann::json made =
      answer(SPRUNG_SOURCE_DIR "/assets/models/bracket.stl --bricks 40 --fix y-high --load x-high:3N:-y");
  EXPECT_NEAR(number(made, "/reactions/0/moment_Nm/2"), 3 * 0.077, 0.0002);
  EXPECT_NEAR(number(made, "/reactions/0/about/0"), 3, 1e-6);
}

TEST_F(Load, FindsSmallRegionsOnLargeTriangles) {
  const nlohmann::json made = answer("bar.obj --bricks 50 --fix x-low --load ball=80,10,4,3:10N:-y" + kSteel);
  EXPECT_NEAR(number(made, "/loads/0/area_m2"), std::numbers::pi * 9e-6, 0.03 * std::numbers::pi * 9e-6);
  EXPECT_NEAR(number(made, "/reactions/0/force_N/1"), 10, 0.001);
}

TEST_F(Load, WritesPicturesAndTables) {
  const ProgramRun made =
      run("bar.obj --fix x-low --load x-high:100N:-y --bricks 50 --material steel -o out/ --turntable");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("out/: load.png, load.json, load.csv, load.html, load.xdmf, load.xdmf.h5, load.mp4"),
            std::string::npos)
      << made.err;
  const Image picture = read_png(folder_.path() / "out" / "load.png");
  EXPECT_EQ(picture.width, 1600);
  EXPECT_GT(std::set<std::uint8_t>(picture.pixels.begin(), picture.pixels.end()).size(), 100U);
  for (const char* name : {"load.json", "load.csv", "load.html", "load.xdmf", "load.xdmf.h5", "load.mp4"}) {
    EXPECT_GT(std::filesystem::file_size(folder_.path() / "out" / name), 500U) << name;
  }
  EXPECT_NE(text_of(folder_.path() / "out" / "load.csv").find("\ndisplacement_m,"), std::string::npos);
  const ProgramRun again = run("bar.obj --fix x-low --load x-high:100N:-y --bricks 50 -o out/");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("--overwrite"), std::string::npos) << again.err;
}

TEST_F(Load, LimitsDecideTheExitCode) {
  const std::string bar = "bar.obj --fix x-low --load x-high:100N:-y --material steel";
  EXPECT_EQ(run(bar + " --deflection-limit 1mm --safety 1.1").exit_code, 0);
  const ProgramRun bends = run(bar + " --deflection-limit 0.1mm");
  EXPECT_EQ(bends.exit_code, 1);
  EXPECT_NE(bends.out.find("EXCEEDED"), std::string::npos);
  const ProgramRun weak = run(bar + " --safety 20");
  EXPECT_EQ(weak.exit_code, 1);
  EXPECT_NE(weak.out.find("NOT REACHED\n"), std::string::npos) << weak.out;
}

TEST_F(Load, SaysWhetherTheErrorCouldTurnAVerdictRound) {
  PartAnswer answer;
  answer.von_mises = Peak{};
  answer.von_mises->value = 20e6;
  answer.von_mises->error = 5e6;
  LibraryMaterial material;
  material.yield_strength = 40e6;
  const PartVerdict verdict = judge(answer, &material, {.displacement = std::nullopt, .safety = 2.2});
  EXPECT_FALSE(verdict.holds);
  EXPECT_DOUBLE_EQ(*verdict.safety, 2);
  EXPECT_DOUBLE_EQ(verdict.min_safety, 1.6);
  EXPECT_DOUBLE_EQ(verdict.max_safety, 40.0 / 15);
  const std::string bracket =
      SPRUNG_SOURCE_DIR "/assets/models/bracket.stl --bricks 40 --fix x-low --load x-high:50N:-y --material steel";
  const nlohmann::json made = this->answer(bracket);
  const auto range = made.at("safety_range").get<std::array<double, 2>>();
  ASSERT_LT(range[0], made.at("safety").get<double>());
  const std::string between = fmt::format("{}", (range[0] + made.at("safety").get<double>()) / 2);
  const ProgramRun close = run(bracket + " --safety " + between);
  EXPECT_EQ(close.exit_code, 0);
  EXPECT_NE(close.out.find("kept, but within the error: more --bricks decide"), std::string::npos) << close.out;
  EXPECT_NE(close.out.find(") against the yield strength"), std::string::npos) << close.out;
}

TEST_F(Load, LargeDisplacementsAreSolvedForAsSuch) {
  const ProgramRun made = run("bar.obj --fix x-low --load x-high:60N:-y --young 2GPa --poisson 0.3");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("solved for large displacements"), std::string::npos);
  EXPECT_NE(made.out.find("large displacements"), std::string::npos);
}

TEST_F(Load, MistakesAreNamedWithTheirRemedy) {
  const auto message = [&](const std::string& words) {
    const ProgramRun made = run("bar.obj " + words);
    EXPECT_NE(made.exit_code, 0) << words;
    return made.err;
  };
  const std::string fix = "--fix x-low ";
  for (const auto& [words, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--load x-high:1N", "the part has no support: --fix WHERE"},
           {fix, "the part has no load"},
           {"--fix x-lo --load x-high:1N", "did you mean 'x-low'"},
           {fix + "--load x-high:5", "write WHERE:50N"},
           {fix + "--load x-high:5furlong", "write WHERE:50N"},
           {fix + "--load x-high:1Nm", "along which axis"},
           {fix + "--load x-high:1N:up", "'up' is no direction"},
           {fix + "--load x-high:1MPa:-y", "a pressure acts inward"},
           {fix + "--load box=1,2,3:1N", "write box=X,Y,Z,X,Y,Z"},
           {"--fix box=200,0,0,300,1,1 --load x-high:1N", "has nothing of its surface there"},
           {fix + "--load face=500,0,0:1N", "away from bar.obj"},
           {fix + "--load x-high:0N", "the load is zero"},
           {fix + "--load x-high:1N --material auto", "name the material"},
           {fix + "--load x-high:1N -o x.png", "give a folder"},
           {fix + "--load x-high:1N --unit parsec", "no unit of length"},
           {"--fix x-low:slide --load x-high:1N:-y", "free to move"},
           {fix + "--load x-high:1N --safety -1", "has to be above 0"}}) {
    const std::string said = message(words);
    EXPECT_NE(said.find(expected), std::string::npos) << words << "\n" << said;
  }
  const ProgramRun large = run("bar.obj --fix x-low --load x-high:1N --unit km");
  EXPECT_NE(large.err.find("1e+05 m long if its unit is km; --unit mm would make it 10 cm"), std::string::npos)
      << large.err;
}

TEST(FindFace, IsFlatOrGoesRoundACurve) {
  const SurfaceMesh tube = mapped_block({4, 48, 1}, [](const Vec3& at) -> Vec3 {
    const double angle = at.y() * std::numbers::pi / 2;
    return {(2 + at.x()) * std::cos(angle), (2 + at.x()) * std::sin(angle), at.z()};
  });
  const auto count_at = [&](const std::string& side) {
    for (const Part& part : tube.parts) {
      if (part.name != side) continue;
      return std::pair(int(find_face(tube.positions, tube.triangles, part.first_triangle).size()), part.triangle_count);
    }
    return std::pair(0, -1);
  };
  for (const char* side : {"x-low", "x-high", "y-low", "y-high", "z-low", "z-high"}) {
    const auto [found, all] = count_at(side);
    EXPECT_EQ(found, all) << side;
  }
}

}  // namespace
}  // namespace sprung
