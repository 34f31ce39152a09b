#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/array.h"

namespace ensonify::msg {

/// An object that could be in a ping's image.
struct LabelledObject {
  std::int64_t instance = 0;
  std::string name;
  std::string class_name;
  std::int64_t class_id = 0;
  double inside = 0.0;
  double visible = 0.0;
  double occluded = 0.0;
  double buried = 0.0;
  std::array<double, 3> hit_enu_m{};
  double range_m = 0.0;
  double grazing_rad = 0.0;
  double aspect_rad = 0.0;
  std::int64_t sediment = 0;
  bool smooth = false;
  std::array<std::int64_t, 4> box{};
  std::array<std::int64_t, 4> shadow_box{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("instance", "1", "number in the world, from 1, of all pings and heads", self.instance);
    visit("name", "", "name in the scenario", self.name);
    visit("class_name", "", "class", self.class_name);
    visit("class_id", "1", "number of the class, from 1", self.class_id);
    visit("inside", "1", "part of the silhouette's solid angle, 0..1, that is within the image", self.inside);
    visit("visible", "1", "part of that, 0..1, that nothing hides", self.visible);
    visit("occluded", "1", "rest of it, which the seabed or another object hides", self.occluded);
    visit("buried", "1", "part of the volume that lies below the seabed", self.buried);
    visit("hit_enu_m", "m", "middle of the visible surface, world position", self.hit_enu_m);
    visit("range_m", "m", "distance from the head at transmission to that middle", self.range_m);
    visit("grazing_rad", "rad", "grazing angle, mean over the visible surface", self.grazing_rad);
    visit("aspect_rad", "rad", "bearing of the head from the object, clockwise from its own north", self.aspect_rad);
    visit("sediment", "1", "sediment class by whose law it scatters", self.sediment);
    visit("smooth", "", "smoothness: its echo follows from its shape", self.smooth);
    visit("box", "1", "box round its mask: first beam, first sample, beam and sample after the last; all 0: no mask",
          self.box);
    visit("shadow_box", "1", "box round its shadow, of the same form; all 0: no shadow", self.shadow_box);
  }
};

struct Labels {
  static constexpr const char* kType = "labels/1";
  static constexpr const char* kAbout =
      "What is where in the image of a ping: masks and shadows of objects. Truth. Sample k stands for times of half a "
      "sample period about its own.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  std::int64_t beams = 0;
  std::int64_t samples = 0;
  std::vector<LabelledObject> objects;
  Array<std::int32_t> mask_run;
  Array<std::int32_t> layer_run;
  Array<std::int32_t> shadow_run;
  Array<std::uint8_t> shadow_db;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time, as of the ping", self.stamp_ns);
    visit("ping", "1", "ping number of this head, as of the ping", self.ping);
    visit("beams", "1", "rows of the image", self.beams);
    visit("samples", "1", "columns of the image", self.samples);
    visit("objects", "", "objects within the range and the head's view, by instance", self.objects);
    visit("mask_run", "1",
          "runs (run x 4) of the objects' own masks, which may overlap: place in objects, beam, first sample, sample "
          "after the last",
          self.mask_run);
    visit("layer_run", "1", "runs (run x 4) of one mask of all: where several overlap, the one that sends most",
          self.layer_run);
    visit("shadow_run", "1",
          "runs (run x 4) of shadows: place in objects of what casts it, -1: the seabed itself; beam, first sample, "
          "sample after the last",
          self.shadow_run);
    visit("shadow_db", "dB",
          "depth of the shadow at each sample of the runs, one after the other: what the seabed would send there "
          "without objects over what it sends, at most 60; 0 of the seabed's own",
          self.shadow_db);
  }
};

/// Source of sound in a ping.
struct EnergySource {
  std::string kind;
  std::string path;
  std::int64_t instance = 0;
  std::string name;
  std::string class_name;
  std::int64_t class_id = 0;
  std::int64_t sediment = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(
        "kind", "",
        "kind of source: noise, volume (the water), interference (other heads and sectors), surface, seabed or object",
        self.kind);
    visit("path", "", "way of the sound: direct, surface (out or back by way of it) or bottom (by way of both)",
          self.path);
    visit("instance", "1", "number of the object in the world, from 1; 0: none", self.instance);
    visit("name", "", "name of the object in the scenario", self.name);
    visit("class_name", "", "class of the object", self.class_name);
    visit("class_id", "1", "number of the object's class, from 1; 0: no object", self.class_id);
    visit("sediment", "1", "sediment class, of the seabed or of what the object scatters as", self.sediment);
  }
};

struct Energies {
  static constexpr const char* kType = "energies/1";
  static constexpr const char* kAbout =
      "Who sends how much of each sample of a ping, expected over all draws of speckle and noise. Truth.";
  std::int64_t stamp_ns = 0;
  std::int64_t ping = 0;
  std::int64_t beams = 0;
  std::int64_t samples = 0;
  double first_sample_s = 0.0;
  double sample_period_s = 0.0;
  std::vector<EnergySource> sources;
  Array<std::int32_t> run;
  Array<float> energy_upa2;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stamp_ns", "ns", "time of transmission, sim time, as of the ping", self.stamp_ns);
    visit("ping", "1", "ping number of this head, as of the ping", self.ping);
    visit("beams", "1", "rows of the image", self.beams);
    visit("samples", "1", "columns of the image", self.samples);
    visit("first_sample_s", "s", "time of the first sample after transmission, as of the ping", self.first_sample_s);
    visit("sample_period_s", "s", "time between samples", self.sample_period_s);
    visit("sources", "", "sources of sound; the first is noise, and of equals the earlier counts as the stronger",
          self.sources);
    visit("run", "1",
          "runs (run x 4) of what sources send: place in sources, beam, first sample, sample after the last. What is "
          "less than a millionth of a sample is left out",
          self.run);
    visit("energy_upa2", "uPa^2", "mean square at each sample of the runs, one after the other", self.energy_upa2);
  }
};

}  // namespace ensonify::msg
