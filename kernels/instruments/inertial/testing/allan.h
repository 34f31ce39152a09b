#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Allan deviation: how far successive means of a sensor's reading differ, by the time over which they are taken. Each
/// kind of noise has its own slope [IEEE952, annex C].
namespace ensonify::inertial {

struct AllanPoint {
  double time_s;     // tau, over which means are taken
  double deviation;  // in the unit of the readings
};

/// Overlapping estimate from readings at equal intervals, each the mean over its interval, for each number of samples
/// per mean. Relative standard error about 1 / sqrt(2 T / tau) or better, T the length of the record [Riley2008].
/// Throws std::invalid_argument unless interval > 0 and each size is between 1 and half the readings.
std::vector<AllanPoint> allan_deviation(std::span<const double> readings, double interval_s,
                                        std::span<const std::size_t> samples_per_mean);

/// 1, 2, 4 ... up to a `shortest_share`-th of the readings: sizes that leave at least that many means.
std::vector<std::size_t> octaves(std::size_t readings, std::size_t shortest_share = 9);

// What each noise of TriadErrors gives, tau much longer than the sampling interval.
double allan_of_white(double random_walk, double time_s);                         // N / sqrt(tau)
double allan_of_rate_random_walk(double rate_random_walk, double time_s);         // K sqrt(tau / 3)
double allan_of_gauss_markov(double sigma, double correlation_s, double time_s);  // [IEEE952, eq. C.18]
double allan_of_quantum(double quantum, double time_s);  // sqrt(3) Q / tau with Q = quantum / sqrt(12)

/// The sigma of a Gauss-Markov bias whose Allan deviation peaks at the floor 0.664 B of a bias instability B
/// (flicker noise) [IEEE952]: 1.0755 B. At the peak tau is 1.89 times the correlation time.
double gauss_markov_sigma_of_instability(double bias_instability);

}  // namespace ensonify::inertial
