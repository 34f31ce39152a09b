#pragma once

#include <deque>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "messages/soundings.h"
#include "messages/terrain.h"
#include "tools/console/alarms.h"
#include "tools/console/flow.h"
#include "tools/console/logs.h"
#include "tools/console/plan.h"
#include "tools/console/source.h"
#include "tools/console/survey.h"
#include "tools/console/values.h"

namespace ensonify::console {

/// One source and those who watch it. Every topic of type ping/1 (HEAD/ping...) has a topic of pictures beside it
/// (HEAD/view...): the head's own in a live run, else made when it is sent.
class Desk {
 public:
  explicit Desk(std::unique_ptr<Source> source, const AlarmLimits& alarms = {});

  void add(Flow& flow);
  void remove(Flow& flow);
  bool empty() const { return viewers_.empty(); }
  WallTime left() const { return left_; }

  /// After a viewer has changed what it watches, or is back: gives it the states that there are.
  void settle(Flow& flow);
  /// Takes from the source what has come; true when state() has changed.
  bool poll(WallTime now);

  const msg::ConsoleState& state() const { return state_; }
  /// What kCellsTopic and kTrackTopic are made of.
  const Survey& survey() const { return survey_; }
  /// What kValuesTopic is made of.
  const Values& values() const { return values_; }
  const Logs& logs() const { return logs_; }
  void command(const msg::ConsoleCommand& command) { source_->command(command); }

  /// The message as it is sent: pings as view/1, and these as wide as they are wished. Throws NoPicture or
  /// msg::DecodeError for one that gives no picture.
  msg::Packet message_of(const Sending& sending);

 private:
  void take(msg::Packet packet, WallTime now);
  bool makes_view_of(const std::string& topic, const std::string& type) const;
  bool wants_finds(const Flow& flow, const std::string& head) const;
  msg::View picture_of(const Sending& sending, const std::string& type) const;
  msg::View slant_picture_of(const Sending& sending, const std::string& type) const;
  void refresh();
  void ask_source();
  void watch_disk(WallTime now);
  void read_logs(WallTime now);
  void find_chart(WallTime now);
  void take_chart(const msg::Chart& chart, WallTime now);
  void offer_relief(const msg::ConsoleRelief& relief, WallTime now);
  void offer_alarms(WallTime now);
  void make_plan(WallTime now);
  void give(const Offer& offer);
  void offer_newest(const char* topic, Way way, msg::Packet packet, WallTime now);

  std::unique_ptr<Source> source_;
  std::list<Flow*> viewers_;
  WallTime left_;
  msg::ConsoleState state_;
  std::string fault_;                           // of the source, which goes on
  std::map<std::string, std::string> type_of_;  // of the source's topics
  std::map<std::string, Offer> newest_;         // of each topic with a state, for who comes later
  Survey survey_;
  Values values_;
  Plan plan_;
  bool has_plan_ = false;  // the scenario's has been read
  bool plan_is_new_ = false;
  std::uint64_t plan_seq_ = 0;
  std::uint64_t relief_seq_ = 0;
  bool has_map_ = false;
  bool has_relief_ = false;
  WallTime chart_sought_;
  int chart_tries_ = 0;
  Logs logs_;
  WallTime logs_read_;
  Alarms alarms_;
  std::uint64_t alarms_seq_ = 0;
  WallTime alarms_said_;
  WallTime disk_seen_;
  std::map<std::string, std::deque<msg::Soundings>> finds_;  // of the last pings, by head, for pictures made here

  std::map<std::string, double> altitude_m_;  // of heads by their newest bottom track, by topic of its pictures

  struct Made {  // the last pictures, for several viewers of one size
    std::shared_ptr<const msg::Packet> of;
    std::string topic;
    PictureWish wish;
    msg::Packet packet;
  };
  std::list<Made> made_;
};

/// Topics that a desk makes of several: console_cells/1, console_track/1, console_values/1,
/// console_alarms/1, console_log/1, console_relief/1, console_plan/1.
inline constexpr const char* kCellsTopic = "cells";
inline constexpr const char* kTrackTopic = "track";
inline constexpr const char* kValuesTopic = "values";
inline constexpr const char* kAlarmsTopic = "alarms";
inline constexpr const char* kReliefTopic = "relief";
inline constexpr const char* kPlanTopic = "plan";
inline constexpr const char* kLogTopic = "log";

/// Behind the name of a topic of pictures: the same pictures, upright().
inline constexpr std::string_view kUpright = ":upright";

/// "bow/view" of "bow/ping", "side/view_main" of "side/ping_main"; "" for a topic that is none of pings.
std::string view_topic_of(const std::string& ping_topic);

}  // namespace ensonify::console
