#include "components/sonar/source_energy.h"

#include <map>

namespace ensonify {

void add_energies(const echo::EchoSet& echoes, const echo::EchoSet& coherent, const echo::EchoSet& foreign,
                  const echo::SampledPulse& pulse, const echo::Sampling& sampling, const FormEnergies& form,
                  std::vector<SourceEnergy>& energies) {
  const auto add = [&](SourceEnergy::Source source, std::uint32_t contributor, std::span<const echo::EchoSet> squares,
                       std::span<const echo::EchoSet> pressures) {
    const echo::SampleWindow a = window_of(squares, pulse, sampling), b = window_of(pressures, pulse, sampling);
    const echo::SampleWindow window = a.empty() ? b
                                      : b.empty()
                                          ? a
                                          : echo::SampleWindow{std::min(a.first, b.first), std::max(a.end, b.end)};
    if (!window.empty()) energies.push_back({source, contributor, window, form(squares, pressures, window)});
  };
  add(SourceEnergy::Source::kInterference, trace::kNoise, {&foreign, 1}, {});
  const std::vector<echo::OfContributor> rough = by_contributor(echoes), smooth = by_contributor(coherent);
  struct Sets {
    std::vector<echo::EchoSet> squares, pressures;
  };
  std::map<std::uint32_t, Sets> sets;
  for (const echo::OfContributor& part : rough) sets[part.contributor].squares.push_back(part.set());
  for (const echo::OfContributor& part : smooth) sets[part.contributor].pressures.push_back(part.set());
  for (const auto& [contributor, of] : sets) {
    const auto source =
        contributor == trace::kNoise ? SourceEnergy::Source::kSurface : SourceEnergy::Source::kContributor;
    add(source, contributor, of.squares, of.pressures);
  }
}

}  // namespace ensonify
