#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "components/sonar/line_design.h"
#include "components/sonar/sea_acoustics.h"
#include "components/sonar/shot_design.h"
#include "kernels/acoustics/label/image.h"
#include "kernels/acoustics/label/strips.h"
#include "messages/labels.h"

namespace ensonify {

/// Directions that some rows of an image receive from, and how.
struct LabelSector {
  double first_rad = 0.0, last_rad = 0.0;   // about the axis
  const array::Pattern* receive = nullptr;  // of one transducer; of a line an element's

  bool holds(double angle_rad) const { return angle_rad >= first_rad && angle_rad <= last_rad; }
};

/// What labels know of a head.
struct LabelView {
  label::Axes axes;
  std::vector<LabelSector> sectors;
  label::MainLobe lobe;  // of a row, besides the sector's pattern
};

/// Row of a transducer that sends and receives through one line: the two-way width at -3 dB of its far field.
label::Row aperture_row(const LineDesign& line, int sector = 0);
/// What such a row's lobe is besides its receiver's pattern: all of it, to the line's first nulls.
inline label::MainLobe aperture_lobe(const LineDesign& line) { return {line.first_null, {1.0F, 1.0F}}; }

/// Image that is labelled.
struct LabelledImage {
  const PingEvent& event;
  std::span<const label::Row> rows;
  echo::Sampling sampling;
  std::span<const float> background_upa2;  // expected of noise and water column: row by sample
  double range_m = 0.0;                    // of rays
};

/// Labels of a ping's image, from rays of their own through the ping's scene, water and motion
/// (kernels/acoustics/label): nothing is drawn, so that neither speckle nor noise changes them.
class Labeller {
 public:
  explicit Labeller(LabelView view) : view_(std::move(view)) {}

  /// Memory of the caller's: bodies without their surroundings, kept while they are there, and scratch.
  class Memory {
    friend Labeller;
    struct Alone {
      std::shared_ptr<const trace::Body> body;
      trace::Mesh mesh;
    };
    std::map<std::uint32_t, Alone> alone;  // by contributor
    ProbeMemory probed;
    std::vector<float> path_m, amplitude;
    std::vector<std::vector<label::Point>> points;

    void forget_gone(const trace::Mesh& mesh);
    const trace::Mesh& of(const trace::ShownBody& body);
  };

  /// After the shot's echoes.
  msg::Labels labels(const SeaAcoustics& sea, const Shot& shot, const trace::Mesh& mesh, const Echoed& echoed,
                     const ShotDesign& design, const LabelledImage& image, const ShotMemory& shot_memory,
                     Memory& memory) const;

 private:
  /// Directions in sine and angle.
  struct Patch {
    double lower = 0.0, upper = 0.0, first_rad = 0.0, last_rad = 0.0;

    bool empty() const { return !(upper > lower && last_rad > first_rad); }
    double solid_angle_sr() const { return (upper - lower) * (last_rad - first_rad); }
    // Of rays evenly over it, by number each way.
    double sine(int i) const;
    double angle_rad(int j) const;
  };
  /// A body that may be in the image.
  struct Candidate {
    const trace::ShownBody* body;
    Patch extent = {};  // of its silhouette
    // By the rays over it:
    bool seen = false;                           // one hits it within the image, as if it were alone
    double inside = 0.0, visible = 0.0;          // as in a label
    double grazing_rad = 0.0;                    // mean
    std::optional<frames::Vec3> hit_enu_m = {};  // middle of what is visible
  };
  struct Ping {
    const SeaAcoustics& sea;
    const Shot& shot;
    const trace::Mesh& mesh;
    const Echoed& echoed;
    const LabelledImage& image;
    const ShotMemory& shot_memory;
    Memory& memory;
  };

  std::vector<Candidate> find_bodies(const Ping& ping) const;
  std::vector<Patch> within_image(const Ping& ping, const Patch& patch) const;
  const trace::Hits& hits_over(const Ping& ping, const trace::Mesh& mesh, const Patch& patch) const;
  double narrow(const Ping& ping, const trace::Mesh& alone, Patch& extent) const;
  static msg::LabelledObject object_of(const Ping& ping, const Candidate& candidate);
  void examine(const Ping& ping, std::span<const Patch> within, Candidate& candidate) const;
  static std::vector<std::pair<double, double>> angles_of_bodies(std::span<const Candidate> bodies,
                                                                 const LabelSector& sector, double lower, double upper);
  std::vector<label::Strip> strips_of(const Ping& ping, std::span<const Candidate> bodies) const;
  void trace(const Ping& ping, const trace::Rays& rays, bool through_bodies, std::vector<label::RayEcho>& echoes) const;

  LabelView view_;
};

}  // namespace ensonify
