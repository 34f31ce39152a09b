#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/acoustics/trace/body.h"
#include "kernels/acoustics/trace/ray.h"
#include "kernels/acoustics/trace/scene.h"
#include "kernels/base/frames/pose.h"
#include "kernels/base/profile/profile.h"
#include "kernels/base/random/stream.h"
#include "kernels/water/refraction/path_table.h"

namespace ensonify::trace {

/// From where rays go to facets, and how far. `refracted` is what Mesh::tabulate made for this head; null: paths are
/// straight.
struct FacetView {
  const frames::HeadPose& head;
  double max_range_m;
  const refraction::PathTable* refracted;
};

/// What rays go to besides directions.
struct Targets {
  std::span<const Object> objects;
  std::span<const ShownBody> bodies = {};
  double wavelength_m = 0.0;  // of the carrier: pieces of smooth bodies are as small as it asks for,
  double patch_m = 1.0;       // those of others as patches of the seabed that answer as one point

  Targets() = default;
  Targets(std::span<const Object> of) : objects(of) {}  // NOLINT(google-explicit-constructor): these alone
  Targets(const Mesh& of, double wave_m, double of_patch_m)
      : objects(of.objects()), bodies(of.bodies()), wavelength_m(wave_m), patch_m(of_patch_m) {}
};

/// A ray's place on a body.
struct BodyTarget {
  std::uint32_t tile = 0;      // the body's number, as Hit has it
  const Body* body = nullptr;  // while its mesh lives
  solids::Facet facet;         // a piece of the surface
  std::uint64_t piece = 0;     // its number: it does not depend on the head's place, but for smooth bodies
  float area_m2 = 0.0F;        // of the surface that it stands for
  float within_m = 0.0F;       // a hit counts that is no farther from the place
  frames::Vec3 place_enu_m = frames::Vec3::Zero();
};

/// Targets of rays to facets, and the cells whose facets have such rays.
struct FacetTargets {
  struct Facet {
    std::uint32_t tile;   // its number
    std::uint32_t facet;  // 2 (row x columns + column), and 1 for the north-eastern half of the cell
    float area_m2;        // its share of it
  };
  struct Tile {  // that has such cells
    std::uint32_t number;
    const terrain::Tile* tile;
    std::size_t first_cell;  // of those below
  };
  std::vector<Facet> facets;  // by ray
  std::vector<Tile> tiles;    // by number
  std::vector<bool> cells;    // whether taken, tile by tile, row by row
  // Of bodies: their rays come after those of the facets above.
  std::vector<BodyTarget> body_pieces;  // by ray
  std::vector<std::uint32_t> bodies;    // numbers of those that other rays pass over, rising
};

/// Rays to facets, yet without solid angles, and scratch of their choice.
struct FacetMemory {
  struct Facet {
    FacetTargets::Facet target;
    std::array<frames::Vec3, 3> corners_enu_m;
    std::size_t object;
    double wanted;
  };
  Rays rays;
  std::vector<Facet> facets;
  struct Found {  // by a task: facets, and the objects that they are of
    std::vector<Facet> facets;
    std::vector<std::size_t> objects;
  };
  std::vector<Found> found;
  struct Piece {
    std::uint32_t body;    // of those that are shown
    std::uint64_t number;  // among the body's
    solids::Facet facet;
    double wanted;
  };
  std::vector<Piece> pieces;  // of bodies
};

/// One of the two coordinates of a direction, and what the head does along it.
struct Span {
  double low = 0.0, high = 0.0;            // rays go from here to there
  double main_low = 0.0, main_high = 0.0;  // the main lobe, null to null: full density; less beyond, as 1 / distance^2
  double beam = 0.0;                       // -3 dB width of what beams resolve, or of the lobe where nothing does
};

/// Transmit volume of a head, in its own frame: u is the sine of the angle from the plane across an axis of the head,
/// phi the angle around that axis, towards starboard. Then dOmega = du dphi exactly.
struct TransmitVolume {
  enum class Axis {
    kForward,  // phi = 0 points down: across-track angle of a multibeam or a sidescan (phi < 0 is to port)
    kDown      // phi = 0 points forward: azimuth of a forward-looking or scanning head; u is the sine of the depression
  };
  Axis axis = Axis::kForward;
  Span sine;       // u, within -1..1
  Span angle_rad;  // phi, at most a full circle
};

/// Narrow along-track, wide across-track: transmit and receive lines L / lambda waves long, and rays to
/// `reach` lambda / L fore and aft (1 is the first null). half_swath_rad is to port and starboard.
TransmitVolume mills_cross_volume(double transmit_length_in_waves, double receive_length_in_waves,
                                  double half_swath_rad, double reach = 8.0);

struct RaySettings {
  /// In the main lobe, a resolution cell (range resolution x beam, -3 dB) gets 12 rays times this on average and a
  /// facet 10. At kNormal every cell within -10 dB has at least 10, and of 1000 facets in the main lobe 999 are hit;
  /// kPreview is for a quick preview and kReference to compare with.
  double quality = kNormal;
  double range_resolution_m = 0.1;    // c tau / 2, or c / 2B of a chirp
  std::size_t most_rays = 4'000'000;  // per transmission: every cell gives way by the same share beyond
  std::size_t fewest_rays = 0;        // at normal quality, else that times the quality: cells share in what is missing
  double fewest_in_main_cell = 0.0;   // rays to a cell of directions in the main lobe, at any quality; less beyond

  static constexpr double kPreview = 0.25, kNormal = 1.0, kReference = 4.0;
  /// Cells of directions with as many rays aim them at places of the world, where they see ground.
  static constexpr double kToPlaces = 40.0;
};

/// Rays over a transmit volume, denser where the seabed asks for it.
///
/// The volume is cut into some thousand cells of direction. One probe ray to each corner gives how far away and how
/// wide apart the seabed is that a cell sees; from that follows how many rays the cell needs, so that each resolution
/// cell (range resolution x beam) and each facet that it sees gets the number that the quality asks for. Where
/// neighbouring corners see different things (the edge of a boulder, the end of a shadow) they are far apart and the
/// cell gets many rays; at grazing incidence likewise.
///
/// Where a cell sees ground below, its rays aim at places of the world (ground_lattice.h) on the
/// horizontal plane next to what they see: a head that moved a little has rays to the same places, so its echoes come
/// from the same scatterers. Elsewhere, and where a cell has fewer than forty rays, it is cut into as many equal
/// strata, with one ray at a random place in each, the same as the head sees them. Either way rays are a fair sample of
/// the volume whatever the density, all together carry its solid angle exactly, and the same pose over the same tiles
/// has the same rays.
///
/// Small things that probes may miss come as objects (Mesh::objects()). Each of their facets in the volume has rays of
/// its own (FacetRays): 16 at normal quality, at least one in the main lobe, and more where it is larger than
/// what is resolved. So has each piece of a body that faces the head (Mesh::bodies()), a body at least 64 at any
/// quality. A smooth body has one ray to each piece across which the wave is plane, and no other counts.
///
/// The number of rays grows with what is seen, about rays per cell x (resolution cells or facets, whichever are more)
/// in the main lobe, and a third more beyond it; not with the number of beams. A corner that hits nothing counts as
/// lying on the plane of the farthest facet that its cell sees, and no farther than the range. A cell that sees nothing
/// has one ray.
class RayDistribution {
  struct Part;
  struct Aimed {  // rays of a part: the first `count`; room for more is kept
    Rays rays;
    std::size_t count = 0;
  };

 public:
  /// Throws std::invalid_argument for empty or overlapping spans, and for settings that are not positive.
  RayDistribution(const TransmitVolume& volume, const RaySettings& settings, const random::Stream& stream);

  /// Turn of the volume: to a sine, as phase shifts along the axis do, and by an angle about the axis. Neither changes
  /// solid angles; sines beyond -1 and 1 are lost.
  struct Steer {
    double sine = 0.0, angle_rad = 0.0;
  };
  /// Directions of the rays, as steered.
  TransmitVolume volume(const Steer& steer) const;

  /// Rays traced first, one to each corner of the cells; their solid angles are 0.
  struct Probes {
    std::vector<double> sine_edges, angle_edges_rad;  // of the cells, as steered
    Rays rays;
  };
  void probe(const Steer& steer, Probes& probes) const;

  /// Rays of one transmission as they are planned: how many go where. First come those that are spread over directions,
  /// then those to facets. Memory of the caller's.
  class Plan {
   public:
    std::size_t rays() const { return spread_ + facets_.rays.size(); }
    /// Of the rays that the quality asks for; less where most_rays limits them, more where there are fewest_rays.
    double share() const { return share_; }

   private:
    friend RayDistribution;
    frames::HeadPose head_;
    std::vector<Part> parts_;
    bool keeps_ = false;  // of few rays those to places, by part, so that they are not made twice
    std::vector<Aimed> kept_;
    std::size_t spread_ = 0;     // rays over directions
    float places_scale_ = 1.0F;  // of the solid angles of rays to places, which share that of their parts
    double share_ = 1.0;
    FacetTargets to_facets_;
    FacetMemory facets_;
    Probes probes_;
    Hits probe_hits_;
  };
  /// Plans the rays for what probes hit within max_range_m, and for the targets' facets. trace(rays, hits) finds what
  /// rays hit. Through bent water `refracted` is what Mesh::tabulate made for this head. Throws std::invalid_argument
  /// unless there is one hit per probe.
  template <class Trace>
  void aim(const frames::HeadPose& head, const Steer& steer, const Targets& targets, float max_range_m,
           const refraction::PathTable* refracted, const Trace& trace, Plan& plan) const {
    plan.head_ = head;
    {
      const profile::Span span(profile::Stage::kProbes);
      probe(steer, plan.probes_);
      trace(plan.probes_.rays, plan.probe_hits_);
    }
    const profile::Span span(profile::Stage::kRays);
    aim_beyond_probes(targets, max_range_m, refracted, plan);
  }

  /// Some of a plan's rays, and what they hit. Memory of the caller's.
  class Batch {
   public:
    Rays rays;
    Hits hits;
    /// Of the last so many rays: what they were to hit. Those of smooth bodies that did not are misses.
    std::span<const BodyTarget> to_bodies;

   private:
    friend RayDistribution;
    std::size_t first_ = 0;  // of the plan's rays
    std::vector<Aimed> parts_;
  };
  /// The rays from `first` on, at most `count`, traced: trace(rays, hits) finds what they hit. Only then do those to
  /// facets carry a solid angle, and do hits that do not count become misses. A function of the plan: batches may be
  /// traced in any order. Neighbours follow each other; batches that begin at multiples of 16 have the packets of the
  /// whole. Throws std::invalid_argument unless there is one hit per ray.
  template <class Trace>
  void trace(const Plan& plan, std::size_t first, std::size_t count, const Trace& trace, Batch& batch) const {
    {
      const profile::Span span(profile::Stage::kRays);
      fill(plan, first, count, batch);
    }
    const profile::Span span(profile::Stage::kTrace, batch.rays.size());
    trace(batch.rays, batch.hits);
    settle(plan, batch);
  }

 private:
  static constexpr double kRaysPerCell = 12.0;  // of resolution, at normal quality
  struct Need {
    double rays = 1.0, sine_to_angle = 1.0;  // strata, and their number along u over that along phi
    double plane_m = 0.0;                    // how far below the head the plane lies that they aim at; 0: none
  };
  struct Place {  // of the head
    const frames::HeadPose& head;
    Eigen::Matrix3d enu_from_head;
  };
  struct View : Place {
    const Probes& probes;
    const Hits& hits;
    double max_range_m;
  };
  struct Part {  // of the volume: a cell
    double low_sine, high_sine, low_rad, high_rad;
    Need need;
    std::uint32_t along_sine = 1, along_angle = 1;  // strata
    double to_places_sr = 0.0;                      // that rays carry to places; 0: none aims at any
    std::size_t first_ray = 0, rays = 0;            // of its rays among all
    std::size_t strata() const { return std::size_t{along_sine} * along_angle; }
    double solid_angle_sr() const { return (high_sine - low_sine) * (high_rad - low_rad); }
  };
  struct Corners;
  std::size_t columns() const { return angle_edges_rad_.size() - 1; }
  std::size_t corner(std::size_t i, std::size_t j) const { return i * angle_edges_rad_.size() + j; }
  double importance_of(std::size_t cell) const;
  bool find_corners(std::size_t i, std::size_t j, const View& view, Corners& corners) const;
  Need need(std::size_t i, std::size_t j, const View& view) const;
  /// Two triangles to a square of the posts' spacing.
  static double facing_facets_per_sr(double range_m, double facet_m) {
    return 2.0 * range_m * range_m / (facet_m * facet_m);
  }
  /// Sine and angle of a direction, the angle in the turn about the volume's middle.
  std::array<double, 2> coordinates_of(const Probes& probes, const frames::Vec3& direction_head) const;
  // What a transmission asks of rays to facets. Vectors are launch directions times distances, head frame.
  /// Number of rays that a facet with these corners needs; below 1 it has one with that probability.
  double rays_to_facet(const Probes& probes, const std::array<frames::Vec3, 3>& corners_head_m) const;
  /// Whether a ray goes there at all.
  bool holds(const Probes& probes, const frames::Vec3& direction_head) const;
  /// Whether a ray may go to a ball; where it may not, objects cost nothing.
  bool touches(const Probes& probes, const frames::Vec3& middle_head_m, double radius_m) const;
  void gather_facets(const Probes& probes, std::span<const Object> objects, const FacetView& view, FacetMemory& memory,
                     FacetTargets& targets) const;
  bool add_facets(const Probes& probes, const Object& object, std::size_t number, const FacetView& view,
                  std::vector<FacetMemory::Facet>& facets) const;
  /// Rays to the facets of small objects.
  ///
  /// Rays that are spread over directions miss what is small or seen edge-on. So each facet has rays of its own, to
  /// places that are spread over it and stay with it. Such a ray counts if its facet is the first that it hits, and
  /// stands for its share of the facet's area: it carries the solid angle area sin(grazing) / tube, as it then finds
  /// them. Rays that are spread over directions and hit a facet that has its own do not count: nothing is counted
  /// twice, and what lies behind stays hidden. Both are unbiased, so their sum is.
  ///
  /// In refracting water the launch direction is that of the eigenray, exact at the corners of the object's box
  /// (distance and depth) and between them by straight lines of its difference to the straight direction. An object
  /// that no path reaches, or several with directions apart, is left to the other rays; so is one that is wider than
  /// its distance.
  ///
  /// Chooses the rays to these objects, memory.rays. Where they are too many all facets give way by the same share;
  /// twice as many come at the utmost, for they are whole.
  void aim_at_facets(const Probes& probes, std::span<const Object> objects, const FacetView& view, FacetMemory& memory,
                     FacetTargets& targets) const;
  static std::size_t cut(double share, std::span<Part> parts);
  /// The same of bodies; their rays are appended.
  void aim_at_bodies(const Probes& probes, const Targets& of, const FacetView& view, FacetMemory& memory,
                     FacetTargets& targets) const;
  void gather_pieces(const Probes& probes, const Targets& of, std::uint32_t body, const FacetView& view, double coarser,
                     FacetMemory& memory) const;
  static void settle_body_rays(const FacetTargets& targets, std::size_t spread, Batch& batch);
  void aim_beyond_probes(const Targets& targets, float max_range_m, const refraction::PathTable* refracted,
                         Plan& plan) const;
  /// Counts the rays of a part, and what they carry to places; keeps those unless `kept` is null.
  void count_part(const Place& head, Part& part, Aimed* kept) const;
  void fill_part(const Plan& plan, std::size_t index, const Place& head, Aimed& aimed) const;
  void fill(const Plan& plan, std::size_t first, std::size_t count, Batch& batch) const;
  static void settle(const Plan& plan, Batch& batch);
  /// Appends rays to all places of the part's plane that lie in its directions, none where the plane is seen too flat,
  /// and adds their number and solid angle. Where `aimed` or `counted` is null, that is left out.
  struct ToPlaces {
    std::size_t rays = 0;
    double solid_angle_sr = 0.0;
  };
  void aim_at_places(const Part& part, const Place& head, Aimed* aimed, ToPlaces* counted) const;
  void fill_strata(const Part& part, std::size_t index, Aimed& aimed) const;

  TransmitVolume volume_;
  RaySettings settings_;
  random::Stream stream_;
  std::vector<double> sine_edges_, angle_edges_rad_;  // of the cells, not steered
};

}  // namespace ensonify::trace
