#include "components/runtime/head/samples.h"

#include <memory>

#include "components/runtime/config/config_reader.h"

namespace ensonify {
namespace {

template <class T>
msg::Array<T> array_of(const echo::Image& image, std::shared_ptr<std::vector<T>> values) {
  const T* data = values->data();
  return msg::Array<T>::view({static_cast<std::size_t>(image.beams), static_cast<std::size_t>(image.samples)},
                             std::move(values), data);
}

}  // namespace

void read_converter(ConfigReader& from, Converter& converter) {
  auto section = from.optional_section("converter");
  if (!section) return;
  section->optional("bits", converter.bits, 0, 16);
  section->optional("full_scale_upa", converter.full_scale_upa, 1.0, 1e15);
}

echo::TvgLaw tvg_of(const HeadSettings& settings, double sound_speed_mps) {
  echo::TvgLaw law;
  law.spreading_db = settings.gain_spreading_db;
  law.absorption_dbpm = settings.gain_absorption_dbpm;
  law.offset_db = settings.gain_offset_db;
  law.sound_speed_mps = sound_speed_mps;
  return law;
}

void write_samples(const echo::TvgLaw& gain, const Converter& converter, const echo::Sampling& sampling,
                   echo::Image& envelope, msg::Ping& ping) {
  ping.first_sample_s = sampling.start_s;
  ping.sample_period_s = sampling.period_s;
  auto amplitude = std::make_shared<std::vector<float>>();
  if (converter.bits == 0) {
    echo::amplitude_upa(envelope, *amplitude);
    ping.amplitude_upa = array_of(envelope, std::move(amplitude));
    return;
  }
  std::vector<float> gain_db;
  echo::tvg_db(gain, sampling, gain_db);
  echo::apply_gain(gain_db, envelope);
  echo::amplitude_upa(envelope, *amplitude);
  auto counts = std::make_shared<std::vector<std::uint16_t>>();
  ping.count_upa = converter.full_scale_upa / ((1 << converter.bits) - 1);
  echo::amplitude_counts(*amplitude, ping.count_upa, converter.bits, *counts);
  ping.amplitude_count = array_of(envelope, std::move(counts));
}

}  // namespace ensonify
