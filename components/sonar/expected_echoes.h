#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "components/sonar/head_config.h"
#include "components/sonar/sea_acoustics.h"
#include "components/sonar/shot_design.h"
#include "components/sonar/source_energy.h"
#include "messages/labels.h"

namespace ensonify {

/// So many sources at most reach each sample of an image, all in all: what a message of them takes, in images.
inline constexpr std::size_t kEnergySources = 16;

/// Image that energies are of.
struct EnergyImage {
  const PingEvent& event;
  std::int64_t rows = 0;
  echo::Sampling sampling;
};

/// Energies of some rows of an image, with the mesh that names their bodies.
struct EnergyRows {
  std::int64_t first = 0, count = 0;
  const trace::Mesh& mesh;
  std::vector<SourceEnergy> energies;
};

/// What each source of a ping sends.
msg::Energies energies_message(const EnergyImage& image, std::span<const EnergyRows> parts);

/// A head's effects without what is drawn in echoes.
inline Effects without_speckle(Effects effects) {
  effects.speckle = false;
  return effects;
}

/// What a head is to expect of a ping: its echoes once more, as mean squares. Echoes are ArrayEchoes or ApertureEchoes,
/// made as the head's own but without speckle.
template <class Echoes>
class ExpectedEchoes {
 public:
  explicit ExpectedEchoes(Echoes echoes) : echoes_(std::move(echoes)) {}

  /// Memory of the caller's: its contents do not matter.
  struct Memory {
    ShotMemory shot;
    typename Echoes::Memory beams;
  };

  /// Of what a ping has insonified; receive(foreign) is how the head receives.
  template <class Receive>
  msg::Energies of(const EnergyImage& image, const Shot& shot, const trace::Mesh& mesh, const Insonified& insonified,
                   const ShotDesign& design, const Receive& receive, Memory& memory) const {
    const SeaAcoustics& sea = echoes_.sea();
    const Echoed echoed = sea.echoes(shot, insonified, memory.shot);
    const echo::Arrivals& foreign = sea.interference(shot, echoed, image.event.interfering, design.pulse, memory.shot);
    const EnergyRows all{0, image.rows, mesh, echoes_.energies(shot, echoed, design, receive(foreign), memory.beams)};
    return energies_message(image, {&all, 1});
  }

 private:
  Echoes echoes_;
};

}  // namespace ensonify
