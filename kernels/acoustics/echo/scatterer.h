#pragma once

#include <complex>
#include <cstdint>
#include <initializer_list>
#include <tuple>
#include <vector>

#include "kernels/acoustics/trace/batch.h"
#include "kernels/base/frames/pose.h"

namespace ensonify::echo {

/// A patch of seabed that answers as one point.
struct Scatterer {
  frames::Vec3 position_enu_m = frames::Vec3::Zero();
  Eigen::Vector3f bend_enu = Eigen::Vector3f::Zero();  // the ray's direction at the head, less the straight line's
  float slowness_spm = 0.0F;                           // travel time over straight distance
  float stretch = 1.0F;                                // path length over straight distance
  float spreading = 1.0F;                              // area of the ray tube over the square of the straight distance
  float scattered_upa2m2 = 0.0F;  // mean-square pressure at 1 m that the patch sends back, before absorption
  float cross_section_m2 = 0.0F;  // what it would scatter of a plane wave: sum of sigma dA
  std::complex<float> response;   // its random part: complex Gaussian, mean square 1
  float share = 1.0F;             // of the patch's pressure that is its contributor's, as its energy is shared
  std::uint32_t contributor = 0;  // by the direct path
};

struct Scatterers : trace::Batch<Scatterers, Scatterer> {
  trace::VectorColumns<double> position_enu_m;
  trace::VectorColumns<float> bend_enu;
  std::vector<float> slowness_spm, stretch, spreading, scattered_upa2m2, cross_section_m2;
  std::vector<float> response_re, response_im, share;
  std::vector<std::uint32_t> contributor;

  Scatterers() = default;
  Scatterers(std::initializer_list<Scatterer> scatterers) {
    for (const Scatterer& scatterer : scatterers) push_back(scatterer);
  }
  template <class Self>
  static auto columns(Self& self) {
    auto& place = self.position_enu_m;
    auto& bend = self.bend_enu;
    return std::tie(self.slowness_spm, self.stretch, self.spreading, self.scattered_upa2m2, self.cross_section_m2,
                    self.response_re, self.response_im, self.share, self.contributor, place.x, place.y, place.z, bend.x,
                    bend.y, bend.z);
  }
  Scatterer operator[](std::size_t i) const {
    return {position_enu_m[i], bend_enu[i],         slowness_spm[i],     stretch[i],
            spreading[i],      scattered_upa2m2[i], cross_section_m2[i], {response_re[i], response_im[i]},
            share[i],          contributor[i]};
  }
  void set(std::size_t i, const Scatterer& scatterer) {
    position_enu_m.set(i, scatterer.position_enu_m);
    bend_enu.set(i, scatterer.bend_enu);
    slowness_spm[i] = scatterer.slowness_spm;
    stretch[i] = scatterer.stretch;
    spreading[i] = scatterer.spreading;
    scattered_upa2m2[i] = scatterer.scattered_upa2m2;
    cross_section_m2[i] = scatterer.cross_section_m2;
    response_re[i] = scatterer.response.real();
    response_im[i] = scatterer.response.imag();
    share[i] = scatterer.share;
    contributor[i] = scatterer.contributor;
  }
};

}  // namespace ensonify::echo
