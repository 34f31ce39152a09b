#pragma once

#include <string>
#include <vector>

#include "components/runtime/testing/node_under_test.h"
#include "components/sonar/testing/config.h"
#include "messages/motion.h"
#include "messages/navigation.h"
#include "messages/terrain.h"

/// Heads as a launch runs them: configured by YAML, fed and read through their ports.
namespace ensonify::physics {

/// Throws ConfigError when the head's reader refuses the text.
template <class Node>
typename Node::Config config_of(const std::string& yaml, const World& world, const std::string& head) {
  auto from = ConfigReader::from_text(yaml, head + ".yaml");
  typename Node::Config config = Node::Config::read(from, world, head);
  from.finish();
  return config;
}

/// A vehicle on a straight course, its navigation without error.
struct Course {
  frames::Vec3 start_enu_m = frames::Vec3::Zero();
  frames::Vec3 velocity_enu_mps = frames::Vec3::Zero();
  frames::Quaternion enu_from_body = frames::enu_from_ned();
};

template <class Node>
void give_course(NodeUnderTest<Node>& head, const Course& course, SimTime until) {
  for (SimTime t{0}; t <= until; t += 20_ms) {
    msg::Pose pose;
    pose.stamp_ns = t.count();
    const frames::Vec3 place = course.start_enu_m + seconds(t) * course.velocity_enu_mps;
    pose.position_enu_m = {place.x(), place.y(), place.z()};
    pose.enu_from_body = frames::wxyz_of(course.enu_from_body);
    head.give("pose", pose);
    msg::Estimate estimate;
    estimate.stamp_ns = t.count();
    estimate.position_enu_m = pose.position_enu_m;
    estimate.enu_from_body = pose.enu_from_body;
    head.give("estimate", estimate);
  }
}

}  // namespace ensonify::physics
