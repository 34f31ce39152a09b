#include "components/sonar/expected_echoes.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

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
    case SourceEnergy::Source::kInterference: source.kind = "interference"; return source;
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

/// What a source sends to some rows.
struct Piece {
  const EnergyRows& rows;
  const SourceEnergy& energy;
};

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

msg::Energies energies_message(const EnergyImage& image, std::span<const EnergyRows> parts) {
  const profile::Span span(profile::Stage::kLabels);
  msg::Energies message;
  message.stamp_ns = image.event.transmit.count();
  message.ping = image.event.ping;
  message.beams = image.rows;
  message.samples = image.sampling.count;
  message.first_sample_s = image.sampling.start_s;
  message.sample_period_s = image.sampling.period_s;

  std::map<std::pair<SourceEnergy::Source, std::uint32_t>, std::vector<Piece>> sources;
  std::vector<float> sum(static_cast<std::size_t>(image.rows * image.sampling.count));
  const auto at = [&](std::int64_t row, int k) -> float& {
    return sum[static_cast<std::size_t>(row * image.sampling.count + k)];
  };
  for (const EnergyRows& rows : parts) {
    for (const SourceEnergy& energy : rows.energies) {
      auto& pieces = sources[{energy.source, energy.contributor}];
      if (pieces.empty()) message.sources.emplace_back();
      pieces.push_back({rows, energy});
      for (std::int64_t row = 0; row < rows.count; ++row) {
        for (int k = energy.window.first; k < energy.window.end; ++k) at(rows.first + row, k) += energy.at(row, k);
      }
    }
  }
  std::ranges::transform(sources, message.sources.begin(), [](const auto& source) {
    return source_of(source.second.front().energy, source.second.front().rows.mesh);
  });

  std::vector<std::int32_t> runs;
  std::vector<float> written;
  const auto write = [&](float least_share) {
    runs.clear(), written.clear();
    std::int32_t place = 0;
    for (const auto& source : sources) {
      for (const auto& [rows, energy] : source.second) {
        for (std::int64_t row = 0; row < rows.count; ++row) {
          const auto upa2 = [&, &of = energy](int k) { return std::max(0.0F, of.at(row, k)); };
          const auto enough = [&, &in = rows](int k) {
            return upa2(k) > 0.0F && upa2(k) >= least_share * at(in.first + row, k);
          };
          for_runs(energy.window, enough, [&, &in = rows](int first, int end) {
            runs.insert(runs.end(), {place, static_cast<std::int32_t>(in.first + row), first, end});
            for (int k = first; k < end; ++k) written.push_back(upa2(k));
          });
        }
      }
      ++place;
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
