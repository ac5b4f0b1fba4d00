#include "app/scene/tension_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/scene/scene_file.h"
#include "core/law/solid/uniaxial.h"
#include "tests/support/bodies.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

const std::filesystem::path kRubber = SPRUNG_SOURCE_DIR "/assets/curves/rubber.csv";

/// Holds a file with the text of a curve.
class CurveFile {
 public:
  explicit CurveFile(const std::string& text) { std::ofstream(path()) << text; }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "test.csv"; }

 private:
  TempFolder folder_;
};

std::string mistake(const std::string& text) {
  const CurveFile file(text);
  return error_message([&] { static_cast<void>(read_tension_curve(file.path())); });
}

TensionCurve curve_of(const Material& material, double low, double high) {
  const StrainEnergy psi(material);
  TensionCurve curve;
  for (int i = 0; i < 20; ++i) {
    const double stretch = low + (high - low) * i / 19;
    if (std::abs(stretch - 1) < 0.01) continue;
    curve.stretches.push_back(stretch);
    curve.stresses.push_back(uniaxial_state(psi, stretch).stress);
  }
  return curve;
}

TEST(TensionCurve, TakesUnitsOfTheHeadAndOfEachStress) {
  const CurveFile file("# a test\nstretch, stress (kPa)\n1.1, 2\n\n1.2; 4.5 kPa\n1.3 0.01 MPa\n0.8\t-1e1\n");
  const TensionCurve curve = read_tension_curve(file.path());
  EXPECT_EQ(curve.stretches, (std::vector<double>{1.1, 1.2, 1.3, 0.8}));
  EXPECT_EQ(curve.stresses, (std::vector<double>{2000, 4500, 10000, -10000}));
  EXPECT_EQ(read_tension_curve(CurveFile("1.5, 20\n").path()).stresses, std::vector<double>{20});
}

TEST(TensionCurve, NamesTheLineOfAMistake) {
  EXPECT_NE(mistake("1.1, 2\n1.2, two\n").find("test.csv:2: '1.2, two'"), std::string::npos);
  EXPECT_NE(mistake("1.1, 2\n1.2\n").find("a line is a stretch and a nominal stress"), std::string::npos);
  EXPECT_NE(mistake("1.1, -2\n").find("a stretch above 1 needs a stress above 0"), std::string::npos);
  EXPECT_NE(mistake("0, 0\n0.1, 5\n").find("a strain plus one is a stretch"), std::string::npos);
  EXPECT_NE(error_message([] { static_cast<void>(read_tension_curve("/nowhere.csv")); }).find("/nowhere.csv"),
            std::string::npos);
}

TEST(TensionCurve, GivesBackTheLawThatItWasMadeWith) {
  for (const double poisson : {0.3, 0.49}) {
    for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
      if (law.ogden_exponents.size() > 2) continue;
      const Material material = test::material_of_law(law, poisson);
      const CurveFit fit = fit_curve(curve_of(material, 0.7, 1.6), poisson, &law.kind);
      EXPECT_LT(fit.error, 1e-3) << law_text(fit.law);
      EXPECT_NEAR(fit.young / material.young, 1, 2e-3) << law_text(law);
      EXPECT_EQ(fit.law.kind, law.kind);
      EXPECT_NEAR(fit.law.mooney_share.value_or(0), law.mooney_share.value_or(0), 2e-3);
      EXPECT_NEAR(fit.law.fung_exponent.value_or(0), law.fung_exponent.value_or(0), 2e-3);
    }
  }
}

TEST(TensionCurve, IsFittedByTheSimplestLawThatFollowsIt) {
  for (const StrainEnergyLaw& law : test::kStrainEnergyLaws) {
    if (law.ogden_exponents.size() > 1 || law.kind == StrainEnergyKind::kLinear) continue;
    const CurveFit fit = fit_curve(curve_of(test::material_of_law(law, 0.49), 0.6, 2), 0.49);
    EXPECT_EQ(fit.law.kind, law.kind) << law_text(law);
    EXPECT_LE(fit.law.ogden_exponents.size(), 1U);
  }
}

TEST(TensionCurve, OfTreloarsRubberIsThatOfALawWithAnUpturn) {
  const TensionCurve curve = read_tension_curve(kRubber);
  ASSERT_EQ(curve.stretches.size(), 24U);
  const CurveFit fit = fit_curve(curve, 0.499);
  EXPECT_EQ(fit.law.kind, StrainEnergyKind::kOgden) << law_text(fit.law);
  EXPECT_LT(fit.error, 0.06);
  EXPECT_NEAR(fit.young, 1.2e6, 0.3e6);  // 3 G with Treloar's G of 0.4 MPa
  const StrainEnergyKind plain = StrainEnergyKind::kNeoHooke;
  EXPECT_GT(fit_curve(curve, 0.499, &plain).error, 3 * fit.error);
}

TEST(TensionCurve, StandsInASceneInPlaceOfYoungsModulus) {
  const auto scene = [](const std::string& keys) {
    return "[[body]]\nbox = [\"1 cm\", \"1 cm\", \"1 cm\"]\nmaterial = { poisson = 0.45, density = 1000, " + keys +
           " }\n";
  };
  const auto material = [&](const std::string& keys) {
    return parse_scene(scene(keys), "scene.toml").bodies.at(0).material;
  };
  const auto complaint = [&](const std::string& keys) {
    return error_message([&] { static_cast<void>(material(keys)); });
  };
  const std::string curve = "curve = \"" + kRubber.string() + "\"";
  EXPECT_EQ(material(curve).law.kind, StrainEnergyKind::kOgden);
  EXPECT_NE(material(curve).source.find("fitted to rubber.csv (24 points, stretch 1.02 to 7.6)"), std::string::npos);
  EXPECT_EQ(material(curve + ", law = \"neo-hooke\"").law.kind, StrainEnergyKind::kNeoHooke);
  EXPECT_EQ(material("young = 1000, law = \"fung\", fung_exponent = 2").law.fung_exponent, 2);
  EXPECT_NE(complaint("young = 1000, " + curve), "");
  EXPECT_NE(complaint("damping = 0"), "");
  EXPECT_NE(complaint(curve + ", law = \"fung\", fung_exponent = 2"), "");
  EXPECT_NE(complaint("curve = \"/nowhere.csv\"").find("/nowhere.csv"), std::string::npos);
  EXPECT_NE(complaint("young = 1000, law = \"fung\"").find("scene.toml:3"), std::string::npos);
  EXPECT_NE(complaint("young = 1000, law = \"fung\"").find("law fung needs fung_exponent"), std::string::npos);
}

TEST(TensionCurve, IsPrintedAsTheNumbersThatItGave) {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "scene.toml";
  std::ofstream(file) << "[[body]]\nbox = [\"1 cm\", \"1 cm\", \"1 cm\"]\nmaterial = { poisson = 0.45, density = 1000, "
                      << "curve = \"" << kRubber.string() << "\" }\n";
  const ProgramRun printed = run_program(folder, "simulate scene.toml --print-scene");
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_NE(printed.out.find("law = \"ogden\", ogden_exponents = ["), std::string::npos) << printed.out;
  EXPECT_EQ(printed.out.find("curve"), std::string::npos) << printed.out;
  const Material first = read_scene(file).bodies.at(0).material;
  std::ofstream(file) << printed.out;
  const Material again = read_scene(file).bodies.at(0).material;
  EXPECT_EQ(again.young, first.young);
  EXPECT_EQ(again.law, first.law);
}

TEST(Materials, DrawsTheLawsOfMaterialsBesideWhatWasMeasured) {
  const TempFolder folder;
  std::ofstream(folder.path() / "mine.toml")
      << "[[material]]\nname = \"band\"\npoisson = 0.49\ndensity = 930\ncurve = \"" << kRubber.string() << "\"\n";
  const ProgramRun run = run_program(folder, "materials band --materials mine.toml --sources --picture mine.svg");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("fitted to rubber.csv"), std::string::npos) << run.out;
  const std::string svg = text_of(folder.path() / "mine.svg");
  EXPECT_NE(svg.find("nominal stress (MPa)"), std::string::npos);
  EXPECT_NE(svg.find("circles: rubber.csv"), std::string::npos);
  EXPECT_EQ(run_program(folder, "materials --picture mine.svg").exit_code, 2);
  EXPECT_EQ(run_program(folder, "materials band --materials mine.toml --picture a.gif").exit_code, 2);
}

}  // namespace
}  // namespace sprung
