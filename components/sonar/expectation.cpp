#include "components/sonar/expectation.h"

#include <algorithm>
#include <string>

#include "kernels/base/profile/profile.h"

namespace ensonify {
namespace {

constexpr float kLeastShare = 1e-6F;  // of a sample, that is written; more where that would be too much
constexpr int kBetweenRuns = 4;       // samples: runs nearer to each other are one

std::string path_name(trace::EchoPath path) {
  switch (path) {
    case trace::EchoPath::kDirect: return "direct";
    case trace::EchoPath::kViaSurface: return "surface";
    case trace::EchoPath::kViaBottom: return "bottom";
  }
  return "";
}

msg::EnergySource source_of(const SourceEnergy& energy, const trace::Mesh& mesh) {
  msg::EnergySource source;
  source.path = path_name(trace::EchoPath::kDirect);
  switch (energy.source) {
    case SourceEnergy::Source::kNoise: source.kind = "noise"; return source;
    case SourceEnergy::Source::kVolume: source.kind = "volume"; return source;
    case SourceEnergy::Source::kOtherHeads: source.kind = "other heads"; return source;
    case SourceEnergy::Source::kSurface: source.kind = "surface"; return source;
    case SourceEnergy::Source::kContributor: break;
  }
  const trace::Contributor& contributor = mesh.contributors()[energy.contributor];
  source.path = path_name(contributor.path);
  source.sediment = contributor.sediment;
  source.kind = "seabed";
  const auto bodies = mesh.bodies();
  const auto body = std::ranges::find(bodies, trace::by_path(energy.contributor, trace::EchoPath::kDirect),
                                      &trace::ShownBody::contributor);
  if (body == bodies.end()) return source;
  source.kind = "object";
  source.instance = body->body->instance;
  source.name = body->body->name;
  source.class_name = body->body->class_name;
  source.class_id = body->body->label_class;
  return source;
}

/// Runs of samples of which an energy is enough.
template <class Enough, class Add>
void for_runs(const echo::SampleWindow& window, const Enough& enough, const Add& add) {
  int first = -1, end = -1;
  for (int k = window.first; k < window.end; ++k) {
    if (!enough(k)) continue;
    if (first >= 0 && k - end >= kBetweenRuns) {
      add(first, end);
      first = -1;
    }
    if (first < 0) first = k;
    end = k + 1;
  }
  if (first >= 0) add(first, end);
}

}  // namespace

msg::Energies energies_message(const EnergyImage& image, const trace::Mesh& mesh,
                               std::span<const SourceEnergy> energies) {
  const profile::Span span(profile::Stage::kLabels);
  msg::Energies message;
  message.stamp_ns = image.event.transmit.count();
  message.ping = image.event.ping;
  message.beams = image.rows;
  message.samples = image.samples;
  const auto samples = static_cast<std::size_t>(image.samples);
  std::vector<float> sum(static_cast<std::size_t>(image.rows) * samples);
  const auto at = [](const SourceEnergy& energy, std::int64_t row, int k) {
    return energy.upa2[static_cast<std::size_t>(row * energy.window.count() + k - energy.window.first)];
  };
  for (const SourceEnergy& energy : energies) {
    for (std::int64_t row = 0; row < image.rows; ++row) {
      for (int k = energy.window.first; k < energy.window.end; ++k)
        sum[static_cast<std::size_t>(row) * samples + static_cast<std::size_t>(k)] += at(energy, row, k);
    }
  }
  for (const SourceEnergy& energy : energies) message.sources.push_back(source_of(energy, mesh));
  std::vector<std::int32_t> runs;
  std::vector<float> written;
  const auto write = [&](float least_share) {
    runs.clear(), written.clear();
    for (std::size_t place = 0; place < energies.size(); ++place) {
      const SourceEnergy& energy = energies[place];
      for (std::int64_t row = 0; row < image.rows; ++row) {
        const auto enough = [&](int k) {
          const float upa2 = at(energy, row, k);
          return upa2 > 0.0F &&
                 upa2 >= least_share * sum[static_cast<std::size_t>(row) * samples + static_cast<std::size_t>(k)];
        };
        for_runs(energy.window, enough, [&](int first, int end) {
          runs.insert(runs.end(), {static_cast<std::int32_t>(place), static_cast<std::int32_t>(row), first, end});
          for (int k = first; k < end; ++k) written.push_back(std::max(0.0F, at(energy, row, k)));
        });
      }
    }
  };
  float least_share = kLeastShare;
  write(least_share);
  while (runs.size() + written.size() > kEnergySources * sum.size()) write(least_share *= 10.0F);
  message.run = msg::Array<std::int32_t>({runs.size() / 4, 4});
  std::ranges::copy(runs, message.run.data());
  message.energy_upa2 = msg::Array<float>::of(written);
  return message;
}

}  // namespace ensonify
