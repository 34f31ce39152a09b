#include "kernels/seabed/material.h"

#include <memory>
#include <numbers>

#include "tools/physics/verb.h"

namespace ensonify::physics {
namespace {

struct Inputs {
  int row = 0;
  double grazing_deg = 90.0;
  double sphere_radius_m = 0.5;
};

std::vector<std::pair<std::string, int>> rows() {
  std::vector<std::pair<std::string, int>> all;
  for (const auto& row : seabed::named_materials()) all.emplace_back(row.name, static_cast<int>(all.size()));
  return all;
}

}  // namespace

void add_material(CLI::App& app, Verbs& verbs) {
  Verb& verb = verbs.emplace_back(app, "material",
                                  "backscatter strength of objects' materials, dB re 1 m2 per m2, and the target\n"
                                  "strength of a rigid sphere, dB re 1 m2");
  const auto in = std::make_shared<Inputs>();
  verb.choice("material", in->row, rows(), "what the object is made of");
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
