#pragma once

#include <array>
#include <string>
#include <vector>

namespace ensonify::msg {

/// One of the transmissions of a head's channel.
struct SectorDeclaration {
  double frequency_hz = 0.0;
  double delay_s = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("frequency_hz", "Hz", "centre frequency", self.frequency_hz);
    visit("delay_s", "s", "start after the ping's time of transmission", self.delay_s);
  }
};

/// Limits of one setting of a head.
struct SettingDeclaration {
  std::string setting;
  double least = 0.0;
  double most = 0.0;
  bool chosen = false;
  std::vector<std::string> words;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("setting", "", "field of sonar_settings/1", self.setting);
    visit("least", "unit of that field", "least value of a number; equal to the most: it is fixed", self.least);
    visit("most", "unit of that field", "greatest value of a number", self.most);
    visit("chosen", "1", "true where 0 lets the head choose", self.chosen);
    visit("words", "", "values of a text; empty for a number", self.words);
  }
};

/// A channel of a head: its transmissions and what a command may set.
struct ChannelDeclaration {
  std::string name;
  std::vector<SectorDeclaration> sectors;
  std::vector<SettingDeclaration> settings;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("name", "", "end of its ports' names; empty: the only channel", self.name);
    visit("sectors", "", "transmissions of a ping", self.sectors);
    visit("settings", "", "limits of what a command may set; what is not listed cannot be set", self.settings);
  }
};

struct HeadDeclaration {
  static constexpr const char* kType = "head_declaration/1";
  static constexpr const char* kAbout =
      "What a sonar head declares before the run. It is part of `hello` and of a record, and no topic.";
  std::string kind;
  std::string instrument;
  std::string beam_axis = "down";
  double finest_beam_rad = 0.0;
  double near_field_m = 0.0;
  double reach_m = 0.0;
  bool auto_range = false;
  std::array<double, 3> position_body_m{};
  std::array<double, 4> body_from_head{1.0, 0.0, 0.0, 0.0};
  std::vector<ChannelDeclaration> channels;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("kind", "", "kind of head, as in ping/1", self.kind);
    visit("instrument", "", "class of instruments that the head stands for, such as em2040; empty: none in particular",
          self.instrument);
    visit("beam_axis", "", "axis of the head from which beam angles count, positive to starboard: down or forward",
          self.beam_axis);
    visit("finest_beam_rad", "rad", "half-power width of the finest beam", self.finest_beam_rad);
    visit("near_field_m", "m", "range within which the unfocused receive array is in its near field; 0: not stated",
          self.near_field_m);
    visit("reach_m", "m", "distance from the vehicle's origin to which the longest range reaches; 0: it has no range",
          self.reach_m);
    visit("auto_range", "1", "true where the range follows the depth in every channel", self.auto_range);
    visit("position_body_m", "m", "transducer, as measured: forward, starboard, down", self.position_body_m);
    visit("body_from_head", "1", "rotation, as measured: quaternion w, x, y, z", self.body_from_head);
    visit("channels", "", "channels that ping together", self.channels);
  }
};

struct PagerDeclaration {
  static constexpr const char* kType = "pager_declaration/1";
  static constexpr const char* kAbout =
      "What the terrain pager declares before the run. It is part of `hello` and of a record, and no topic.";
  double post_spacing_m = 0.0;
  double shallowest_m = 0.0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("post_spacing_m", "m", "distance between posts", self.post_spacing_m);
    visit("shallowest_m", "m", "least depth below chart datum, positive down", self.shallowest_m);
  }
};

}  // namespace ensonify::msg
