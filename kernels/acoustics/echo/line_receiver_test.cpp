#include "kernels/acoustics/echo/line_receiver.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "kernels/acoustics/echo/multipath.h"
#include "kernels/base/testing/allocations.h"

using namespace ensonify;
using namespace ensonify::echo;
using Catch::WithinAbs;
using Complex = std::complex<double>;
constexpr double kTurn = 2 * std::numbers::pi;

static const Sampling kSampling{10e-3, 25e-6, 100};
static const SampledPulse kPulse(rectangular_pulse(100e-6), 25e-6);

static Arrival from_sine(double sine, double time_s, Complex pressure = 1.0) {
  return {time_s, std::complex<float>(pressure), {0.0F, float(sine), float(std::sqrt(1 - sine * sine))}};
}

/// Arrivals from everywhere, some of them in part before or after the sampled time.
static Arrivals many(int count) {
  const random::Stream stream{3, "arrivals"};
  Arrivals arrivals;
  for (int i = 0; i < count; ++i) {
    const auto gauss = stream.normal_pair(i, 1);
    arrivals.push_back(
        from_sine(2 * stream.uniform(i, 2) - 1, 9.9e-3 + 2.8e-3 * stream.uniform(i, 3), {gauss[0], gauss[1]}));
  }
  return arrivals;
}

static std::vector<float> sines(int count) {
  std::vector<float> beams;
  for (int i = 0; i < count; ++i) beams.push_back(float(-0.99 + 1.98 * i / (count - 1)));
  return beams;
}

static std::vector<float> uniform(int elements) {
  return beam_weights(std::vector<double>(std::size_t(elements), 1.0));
}

static Image form(const ElementLine& array, const LineReceiver::Input& input, std::span<const float> beams,
                  const WantedImage& wanted) {
  LineReceiver::Memory memory;
  Image image;
  LineReceiver(array, true).form(input, beams, std::span(&wanted, 1), std::span(&image, 1), memory);
  return image;
}
static Image form(const ElementLine& array, const LineReceiver::Input& input, std::span<const float> beams,
                  const std::vector<float>& weights) {
  return form(array, input, beams, WantedImage(weights));
}

TEST_CASE("beams are the direct sum over elements, 90 dB below the peak") {
  const auto arrivals = many(400);
  const auto beams = sines(67);
  // Half a wave, less (a line of given length), more (grating lobes), odd and even numbers, a single element.
  for (const ElementLine& array :
       {ElementLine{100, 0.5}, ElementLine{101, 0.47}, ElementLine{37, 0.9}, ElementLine{1, 0.5}}) {
    std::vector<float> weights;
    for (int m = 0; m < array.elements; ++m) weights.push_back(float(0.6 + 0.4 * std::cos(0.05 * m)) / array.elements);
    const Image image = form(array, {std::array{EchoSet{arrivals}}, kPulse, kSampling, {}}, beams, weights);
    double peak = 0.0, error = 0.0;
    for (std::size_t b = 0; b < beams.size(); ++b) {
      std::vector<Complex> direct(100);
      for (const Arrival& arrival : arrivals) {
        Complex received;
        const int middle = array.elements / 2;
        for (int m = 0; m < array.elements; ++m) {
          const double phase = kTurn * array.spacing_in_waves * (m - middle);
          received += double(weights[m]) * std::polar(1.0, phase * (double(arrival.direction_head.y()) - beams[b]));
        }
        const auto place = kPulse.place((arrival.time_s - kSampling.start_s) / kSampling.period_s);
        for (int k = 0; k < kPulse.support(); ++k) {
          if (place.first + k < 0 || place.first + k >= kSampling.count) continue;
          direct[place.first + k] += received * Complex(arrival.pressure_upa) * double(kPulse.row(place.phase)[k]);
        }
      }
      for (int k = 0; k < kSampling.count; ++k) {
        peak = std::max(peak, std::abs(direct[k]));
        error = std::max(error, std::abs(direct[k] - Complex(image.row(int(b))[k])));
      }
    }
    INFO(array.elements << " elements at " << array.spacing_in_waves);
    CHECK(20 * std::log10(error / peak) < -90.0);
  }
}

TEST_CASE("the first side lobes of a uniform line are -13.26 and -17.83 dB across beams") {
  std::vector<float> beams;
  for (int i = 0; i <= 600; ++i) beams.push_back(float(0.3 + 5e-5 * i));  // to three nulls of a line of 100 waves
  const Arrivals one{from_sine(0.3, 11e-3)};
  const Image image = form({200, 0.5}, {std::array{EchoSet{one}}, kPulse, kSampling, {}}, beams, uniform(200));
  const auto level_db = [&](int from, int to) {
    double peak = 0.0;
    for (int b = from; b < to; ++b) peak = std::max(peak, double(std::abs(image.row(b)[41])));
    return 20 * std::log10(peak);
  };
  CHECK_THAT(level_db(0, 1), WithinAbs(0.0, 1e-4));
  CHECK_THAT(level_db(200, 400), WithinAbs(-13.26, 0.01));
  CHECK_THAT(level_db(400, 600), WithinAbs(-17.83, 0.01));
  CHECK(std::abs(image.row(200)[41]) < 1e-4);  // the null at lambda / L
}

TEST_CASE("an array's halves add up to it, and their phase gives the angle off its axis") {
  const auto arrivals = many(50);
  const auto beams = sines(20);
  const array::LineArray array{1.0, std::vector<double>(60, 1.0)};
  const auto split = array::split_aperture(array);
  const auto whole = beam_weights(array.weights), lower = beam_weights(split.negative, array.weights),
             upper = beam_weights(split.positive, array.weights);
  LineReceiver receiver(element_line(array, 2.0));
  LineReceiver::Memory memory;
  std::vector<Image> images(3);
  const std::vector<WantedImage> weights{WantedImage(whole), WantedImage(lower), WantedImage(upper)};
  receiver.form({std::array{EchoSet{arrivals}}, kPulse, kSampling, {}}, beams, weights, images, memory);
  const Image alone =
      form(element_line(array, 2.0), {std::array{EchoSet{arrivals}}, kPulse, kSampling, {}}, beams, whole);
  for (std::size_t i = 0; i < images[0].envelope_upa.size(); ++i) {
    REQUIRE(std::abs(alone.envelope_upa[i] - images[0].envelope_upa[i]) < 1e-4);
    REQUIRE(std::abs(images[1].envelope_upa[i] + images[2].envelope_upa[i] - images[0].envelope_upa[i]) < 1e-4);
  }
  const std::vector<float> beam{0.2F};
  const Arrivals one{from_sine(0.205, 11e-3)};
  const std::vector<WantedImage> two{WantedImage(lower), WantedImage(upper)};
  std::vector<Image> pair(2);
  receiver.form({std::array{EchoSet{one}}, kPulse, kSampling, {}}, beam, two, pair, memory);
  const auto product = pair[1].row(0)[41] * std::conj(pair[0].row(0)[41]);
  CHECK(std::arg(product) == Approx(kTurn * 0.5 * split.baseline_m * 0.005).epsilon(1e-4));  // waves of 2 m
}

TEST_CASE("sums of mean squares have the power pattern") {
  const auto beams = sines(51);
  const auto weights = uniform(40);
  const Arrivals one{from_sine(0.1, 11e-3)};
  const Image wave = form({40, 0.5}, {std::array{EchoSet{one}}, kPulse, kSampling, {}}, beams, weights);
  const SampledPulse squared = kPulse.squared();
  const Image root = form({40, 0.5}, {std::array{EchoSet{one}}, kPulse, kSampling, {}, &squared}, beams,
                          WantedImage(weights, Sum::kMeanSquare));
  for (int b = 0; b < 51; ++b) {
    REQUIRE_THAT(std::norm(root.row(b)[41]), WithinAbs(std::norm(wave.row(b)[41]), 1e-5));
    REQUIRE(root.row(b)[41].imag() == 0.0F);
  }
}

/// Mean of p q* over a silent image's samples, for beams p and q.
static Complex product(const Image& image, int p, int q) {
  Complex sum;
  for (int k = 0; k < image.samples; ++k) sum += Complex(image.row(p)[k]) * std::conj(Complex(image.row(q)[k]));
  return sum / double(image.samples);
}

TEST_CASE("isotropic noise drops by the directivity index and correlates between neighbours") {
  // Beams of a uniform line at half a wave: noise is white over sine, so the mean square is 1 / M, and two beams x
  // nulls apart have the correlation sin(pi x) / (M sin(pi x / M)). 40,000 samples: sd 0.5 %; limits are 4 sd.
  const random::Stream ambient{1, "ambient"}, electronics{1, "electronics"};
  const Sampling sampling{0, 25e-6, 40000};
  const int M = 64;
  const std::vector<float> beams{0.3F, 0.3F + 1.0F / 64, 0.3F + 2.0F / 64};  // half a null, a null apart: L = 32 waves
  const Image image =
      form({M, 0.5}, {{}, kPulse, sampling, {5, 100.0, &ambient, 0, nullptr, {}, nullptr}}, beams, uniform(M));
  CHECK(product(image, 0, 0).real() == Approx(100.0 / M).epsilon(0.02));
  CHECK_THAT(std::abs(product(image, 0, 1)) * M / 100, WithinAbs(1 / (M * std::sin(0.5 * std::numbers::pi / M)), 0.02));
  CHECK(std::abs(product(image, 0, 2)) * M / 100 < 0.02);
  // Elements close to half a wave apart, drawn from each direction: the same to the limit of the draws' own.
  const Image near = form({M, 0.494}, {{}, kPulse, sampling, {5, 100.0, &ambient, 0, nullptr, {}, nullptr}},
                          std::vector<float>{0.3F}, uniform(M));
  CHECK(product(near, 0, 0).real() == Approx(100.0 / (2 * 0.494 * M)).epsilon(0.03));
  // Elements 0.3 waves apart are correlated: DI is 10 log10(2 L / lambda), not 10 log10 M.
  const Image dense = form({M, 0.3}, {{}, kPulse, sampling, {5, 100.0, &ambient, 0, nullptr, {}, nullptr}},
                           std::vector<float>{0.1F}, uniform(M));
  CHECK(product(dense, 0, 0).real() == Approx(100.0 / (2 * 0.3 * M)).epsilon(0.03));
  // Sparse elements, 0.8 waves apart, receive a grating lobe too; at +-0.625 of the grid two aliases become one.
  const Image sparse = form({M, 0.8}, {{}, kPulse, sampling, {5, 100.0, &ambient, 0, nullptr, {}, nullptr}},
                            std::vector<float>{0.0F, 0.6F}, uniform(M));
  CHECK(product(sparse, 0, 0).real() == Approx(100.0 / (2 * 0.8 * M)).epsilon(0.03));
  CHECK(product(sparse, 1, 1).real() == Approx(2 * 100.0 / (2 * 0.8 * M)).epsilon(0.03));
}

TEST_CASE("switching one background off leaves the others' draws as they are") {
  const random::Stream a{1, "ambient"}, e{1, "electronics"}, v{1, "volume"};
  const auto beams = sines(9);
  LineReceiver receiver({33, 0.5});
  const std::vector<float> volume(std::size_t(receiver.cells()) * 100, 2.0F);
  const auto received = [&](double ambient, double electronic, bool with_volume) {
    Background background{7, ambient, &a, electronic, &e, {}, &v};
    if (with_volume) background.volume_upa2 = volume;
    return form({33, 0.5}, {{}, kPulse, kSampling, background}, beams, uniform(33));
  };
  const Image all = received(9, 5, true), ambient = received(9, 0, false), electronic = received(0, 5, false),
              reverberation = received(0, 0, true);
  for (std::size_t i = 0; i < all.envelope_upa.size(); ++i) {
    const auto sum = ambient.envelope_upa[i] + electronic.envelope_upa[i] + reverberation.envelope_upa[i];
    REQUIRE(std::abs(all.envelope_upa[i] - sum) < 1e-5F);
  }
  CHECK(product(electronic, 3, 3).real() == Approx(5.0 / 33).epsilon(0.4));  // 100 samples: sd 10 %
}

TEST_CASE("without speckle all beams together receive a pair's pressures, near or far apart") {
  const ElementLine line{37, 0.5};
  const auto weights = uniform(line.elements);
  std::vector<float> beams;  // over the whole period of sines
  for (int i = 0; i < 200; ++i) beams.push_back(float(-1.0 + 0.01 * i));
  const auto energy = [&](const Image& image, const auto& of) {
    double sum = 0.0;
    for (int b = 0; b < image.beams; ++b) sum += of(image.row(b)[41]);
    return sum / image.beams;
  };
  for (const double apart : {0.0, 0.02, 0.05, 0.08, 0.3}) {
    const Arrivals pressures{from_sine(0.2, 11e-3, 3.0), from_sine(0.2 + apart, 11e-3, 1.0)};
    const double want = energy(form(line, {std::array{EchoSet{pressures}}, kPulse, kSampling, {}}, beams, weights),
                               [](std::complex<float> p) { return double(std::norm(p)); });
    const Arrivals powers{from_sine(0.2, 11e-3, 9.0), from_sine(0.2 + apart, 11e-3, 1.0)};
    const SharedByBeams shared = shared_by_beams(line, weights);
    std::vector<float> gain{1.0F, 1.0F};
    power_gains(powers, {0, {1, 0}}, &shared, gain);
    const SampledPulse squared = kPulse.squared();
    const Image image = form(line, {std::array{EchoSet{powers, gain}}, kPulse, kSampling, {}, &squared}, beams,
                             WantedImage(weights, Sum::kMeanSquare));
    CHECK(energy(image, [](std::complex<float> p) { return double(std::norm(p)); }) == Approx(want).epsilon(2e-3));
    if (apart == 0.0) CHECK(double(std::norm(image.row(120)[41])) == Approx(16.0).epsilon(1e-3));  // (3 + 1)^2, on axis
  }
}

TEST_CASE("threads change no bit, and a ping after the first allocates nothing") {
  const auto arrivals = many(20000);
  const auto beams = sines(256);
  const random::Stream a{1, "ambient"}, e{1, "electronics"};
  const std::vector<WantedImage> weights{WantedImage(uniform(100))};
  LineReceiver receiver({100, 0.5});
  LineReceiver::Memory memory;
  std::vector<Image> one(1), two(1);
  const auto run = [&](std::vector<Image>& images, std::size_t threads, std::uint64_t ping) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    receiver.form({std::array{EchoSet{arrivals}}, kPulse, {10e-3, 25e-6, 1000}, {ping, 1.0, &a, 1.0, &e, {}, nullptr}},
                  beams, weights, images, memory);
  };
  run(one, 1, 7);
  run(two, 2, 7);
  CHECK(one[0].envelope_upa == two[0].envelope_upa);
  CHECK(std::norm(one[0].row(128)[10]) > 0);
  const long before = allocations();
  for (std::uint64_t ping = 8; ping < 28; ++ping) run(two, 2, ping);
  // On a busy machine the second thread may come late, and makes its own memory when it does.
  CHECK(allocations() - before < 20);
}

TEST_CASE("one set of arrivals or several of any size give the same bits") {
  const auto arrivals = many(5000);
  const auto beams = sines(31);
  const Image whole = form({60, 0.5}, {std::array{EchoSet{arrivals}}, kPulse, kSampling, {}}, beams, uniform(60));
  CHECK(std::norm(whole.row(15)[50]) > 0);
  for (const std::size_t size : {std::size_t{1}, std::size_t{7}, std::size_t{1024}}) {
    std::vector<Arrivals> batches((arrivals.size() + size - 1) / size);
    for (std::size_t i = 0; i < arrivals.size(); ++i) batches[i / size].push_back(arrivals[i]);
    std::vector<EchoSet> sets;
    for (const Arrivals& batch : batches) sets.push_back({batch});
    CHECK(form({60, 0.5}, {sets, kPulse, kSampling, {}}, beams, uniform(60)).envelope_upa == whole.envelope_upa);
  }
}

/// Arrivals of contributors 0 (noise) to 4 in turns, and those of one of them.
static Arrivals of_five() {
  Arrivals arrivals = many(3000);
  for (std::size_t i = 0; i < arrivals.size(); ++i) arrivals.contributor[i] = std::uint32_t(i % 5);
  return arrivals;
}
static Arrivals only(const Arrivals& arrivals, std::uint32_t contributor) {
  Arrivals some;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    if (arrivals.contributor[i] == contributor) some.push_back(arrivals[i]);
  }
  return some;
}
static ContributorSet set_of(std::initializer_list<std::uint32_t> contributors) {
  return ContributorSet(std::span(contributors.begin(), contributors.size()));
}

TEST_CASE("images of each contributor add up to the image of all, noise included") {
  const Arrivals arrivals = of_five();
  const auto beams = sines(31);
  const random::Stream ambient{1, "ambient"};
  const std::array sets{EchoSet{arrivals}};
  const LineReceiver::Input input{sets, kPulse, kSampling, {7, 4.0, &ambient}};
  std::vector<WantedImage> wanted{WantedImage(uniform(60))};
  for (std::uint32_t one = 0; one < 5; ++one) wanted.emplace_back(uniform(60), Sum::kPressure, set_of({one}));
  std::vector<Image> images(wanted.size());
  LineReceiver::Memory memory;
  LineReceiver({60, 0.5}).form(input, beams, wanted, images, memory);
  // Rounding: 2^-24 of the strongest sample, through two transforms of six terms.
  float strongest = 0.0F;
  for (const auto p : images[0].envelope_upa) strongest = std::max(strongest, std::abs(p));
  for (std::size_t i = 0; i < images[0].envelope_upa.size(); ++i) {
    std::complex<float> sum;
    for (std::size_t one = 1; one < images.size(); ++one) sum += images[one].envelope_upa[i];
    REQUIRE(std::abs(sum - images[0].envelope_upa[i]) < 2e-6F * strongest);
  }
}

TEST_CASE("an image of one contributor has the bits of its arrivals alone") {
  const Arrivals arrivals = of_five();
  const auto beams = sines(31);
  const random::Stream ambient{1, "ambient"};
  const SampledPulse squared = kPulse.squared();
  const Background background{7, 4.0, &ambient};
  std::vector<float> gain;
  for (std::size_t i = 0; i < arrivals.size(); ++i) gain.push_back(0.5F + 0.001F * float(i % 300));
  for (const Sum sum : {Sum::kPressure, Sum::kMeanSquare}) {
    for (const std::uint32_t one : {trace::kNoise, 3U}) {
      const Arrivals alone = only(arrivals, one);
      std::vector<float> own_gain;
      for (std::size_t i = 0; i < arrivals.size(); ++i) {
        if (arrivals.contributor[i] == one) own_gain.push_back(gain[i]);
      }
      const std::array all{EchoSet{arrivals, gain}}, its_own{EchoSet{alone, own_gain}};
      const Image filtered = form({60, 0.5}, {all, kPulse, kSampling, background, &squared}, beams,
                                  WantedImage(uniform(60), sum, set_of({one})));
      const Background its_background = one == trace::kNoise ? background : Background{};
      const Image by_hand =
          form({60, 0.5}, {its_own, kPulse, kSampling, its_background, &squared}, beams, WantedImage(uniform(60), sum));
      CHECK(std::ranges::any_of(by_hand.envelope_upa, [](auto p) { return std::norm(p) > 0.0F; }));
      CHECK(filtered.envelope_upa == by_hand.envelope_upa);
    }
  }
}

TEST_CASE("images of several contributors, sums and weights in one call have the bits of each alone") {
  const Arrivals arrivals = of_five();
  const auto beams = sines(31);
  const SampledPulse squared = kPulse.squared();
  const std::array sets{EchoSet{arrivals}};
  const LineReceiver::Input input{sets, kPulse, kSampling, {}, &squared};
  const std::vector<float> tapered = beam_weights(array::shading_weights({array::Shading::Window::kHann}, 60));
  const std::vector<WantedImage> wanted{
      WantedImage(uniform(60)), WantedImage(tapered), WantedImage(uniform(60), Sum::kPressure, set_of({1, 4})),
      WantedImage(tapered, Sum::kMeanSquare), WantedImage(uniform(60), Sum::kMeanSquare, set_of({2}))};
  std::vector<Image> images(wanted.size());
  LineReceiver::Memory memory;
  LineReceiver({60, 0.5}, true).form(input, beams, wanted, images, memory);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    CHECK(images[i].envelope_upa == form({60, 0.5}, input, beams, wanted[i]).envelope_upa);
  }
}

TEST_CASE("what does not fit is refused") {
  LineReceiver receiver({10, 0.5});
  LineReceiver::Memory memory;
  std::vector<Image> images(1);
  const std::vector<WantedImage> wrong{WantedImage(uniform(9))};
  CHECK_THROWS_AS(receiver.form({{}, kPulse, kSampling, {}}, {}, wrong, images, memory), std::invalid_argument);
  const std::vector<WantedImage> mean_square{WantedImage(uniform(10), Sum::kMeanSquare)};
  CHECK_THROWS_AS(receiver.form({{}, kPulse, kSampling, {}}, {}, mean_square, images, memory), std::invalid_argument);
  CHECK_THROWS_AS(receiver.form({{}, kPulse, kSampling, {}}, {}, {}, images, memory), std::invalid_argument);
  CHECK_THROWS_AS(LineReceiver({0, 0.5}), std::invalid_argument);
}
