#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace ensonify::seabed {

/// Material of a man-made object. A small model, ours: of the energy that its impedance reflects at normal
/// incidence, the share `diffuse` leaves by Lambert's law and the rest by mirror-like facets whose slopes are Gaussian.
/// Thick bodies (nothing comes back from a far side), no shear waves, no resonance, no frequency.
struct Material {
  double impedance_mrayl = 0.0;  // density times longitudinal speed, 1e6 kg/(m^2 s); infinity for a rigid body
  double rms_slope = 0.1;        // of relief that the mesh does not resolve, total (both directions); > 0
  double diffuse = 0.0;          // share of the reflected energy, 0..1

  bool operator==(const Material&) const = default;
};

struct NamedMaterial {
  std::string_view name;
  Material material;
};

/// rigid, metal, concrete, wood. Impedances: steel [Selfridge1985]; concrete and oak, typical textbook values.
/// Slopes and diffuse shares are assumed, not measured.
std::span<const NamedMaterial> named_materials();
std::optional<Material> material_of(std::string_view name);

/// Pressure reflected at normal incidence from sea water of 1.54 Mrayl, -1..1.
double normal_reflection(const Material& material);

/// Backscattering cross section per unit area (a ratio, not dB) of one facet of an object's mesh:
///   R^2 [(1 - diffuse) exp(-tan^2 g / s^2) / (4 pi s^2 cos^4 g) + diffuse sin^2 theta / pi],
/// theta grazing angle from the facet, clamped to 0..pi/2, g = pi/2 - theta, s rms slope. The first term is the
/// high-frequency Kirchhoff limit for Gaussian slopes, the second Lambert's law. No more energy leaves than arrives.
/// Integrated over a large sphere the facets alone give its target strength, sphere_target_strength_db().
/// @throws std::invalid_argument for an impedance or slope that is not above 0, or a share outside 0..1.
double material_backscatter(const Material& material, double grazing_rad);

/// Lambert strength mu (a ratio; sigma = mu sin^2 grazing) of a convex body's skin, so that its target strength
/// averaged over all aspects is the stated one: mu = 6 10^(TS/10) / area. For soft bodies (a diver, an animal), whose
/// own impedance is near that of water and whose echo comes from lungs, gear and bone: the level is a measured input,
/// not computed.
/// @throws std::invalid_argument unless the area is positive.
double lambert_of_target_strength(double target_strength_db, double surface_area_m2);

/// Target strength of a rigid sphere in the high-frequency limit, 20 log10(a / 2), in dB re 1 m^2. Within 0.7 dB of the
/// exact series from ka = 10 on, k = 2 pi f / c.
/// @throws std::invalid_argument unless the radius is positive.
double sphere_target_strength_db(double radius_m);

}  // namespace ensonify::seabed
