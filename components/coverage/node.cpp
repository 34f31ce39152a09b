#include "components/coverage/node.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "components/errors/exit_error.h"
#include "components/runtime/log.h"

namespace ensonify {
namespace {

constexpr SimTime kSettle = std::chrono::seconds(2);  // until a line's last pings have been worked through; it also
                                                      // breaks the wiring's cycle through the pilot

survey::Rectangle area_of(const AdaptivePlan& plan) {
  return {plan.centre_enu_m, plan.heading_rad, plan.length_m, plan.width_m};
}

}  // namespace

CoverageNode::CoverageNode(const Config& config, Ports& ports)
    : config_(config),
      ports_(ports),
      events_(Rate{config.rate_hz, 1}),
      area_(area_of(config.plan)),
      swath_{0.5 * config.plan.swath_rad, config.plan.overlap},
      covered_(area_, config.plan.cell_m, config.plan.soundings),
      cubes_(area_, config.cube_step_m),
      across_m_(config.plan.first_line_m),
      coverages_(ports.out<msg::Coverage>(
          "coverage", {.max_bytes = covered_.columns() * covered_.rows() * 6 + 4096, .rate = Rate{config.rate_hz, 1}})),
      next_lines_(ports.out<msg::NextLine>("next_line", {.rate = Rate{config.rate_hz, 1}})) {
  ports.in<msg::Soundings>("soundings", [this](const msg::Soundings& soundings) { take(soundings); });
  ports.in<msg::MissionState>("mission",
                              [this](const msg::MissionState& mission) {
                                if (mission.state == "await_line" && mission.line == lines_) awaited_ = mission.line;
                              },
                              {.delay = kSettle});
}

void CoverageNode::take(const msg::Soundings& soundings) {
  for (std::size_t i = 0; i < soundings.valid.size(); ++i) {
    if (soundings.valid[i] == 0) continue;
    const survey::Vec2 place(soundings.position_enu_m(i, 0), soundings.position_enu_m(i, 1));
    covered_.add(place, soundings.position_enu_m(i, 2));
    cubes_.add(place);
    if (i < soundings.tvu_m.size() && i < soundings.thu_m.size()) {
      const double depth_m = std::max(0.0, -soundings.position_enu_m(i, 2));
      tvu_m_.push_back(soundings.tvu_m[i]);
      thu_m_.push_back(soundings.thu_m[i]);
      in_special_order_ += survey::meets(survey::kSpecialOrder, depth_m, tvu_m_.back(), thu_m_.back());
      in_order_1a_ += survey::meets(survey::kOrder1a, depth_m, tvu_m_.back(), thu_m_.back());
    }
  }
  if (!first_ns_) first_ns_ = soundings.stamp_ns;
  last_ns_ = soundings.stamp_ns;
}

std::optional<double> CoverageNode::next_line() {
  if (!filling_) {
    const auto open = covered_.open_rows(across_m_, -config_.head_depth_m);
    if (!open.empty()) {
      const double next_m = survey::next_line_across_m(open, swath_, area_.width_m);
      if (next_m > across_m_ + 0.5 * config_.plan.cell_m) return next_m;  // else the last line left holes at the edge
    }
    filling_ = true;
  }
  const double least_m = covered_.depths(-config_.head_depth_m).shallowest_m;
  const double across_m = covered_.take_holes(least_m * std::tan(swath_.half_angle_rad));
  if (std::isnan(across_m)) return std::nullopt;
  ++hole_lines_;
  return across_m;
}

void CoverageNode::end_line(SimTime now) {
  awaited_.reset();
  covered_.end_line();
  ++lines_;
  const auto across_m = next_line();
  msg::NextLine next;
  next.stamp_ns = now.count();
  next.number = lines_;
  next.done = !across_m;
  if (across_m) {
    across_m_ = *across_m;
    const survey::Runline line = survey::line_across(area_, across_m_, lines_ % 2 == 1);
    next.start_enu_m = {line.start_enu_m.x(), line.start_enu_m.y()};
    next.end_enu_m = {line.end_enu_m.x(), line.end_enu_m.y()};
  }
  next_lines_.send(next);
  log::event(ports_, "line_done", "lines={} covered={:.4f} next_across_m={:.1f}", lines_, covered_.covered(),
             across_m.value_or(-1.0));
}

SimTime CoverageNode::step(SimTime now) {
  if (!events_.due(now)) return events_.next();
  coverages_.send(coverage(now));
  if (awaited_) end_line(now);
  return events_.next();
}

msg::Coverage CoverageNode::coverage(SimTime now) const {
  msg::Coverage message;
  message.stamp_ns = now.count();
  message.lines = lines_;
  message.corner_enu_m = {covered_.corner_enu_m().x(), covered_.corner_enu_m().y()};
  message.heading_grid_rad = area_.heading_rad;
  message.cell_m = config_.plan.cell_m;
  message.needed = config_.plan.soundings;
  message.covered = covered_.covered();
  message.overlapped = covered_.overlapped();
  message.track_m = static_cast<double>(lines_) * area_.length_m;
  if (first_ns_) message.elapsed_s = seconds(SimTime{*last_ns_ - *first_ns_});
  message.soundings = msg::Array<std::uint16_t>({covered_.columns(), covered_.rows()});
  message.height_m = msg::Array<float>({covered_.columns(), covered_.rows()});
  for (std::size_t column = 0; column < covered_.columns(); ++column) {
    for (std::size_t row = 0; row < covered_.rows(); ++row) {
      message.soundings(column, row) =
          static_cast<std::uint16_t>(std::min<std::uint32_t>(covered_.soundings(column, row), 65535));
      message.height_m(column, row) = static_cast<float>(covered_.height_m(column, row));
    }
  }
  return message;
}

/// So many lines at one distance over the whole width.
std::vector<survey::Runline> CoverageNode::lines_at(std::size_t count) const {
  std::vector<survey::Runline> lines;
  for (std::size_t i = 0; i < count; ++i) {
    const double across_m = area_.width_m * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    lines.push_back(survey::line_across(area_, across_m, i % 2 == 1));
  }
  return lines;
}

/// Sides of the smallest cubes that hold the soundings needed, everywhere and in 95 % of all places; null: none does.
nlohmann::ordered_json CoverageNode::cube_report() const {
  nlohmann::ordered_json report;
  report["soundings"] = config_.plan.soundings;
  report["everywhere"] = cubes_.smallest_side_m(config_.plan.soundings, 1.0);
  report["in_95_percent"] = cubes_.smallest_side_m(config_.plan.soundings, 0.95);
  for (const double side_m : {1.0, 2.0}) {  // what S-44 asks to be found: Special Order; Order 1a down to 40 m
    report[side_m == 1.0 ? "share_found_of_1_m" : "share_found_of_2_m"] = cubes_.found(side_m, config_.plan.soundings);
  }
  return report;
}

/// What 95 % of the soundings are less uncertain than, as the head predicts them, and the shares that S-44 would take.
nlohmann::ordered_json CoverageNode::uncertainty_report() const {
  nlohmann::ordered_json report;
  if (tvu_m_.empty()) return report;
  const auto within_95 = [](std::vector<float> values) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 95 / 100);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  const auto share = [&](std::size_t count) { return static_cast<double>(count) / static_cast<double>(tvu_m_.size()); };
  report["soundings"] = tvu_m_.size();
  report["tvu_95_m"] = within_95(tvu_m_);
  report["thu_95_m"] = within_95(thu_m_);
  report["share_in_special_order"] = share(in_special_order_);
  report["share_in_order_1a"] = share(in_order_1a_);
  return report;
}

/// Whether the survey holds what an order asks for, and each part of it: soundings certain enough, every cell covered,
/// every cube found that the order asks for at its depth. A survey whose soundings give no uncertainty does not.
nlohmann::ordered_json CoverageNode::order_report(const survey::SurveyOrder& order, std::size_t certain,
                                                  double shallowest_m) const {
  const auto cube_m = [&](double across_m, double along_m) {
    const auto cell = [this](double m, std::size_t cells) {
      return std::min(static_cast<std::size_t>(m / config_.plan.cell_m), cells - 1);
    };
    const double height_m = covered_.height_m(cell(across_m, covered_.columns()), cell(along_m, covered_.rows()));
    return survey::cube_m(order, std::isnan(height_m) ? 0.0 : std::max(0.0, -height_m));
  };
  const bool uncertainty = !tvu_m_.empty() && static_cast<double>(certain) >= 0.95 * static_cast<double>(tvu_m_.size());
  const bool coverage = covered_.covered() >= 1.0;
  const double found = cubes_.found(cube_m, config_.plan.soundings);
  nlohmann::ordered_json report;
  report["uncertainty"] = uncertainty;
  report["coverage"] = coverage;
  report["feature_search"] = found >= 1.0;
  report["cube_m"] = survey::cube_m(order, std::max(0.0, shallowest_m));
  report["share_found"] = found;
  report["holds"] = uncertainty && coverage && found >= 1.0;
  return report;
}

void CoverageNode::finish_run() const {
  const auto depths = covered_.depths(-config_.head_depth_m);
  const double fixed_m = (2.0 - swath_.overlap) * depths.shallowest_m * std::tan(swath_.half_angle_rad);
  const auto fixed_lines = static_cast<std::size_t>(fixed_m > 0.0 ? std::ceil(area_.width_m / fixed_m) : 0.0);
  const double elapsed_s = first_ns_ ? seconds(SimTime{*last_ns_ - *first_ns_}) : 0.0;
  nlohmann::ordered_json report;
  report["lines"] = lines_;
  report["lines_for_holes"] = hole_lines_;
  report["track_m"] = static_cast<double>(lines_) * area_.length_m;
  report["covered"] = covered_.covered();
  report["holes"] = covered_.holes();
  report["overlapped"] = covered_.overlapped();
  report["elapsed_s"] = elapsed_s;
  report["cost"] = config_.cost_per_day * elapsed_s / 86400.0;
  report["uncertainty"] = uncertainty_report();
  report["cube_m"] = cube_report();
  report["special_order"] = order_report(survey::kSpecialOrder, in_special_order_, depths.shallowest_m);
  report["order_1a"] = order_report(survey::kOrder1a, in_order_1a_, depths.shallowest_m);
  report["shallowest_m"] = depths.shallowest_m;
  report["deepest_m"] = depths.deepest_m;
  report["fixed_lines"] = fixed_lines;
  if (fixed_lines > 0) {
    const survey::RunCost fixed = survey::run_cost(lines_at(fixed_lines), config_.run);
    report["fixed_track_m"] = fixed.line_m;
    report["fixed_elapsed_s"] = fixed.total_s;
    report["fixed_cost"] = fixed.cost;
    report["share_of_fixed"] = static_cast<double>(lines_) / static_cast<double>(fixed_lines);
    report["bound"] = survey::adaptive_share(depths.shallowest_m, depths.deepest_m);
  }
  const auto file = ports_.out_dir() / "coverage.json";
  std::ofstream stream(file);
  stream << report.dump(2) << '\n';
  if (!stream) throw UserError(file.string() + ": cannot be written");
}

}  // namespace ensonify
