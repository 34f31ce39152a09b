#include "components/sonar/samples.h"

#include <memory>

#include "kernels/base/profile/profile.h"

namespace ensonify {
namespace {

template <class T>
msg::Array<T> array_of(int samples, std::shared_ptr<std::vector<T>> values) {
  const T* data = values->data();
  const std::size_t beams = values->size() / static_cast<std::size_t>(samples);
  return msg::Array<T>::view({beams, static_cast<std::size_t>(samples)}, std::move(values), data);
}

}  // namespace

echo::TvgLaw tvg_of(const HeadSettings& settings, double sound_speed_mps) {
  echo::TvgLaw law;
  law.spreading_db = settings.gain_spreading_db;
  law.absorption_dbpm = settings.gain_absorption_dbpm;
  law.offset_db = settings.gain_offset_db;
  law.sound_speed_mps = sound_speed_mps;
  return law;
}

msg::Ping ping_message(const PingEvent& event, const char* kind, double frequency_hz, const HeadSettings& settings,
                       double sound_speed_mps) {
  msg::Ping ping;
  ping.stamp_ns = event.transmit.count();
  ping.ping = event.ping;
  ping.kind = kind;
  fill(ping.applied, settings);
  ping.applied.frequency_hz = frequency_hz;
  ping.applied.sound_speed_mps = sound_speed_mps;
  return ping;
}

void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   const echo::Image& envelope, msg::Ping& ping) {
  auto amplitude = std::make_shared<std::vector<float>>();
  {
    const profile::Span span(profile::Stage::kMessage);
    echo::amplitude_upa(envelope, *amplitude);
  }
  write_samples(gain, converter, sampling, std::move(amplitude), ping);
}

void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   std::shared_ptr<std::vector<float>> amplitude_upa, msg::Ping& ping) {
  const profile::Span span(profile::Stage::kMessage);
  ping.first_sample_s = sampling.start_s;
  ping.sample_period_s = sampling.period_s;
  if (converter.bits == 0) {
    ping.amplitude_upa = array_of(sampling.count, std::move(amplitude_upa));
    return;
  }
  std::vector<float> gain_db, behind_gain(*amplitude_upa);
  echo::tvg_db(gain, sampling, gain_db);
  echo::apply_gain(gain_db, behind_gain);
  auto counts = std::make_shared<std::vector<std::uint16_t>>();
  ping.count_upa = converter.full_scale_upa / ((1 << converter.bits) - 1);
  echo::amplitude_counts(behind_gain, ping.count_upa, converter.bits, *counts);
  ping.amplitude_count = array_of(sampling.count, std::move(counts));
}

}  // namespace ensonify
