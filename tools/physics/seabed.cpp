// Verbs of echoes from the seabed and from objects.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "kernels/seabed/backscatter.h"
#include "kernels/seabed/material.h"
#include "kernels/seabed/table.h"
#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

using seabed::SedimentParameters;

/// Where the six parameters come from: a row of the named sediments, or one of these.
constexpr int kGrainSize = -1;
constexpr int kParameters = -2;

struct Inputs {
  int source = 6;  // medium sand
  double grain_size_phi = 1.5;
  SedimentParameters given = seabed::named_sediments()[6].parameters;
  double frequency_hz = 100e3;
  double sound_speed_mps = 1500.0;
  double grazing_deg = 45.0;
  double facet_slope_deg = 0.0;

  SedimentParameters sediment() const {
    if (source == kParameters) return given;
    if (source == kGrainSize) return seabed::sediment_of_grain_size(grain_size_phi);
    return seabed::named_sediments()[static_cast<std::size_t>(source)].parameters;
  }
};

std::vector<std::pair<std::string, int>> sources() {
  std::vector<std::pair<std::string, int>> all;
  for (const auto& row : seabed::named_sediments()) {
    std::string word(row.name);
    std::replace(word.begin(), word.end(), ' ', '-');
    all.emplace_back(word, static_cast<int>(all.size()));
  }
  all.emplace_back("grain-size", kGrainSize);
  all.emplace_back("parameters", kParameters);
  return all;
}

/// The table of the row before serves the next one, unless more than the angle has changed.
class LastTable {
 public:
  const seabed::BackscatterTable& of(const SedimentParameters& sediment, double mean_square_slope, double frequency_hz,
                                     double sound_speed_mps) {
    const Key key{sediment, mean_square_slope, frequency_hz, sound_speed_mps};
    if (!table_ || !(key == key_)) {
      key_ = key;
      const seabed::MeshedSediment facets{sediment, mean_square_slope};
      table_.emplace(seabed::law_of(facets, frequency_hz, sound_speed_mps));
    }
    return *table_;
  }

 private:
  struct Key {
    SedimentParameters sediment;
    double mean_square_slope = 0.0;
    double frequency_hz = 0.0;
    double sound_speed_mps = 0.0;
    bool operator==(const Key&) const = default;
  };
  Key key_;
  std::optional<seabed::BackscatterTable> table_;
};

void add_inputs(Verb& verb, Inputs& in) {
  verb.choice("sediment", in.source, sources(), "a row of the report's table, or by grain size, or by six parameters");
  verb.number("grain_size_phi", in.grain_size_phi, -1, 9, "mean grain size, for --sediment grain-size");
  const auto parameter = [&](const char* column, double& value, double low, double high, const char* about) {
    verb.number(column, value, low, high, std::string(about) + ", for --sediment parameters");
  };
  parameter("density_ratio", in.given.density_ratio, 0.5, 10, "sediment / water (rho)");
  parameter("sound_speed_ratio", in.given.sound_speed_ratio, 0.5, 10, "sediment / water (nu)");
  parameter("loss", in.given.loss, 1e-6, 1, "imaginary / real wavenumber (delta)");
  parameter("volume_parameter", in.given.volume_parameter, 0, 1, "volume scattering / attenuation (sigma_2)");
  parameter("spectral_exponent", in.given.spectral_exponent, 2.1, 3.99, "of the relief (gamma)");
  parameter("spectral_strength_cm4", in.given.spectral_strength_cm4, 1e-6, 1, "of the relief (w_2)");
  verb.number("frequency_hz", in.frequency_hz, 1e3, 2e6, "frequency; above 100 kHz the law is extrapolated");
  verb.number("sound_speed_mps", in.sound_speed_mps, 1300, 1700, "of the water at the seabed");
  verb.number("grazing_deg", in.grazing_deg, 0, 90, "grazing angle from the seabed");
  verb.number("facet_slope_deg", in.facet_slope_deg, 0, 35, "rms slope of a mesh's facets, for facets_db");
}

std::vector<std::pair<std::string, int>> materials() {
  std::vector<std::pair<std::string, int>> all;
  for (const auto& row : seabed::named_materials()) all.emplace_back(row.name, static_cast<int>(all.size()));
  return all;
}

}  // namespace

void add_backscatter(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(app, "backscatter",
                                  "backscatter strength of the seabed after TR 9407, by parts, dB re 1 m2 per m2; the\n"
                                  "parameters that were used; the same from a look-up table, and that of the facets\n"
                                  "of a mesh which has part of the relief; loss of a reflection");
  const auto in = std::make_shared<Inputs>();
  add_inputs(verb, *in);
  const auto table = std::make_shared<LastTable>(), facets = std::make_shared<LastTable>();
  verb.results({"rho", "nu", "delta", "sigma2", "gamma", "w2_cm4", "in_range", "kirchhoff_db", "composite_db",
                "large_roughness_db", "roughness_db", "volume_db", "total_db", "capped_db", "table_db", "facets_db",
                "forward_loss_db"},
               [in, table, facets] {
                 const auto use = in->sediment();
                 const double grazing_rad = in->grazing_deg * std::numbers::pi / 180.0;
                 const auto part =
                     seabed::SedimentBackscatter(use, in->frequency_hz, in->sound_speed_mps).parts(grazing_rad);
                 const auto capped = seabed::law_of(seabed::CappedSediment{use}, in->frequency_hz, in->sound_speed_mps);
                 const auto grazing = static_cast<float>(grazing_rad);
                 const double slope = std::tan(in->facet_slope_deg * std::numbers::pi / 180.0);
                 const auto& look_up = table->of(use, 0.0, in->frequency_hz, in->sound_speed_mps);
                 const auto& of_facets = facets->of(use, slope * slope, in->frequency_hz, in->sound_speed_mps);
                 return Verb::Row{use.density_ratio,
                                  use.sound_speed_ratio,
                                  use.loss,
                                  use.volume_parameter,
                                  use.spectral_exponent,
                                  use.spectral_strength_cm4,
                                  seabed::in_range(use, in->frequency_hz) ? 1.0 : 0.0,
                                  db(part.kirchhoff),
                                  db(part.composite),
                                  db(part.large_roughness),
                                  db(part.roughness),
                                  db(part.volume),
                                  db(part.total),
                                  db(capped(grazing_rad)),
                                  db(static_cast<double>(look_up.at_angle(grazing))),
                                  db(static_cast<double>(of_facets.at_angle(grazing))),
                                  seabed::forward_loss_db(use, grazing_rad)};
               });
}

void add_material(CLI::App& app, Verbs& verbs) {
  struct Inputs {
    int row = 0;
    double grazing_deg = 90.0;
    double sphere_radius_m = 0.5;
  };

  Verb& verb = verbs.emplace_back(app, "material",
                                  "backscatter strength of objects' materials, dB re 1 m2 per m2, and the target\n"
                                  "strength of a rigid sphere, dB re 1 m2");
  const auto in = std::make_shared<Inputs>();
  verb.choice("material", in->row, materials(), "what the object is made of");
  verb.number("sphere_radius_m", in->sphere_radius_m, 1e-3, 1e3, "of the rigid sphere");
  verb.number("grazing_deg", in->grazing_deg, 0, 90, "grazing angle from the object's facet");
  verb.results(
      {"impedance_mrayl", "rms_slope", "diffuse", "reflection", "total_db", "sphere_target_strength_db"}, [in] {
        const auto& material = seabed::named_materials()[static_cast<std::size_t>(in->row)].material;
        return Verb::Row{material.impedance_mrayl,
                         material.rms_slope,
                         material.diffuse,
                         seabed::normal_reflection(material),
                         db(seabed::material_backscatter(material, in->grazing_deg * std::numbers::pi / 180.0)),
                         seabed::sphere_target_strength_db(in->sphere_radius_m)};
      });
}

}  // namespace ensonify::physics
