#include "core/law/brick_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

constexpr std::array<std::string_view, 6> kModelNames{"calibrated", "tensile", "m1", "m2-plain", "m1-plain", "fem"};

/// The continuum's stiffness of the mean stretches, minus that of the plain springs: with springs alone it is (4 edge I
/// + 4/3 inner J + 2 face (I + J)).
void calibrate_stretch(BrickLaw& law, const Material& material, double h) {
  const double springs_cross = 4.0 / 3.0 * law.inner + 2 * law.face;
  const double springs_self = springs_cross + 4 * law.edge + 2 * law.face;
  law.axial_cross = h * material.lame_lambda() - springs_cross;
  law.axial_self = h * (material.lame_lambda() + 2 * material.shear_modulus()) - springs_self;
  const double deficit =
      law.axial_self + 2 * law.axial_cross + 4 * law.edge;  // edges that all stretch by 1: twice W / 3
  if (deficit >= 0) return;
  law.axes = deficit / 3;
  law.axial_self -= law.axes;
  law.axial_cross -= law.axes;
}

/// The volume term of StrainEnergy below that.
void check_dilation(double poisson) {
  if (poisson >= -0.5) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("model calibrated cannot represent Poisson's ratio {}: below -0.5 it would swell by itself; use "
                  "model fem",
                  poisson));
}

void check_edge_spring(std::string_view model, double poisson, double least, bool allowed) {
  if (allowed) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("model {} cannot represent Poisson's ratio {}: its edge springs need a ratio of {} or more; "
                          "use model calibrated",
                          model, poisson, least));
}

/// The paper's springs, without corrections.
BrickLaw m2_springs(const Material& material, double h) {
  const double scale = material.young * h / (8 * (1 + material.poisson));
  BrickLaw law;
  law.inner = 3 * scale;
  law.edge = (4 * material.poisson + 1) * scale;
  return law;
}

BrickLaw m1_springs(const Material& material, double h) {
  BrickLaw law;
  law.face = material.shear_modulus() * h / 2;
  law.edge = material.poisson * material.shear_modulus() * h;
  return law;
}

BrickLaw law_of(Model model, const Material& material, double h) {
  switch (model) {
    case Model::kTensile:
    case Model::kM2Plain: {
      check_edge_spring(model_name(model), material.poisson, -0.25, material.poisson > -0.25);
      BrickLaw law = m2_springs(material, h);
      if (model == Model::kTensile) calibrate_stretch(law, material, h);
      return law;
    }
    case Model::kM1:
    case Model::kM1Plain: {
      check_edge_spring(model_name(model), material.poisson, 0, material.poisson >= 0);
      BrickLaw law = m1_springs(material, h);
      if (model == Model::kM1) calibrate_stretch(law, material, h);
      return law;
    }
    case Model::kCalibrated:
      check_dilation(material.poisson);
      break;
    case Model::kFem:
      break;
  }
  return {};
}

}  // namespace

std::span<const std::string_view> model_names() { return kModelNames; }

std::string_view model_name(Model model) { return kModelNames[std::size_t(model)]; }

Model model_from_name(std::string_view name) {
  const auto found = std::find(kModelNames.begin(), kModelNames.end(), name);
  if (found != kModelNames.end()) return static_cast<Model>(found - kModelNames.begin());
  throw Error(ErrorKind::kUsage, fmt::format("there is no model '{}'{}", name, did_you_mean(name, kModelNames)));
}

BrickLaw brick_law(Model model, const Material& material, double h) {
  check_material(material);
  if (model != Model::kCalibrated && material.law.kind != StrainEnergyKind::kNeoHooke) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("material '{}': law {} is of the calibrated model; {} has one of its own", material.name,
                            law_name(material.law.kind), model_name(model)));
  }
  return law_of(model, material, h);
}

}  // namespace sprung
