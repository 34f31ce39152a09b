#include "kernels/survey/boresight/adjust.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kernels/survey/boresight/drift.h"
#include "kernels/survey/boresight/plane.h"

namespace ensonify::boresight {
namespace {

constexpr double kLoose = 10.0;         // s, rad: a prior that decides nothing that can be observed
constexpr double kTypical = 20.0;       // soundings that the typical cell counts for in the variance of each
constexpr double kLeastSigmaM = 0.003;  // of a plane fit: few soundings can lie on it by luck
constexpr double kStatedRightTo = 0.1;  // relative uncertainty of the deviations that navigation states

/// A laying of the squares over the soundings: where a corner of them lies, and the state to start from.
struct Laying {
  frames::Vec2 corner_m = frames::Vec2::Zero();
  Vector state;      // empty: zero
  int choosing = 8;  // rounds in which soundings may still change their cells; convergence is Newton's afterwards
};

class Adjustment {
 public:
  Adjustment(const std::vector<Line>& lines, const AdjustSettings& settings, const Laying& laying)
      : lines_(lines), settings_(settings), laying_(laying), drift_(lines, settings), state_(laying.state) {
    if (state_.size() == 0) state_ = Vector::Zero(drift_.size());
    prior_ = priors();
  }

  Adjusted run() {
    Adjusted result;
    double share = 1.0;
    Vector last = Vector::Zero(state_.size());
    for (result.rounds = 1; result.rounds <= settings_.most_rounds; ++result.rounds) {
      const bool choosing = result.rounds <= laying_.choosing;
      gather(choosing);
      if (result.rounds == 1) result.rms_before_m = rms();
      const Vector step = normal_.llt().solve(-gradient_ - prior_ * state_);
      // With slopes that are reduced (Plane::across) a step may be twice too long, and goes to and fro for ever.
      if (!choosing && step.dot(normal_ * last) < -0.5 * last.dot(normal_ * last)) share *= 0.5;
      state_ += share * step;
      last = step;
      if (step.head<kUnknowns>().cwiseAbs().maxCoeff() < 1e-6) {  // 1 us, 0.2 seconds of arc
        result.converged = true;
        break;
      }
    }
    gather(false);
    result.rms_after_m = rms();
    result.cells = chosen_.size();
    result.soundings = used_;
    return result;
  }

  const Vector& state() const { return state_; }
  Found found() const { return {state_.head<kUnknowns>(), spread()}; }

 private:
  /// The inverse covariance of all unknowns before anything was received. What is not solved for gets a very large one.
  Matrix priors() const {
    constexpr double kFixed = 1e24;
    Matrix prior = drift_.inverse_covariance();
    for (std::size_t k = 0; k < kUnknowns; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      prior(i, i) = settings_.solve[k] ? 1.0 / (kLoose * kLoose) : kFixed;
    }
    return prior;
  }

  /// The offsets there and then: the installation's, and what the attitude is off.
  Offsets offsets_at(const Drift::Columns& columns) const {
    Offsets offsets = offsets_of(state_.head<kUnknowns>());
    offsets.roll_rad += state_[columns[3]];
    offsets.pitch_rad += state_[columns[4]];
    offsets.yaw_rad += state_[columns[5]];
    return offsets;
  }

  const Sounding& sounding(const SoundingRef& ref) const { return lines_[ref.line].soundings[ref.index]; }
  Drift::Columns columns_of(const SoundingRef& ref) const { return drift_.columns(ref.line, sounding(ref).time_s); }

  Places placed() const {
    Places places(lines_.size());
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      for (const Sounding& s : lines_[line].soundings) {
        const Drift::Columns c = drift_.columns(line, s.time_s);
        places[line].push_back(place(s, offsets_at(c)).place_enu_m + Vec3(state_[c[0]], state_[c[1]], state_[c[2]]));
      }
    }
    return places;
  }

  /// What is compared at these places: soundings by cell, without those far from the cell's plane.
  void choose(const Places& places) {
    const Cells cells(places, settings_.cell_m, settings_.least, laying_.corner_m);
    chosen_.clear();
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const Members all(cells[n].members.begin(), cells[n].members.end());
      const Plane rough(all, places);
      Members kept;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const double off_m = std::abs(rough.residual_m()[static_cast<Eigen::Index>(i)]);
        if (off_m <= settings_.gate_sds * rough.sigma_m()) kept.push_back(all[i]);
      }
      if (kept.size() > 3 && kept.front().line != kept.back().line) chosen_.push_back(std::move(kept));
    }
    if (chosen_.empty()) {
      throw std::invalid_argument("no square of " + std::to_string(settings_.cell_m) + " m holds at least " +
                                  std::to_string(settings_.least) + " soundings of two lines: do the lines overlap?");
    }
  }

  /// Normal equations and residuals at the present state.
  void gather(bool anew) {
    const Places places = placed();
    if (anew) choose(places);
    planes_.clear();
    std::vector<double> variances;
    for (const Members& members : chosen_) {
      planes_.emplace_back(members, places);
      variances.push_back(planes_.back().sigma_m() * planes_.back().sigma_m());
    }
    const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
    std::nth_element(variances.begin(), middle, variances.end());
    typical_m2_ = std::max(*middle, kLeastSigmaM * kLeastSigmaM);
    normal_ = information_ = prior_;
    gradient_ = Vector::Zero(state_.size());
    squares_ = 0.0;
    used_ = 0;
    for (std::size_t n = 0; n < planes_.size(); ++n) accumulate(n);
  }

  /// The unknowns that matter in a cell, rising.
  std::vector<Eigen::Index> unknowns_of_cell(const Members& members) const {
    std::vector<Eigen::Index> where;
    for (std::size_t k = 0; k < kUnknowns; ++k) where.push_back(static_cast<Eigen::Index>(k));
    for (const SoundingRef& ref : members) {
      const Drift::Columns columns = columns_of(ref);
      where.insert(where.end(), columns.begin(), columns.end());
    }
    std::sort(where.begin(), where.end());
    where.erase(std::unique(where.begin(), where.end()), where.end());
    return where;
  }

  /// One row per sounding: how its height over the plane changes with the unknowns `where`, and last the residual.
  Matrix changes(const Members& members, const Plane& plane, const std::vector<Eigen::Index>& where) const {
    Matrix rows = Matrix::Zero(static_cast<Eigen::Index>(members.size()), static_cast<Eigen::Index>(where.size() + 1));
    const Eigen::RowVector3d across = plane.across();
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const SoundingRef& ref = members[static_cast<std::size_t>(i)];
      const Drift::Columns columns = columns_of(ref);
      const Eigen::Matrix<double, 1, kUnknowns> rates = across * place(sounding(ref), offsets_at(columns)).rates;
      rows.block<1, kUnknowns>(i, 0) = rates;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto at = std::lower_bound(where.begin(), where.end(), columns[k]) - where.begin();
        rows(i, at) = k < 3 ? across[static_cast<Eigen::Index>(k)] : rates[static_cast<Eigen::Index>(k - 1)];
      }
    }
    rows.rightCols<1>() = plane.residual_m();
    return rows;
  }

  /// Cells weigh by their scatter, as of Student's t with kTypical degrees of freedom.
  double freedom(std::size_t cell) const { return static_cast<double>(chosen_[cell].size()) - 3.0; }
  double weight(std::size_t cell) const {
    return (kTypical + freedom(cell)) / (kTypical * typical_m2_ + planes_[cell].residual_m().squaredNorm());
  }

  void accumulate(std::size_t cell) {
    const std::vector<Eigen::Index> where = unknowns_of_cell(chosen_[cell]);
    Matrix rows = changes(chosen_[cell], planes_[cell], where);
    planes_[cell].project_out(rows);
    squares_ += planes_[cell].residual_m().squaredNorm();
    used_ += chosen_[cell].size();
    const Matrix products = weight(cell) * rows.transpose() * rows;
    // A weight that is made of what it weighs has less information [LangeLittleTaylor1989].
    const double free = freedom(cell), information_share = (kTypical + free) / (kTypical + free + 2.0);
    const Eigen::Index last = rows.cols() - 1;
    for (Eigen::Index a = 0; a < last; ++a) {
      const Eigen::Index to = where[static_cast<std::size_t>(a)];
      gradient_[to] += products(a, last);
      for (Eigen::Index b = 0; b < last; ++b) {
        normal_(to, where[static_cast<std::size_t>(b)]) += products(a, b);
        information_(to, where[static_cast<std::size_t>(b)]) += information_share * products(a, b);
      }
    }
  }

  double rms() const { return used_ > 0 ? std::sqrt(squares_ / static_cast<double>(used_)) : 0.0; }

  /// What happens to the unknowns in a stretch of time.
  struct Stretch {
    Unknowns soundings = Unknowns::Zero();       // their errors move them so far
    Drift::Pulls wander = Drift::Pulls::Zero();  // and those of navigation, per error
  };

  std::size_t stretch_of(const SoundingRef& ref) const {
    const double since_s = sounding(ref).time_s - lines_[ref.line].soundings.front().time_s;
    return static_cast<std::size_t>(since_s / settings_.together_s);
  }

  /// Adds a cell to the stretches of its lines. A sounding's error is what it would be off a plane that is laid without
  /// it and its like: noisy soundings at a cell's edge pull their plane after them.
  void add_to_stretches(std::size_t cell, const Matrix& inverse, std::vector<std::vector<Stretch>>& by_line) const {
    const Members& members = chosen_[cell];
    const std::vector<Eigen::Index> where = unknowns_of_cell(members);
    Matrix rows = changes(members, planes_[cell], where);
    const Matrix raw = rows;
    planes_[cell].project_out(rows);
    const Matrix moves = weight(cell) * rows.leftCols(rows.cols() - 1) * inverse(where, Eigen::all);
    for (std::size_t from = 0, to = 0; from < members.size(); from = to) {
      const std::uint32_t line = members[from].line;
      const std::size_t n = stretch_of(members[from]);
      while (to < members.size() && members[to].line == line && stretch_of(members[to]) == n) ++to;
      if (n >= by_line[line].size()) by_line[line].resize(n + 1);
      Stretch& stretch = by_line[line][n];
      const auto first = static_cast<Eigen::Index>(from), count = static_cast<Eigen::Index>(to - from);
      stretch.soundings += moves.middleRows(first, count).transpose() * planes_[cell].without_it(first, count);
      for (Eigen::Index i = first; i < first + count; ++i) {
        const Drift::Columns columns = columns_of(members[static_cast<std::size_t>(i)]);
        for (std::size_t k = 0; k < columns.size(); ++k) {
          const auto at = std::lower_bound(where.begin(), where.end(), columns[k]) - where.begin();
          stretch.wander.col(static_cast<Eigen::Index>(k)) += raw(i, at) * moves.row(i).transpose();
        }
      }
    }
  }

  /// How far the unknowns move with the errors of the soundings of each stretch of time (of unequal quality
  /// [White1980], that err together [LiangZeger1986], given by what is left without them [MacKinnonWhite1985,
  /// BellMcCaffrey2002]), and with the navigation's wander.
  Spread spread() const {
    const Matrix inverse =
        information_.llt().solve(Matrix::Identity(information_.rows(), static_cast<Eigen::Index>(kUnknowns)));
    std::vector<std::vector<Stretch>> by_line(lines_.size());
    for (std::size_t n = 0; n < chosen_.size(); ++n) add_to_stretches(n, inverse, by_line);
    std::vector<std::vector<Drift::Pulls>> pulls(lines_.size());
    Spread spread;
    Unknowns fourth = Unknowns::Zero();
    for (std::size_t line = 0; line < by_line.size(); ++line) {
      for (const Stretch& stretch : by_line[line]) {
        spread.variance += stretch.soundings.cwiseAbs2();
        fourth += stretch.soundings.cwiseAbs2().cwiseAbs2();
        pulls[line].push_back(stretch.wander);
      }
    }
    const Drift::Pulls wander = drift_.variances(pulls, settings_.together_s);
    spread.variance += wander.rowwise().sum();
    // Each stretch gives its variance with one degree of freedom: the fourth power of a normal pull is thrice the
    // square of its variance. What navigation states of an axis, with those of a deviation that is right to a share.
    const double stated = 0.5 / (kStatedRightTo * kStatedRightTo);  // [GUM2008, eq. G.3]
    const Unknowns unsure = fourth / 3.0 + wander.cwiseAbs2().rowwise().sum() / stated;
    spread.freedom = spread.variance.cwiseAbs2().cwiseQuotient(unsure);
    // What is left of soundings that an unknown follows is too small: never less than what is expected if soundings
    // erred on their own, all of a cell alike.
    spread.variance = spread.variance.cwiseMax(inverse.topRows<static_cast<int>(kUnknowns)>().diagonal());
    spread.variance[2] += settings_.angle_sd_rad * settings_.angle_sd_rad;
    return spread;
  }

  const std::vector<Line>& lines_;
  const AdjustSettings& settings_;
  const Laying& laying_;
  const Drift drift_;
  Vector state_, gradient_;
  Matrix prior_, normal_;
  Matrix information_;           // what the soundings indicates the unknowns, and the prior
  std::vector<Members> chosen_;  // by cell
  std::vector<Plane> planes_;    // likewise
  double typical_m2_ = 1.0;      // variance about a cell's plane
  double squares_ = 0.0;
  std::size_t used_ = 0;
};

void check(const std::vector<Line>& lines, const AdjustSettings& settings) {
  if (lines.size() < 2) throw std::invalid_argument("a patch test compares at least two lines");
  if (!(settings.cell_m > 0.0) || !(settings.piece_s > 0.0) || !(settings.height_piece_s > 0.0) ||
      !(settings.wander_s > 0.0) || !(settings.turn_wander_s > 0.0) || !(settings.together_s > 0.0) ||
      !(settings.gate_sds > 0.0) || !(settings.angle_sd_rad >= 0.0) || settings.layings < 1 || settings.least < 3 ||
      settings.most_rounds < 1) {
    throw std::invalid_argument(
        "cell, layings, pieces, wanders, stretches and gate are positive, a cell takes at least 3 soundings of a line");
  }
  for (const Line& line : lines) {
    for (const Sounding& s : line.soundings) {
      if (!s.place_enu_m.allFinite() || !s.head_enu_m.allFinite() || !std::isfinite(s.time_s)) {
        throw std::invalid_argument("a sounding has a place that is not finite");
      }
    }
  }
}

double student_95(double freedom) {
  constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
  const double f = std::max(freedom, 3.0);
  return z + (z3 + z) / (4 * f) + (5 * z5 + 16 * z3 + 3 * z) / (96 * f * f) +
         (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * f * f * f);
}

Quaternion turned_by(const Vec3& angle_rad) {
  const double angle = angle_rad.norm();
  if (angle == 0.0) return Quaternion::Identity();
  return Quaternion(Eigen::AngleAxisd(angle, angle_rad / angle));
}

}  // namespace

Offsets offsets_of(const Unknowns& u) { return {u[0], u[1], u[2], u[3], u[4]}; }

Unknowns unknowns_of(const Offsets& o) {
  return (Unknowns() << o.position_latency_s, o.attitude_latency_s, o.roll_rad, o.pitch_rad, o.yaw_rad).finished();
}

Adjusted adjust(const std::vector<Line>& lines, const AdjustSettings& settings) {
  check(lines, settings);
  const auto each_way = static_cast<std::size_t>(settings.layings);
  const std::size_t count = each_way * each_way;
  const Laying first;
  Adjustment adjustment(lines, settings, first);
  Adjusted result = adjustment.run();
  std::vector<Found> found(count, adjustment.found());
  std::vector<char> converged(count, result.converged ? 1 : 0);
  tbb::parallel_for(std::size_t{1}, count, [&](std::size_t n) {
    const std::size_t east = n % each_way, north = n / each_way;
    const frames::Vec2 steps(static_cast<double>(east), static_cast<double>(north));
    const Laying laying{
        .corner_m = settings.cell_m / settings.layings * steps, .state = adjustment.state(), .choosing = 2};
    Adjustment shifted(lines, settings, laying);
    converged[n] = shifted.run().converged ? 1 : 0;
    found[n] = shifted.found();
  });
  const Found mean = mean_of(found);
  result.offsets = offsets_of(mean.unknowns);
  result.converged = std::count(converged.begin(), converged.end(), 0) == 0;
  const Unknowns half = half_95(mean.spread);
  for (std::size_t k = 0; k < kUnknowns; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (!settings.solve[k]) continue;
    result.sd[i] = std::sqrt(mean.spread.variance[i]);
    result.half_95[i] = half[i];
  }
  return result;
}

Found mean_of(const std::vector<Found>& layings) {
  const auto m = static_cast<double>(layings.size());
  if (layings.size() == 1) return layings[0];
  Found mean;
  Unknowns within = Unknowns::Zero(), unsure = Unknowns::Zero(), between = Unknowns::Zero();
  for (const Found& laying : layings) {
    mean.unknowns += laying.unknowns / m;
    within += laying.spread.variance / m;
    unsure += laying.spread.variance.cwiseAbs2().cwiseQuotient(laying.spread.freedom) / m;
  }
  for (const Found& laying : layings) between += (laying.unknowns - mean.unknowns).cwiseAbs2() / (m - 1.0);
  between *= 1.0 + 1.0 / m;
  unsure += between.cwiseAbs2() / (m - 1.0);
  mean.spread.variance = within + between;
  mean.spread.freedom = mean.spread.variance.cwiseAbs2().cwiseQuotient(unsure);
  return mean;
}

Unknowns half_95(const Spread& spread) {
  return spread.variance.cwiseSqrt().cwiseProduct(spread.freedom.unaryExpr(&student_95));
}

Placed place(const Sounding& sounding, const Offsets& offsets) {
  const Quaternion yaw(Eigen::AngleAxisd(offsets.yaw_rad, Vec3::UnitZ()));
  const Quaternion yaw_pitch = yaw * Quaternion(Eigen::AngleAxisd(offsets.pitch_rad, Vec3::UnitY()));
  const Quaternion mounting = yaw_pitch * Quaternion(Eigen::AngleAxisd(offsets.roll_rad, Vec3::UnitX()));
  const Quaternion since = turned_by(sounding.rate_enu_radps * offsets.attitude_latency_s);
  const Quaternion enu_from_body = since * sounding.enu_from_body;

  const Vec3 measured_body = sounding.enu_from_body.conjugate() * (sounding.place_enu_m - sounding.head_enu_m);
  const Vec3 away_body = mounting * measured_body;
  const Vec3 away_enu = enu_from_body * away_body;
  const Vec3 heave(0.0, 0.0, sounding.velocity_enu_mps.z()), course = sounding.velocity_enu_mps - heave;

  Placed placed;
  placed.place_enu_m =
      sounding.head_enu_m + course * offsets.position_latency_s + heave * offsets.attitude_latency_s + away_enu;
  placed.rates << course, heave + sounding.rate_enu_radps.cross(away_enu),
      enu_from_body * (yaw_pitch * Vec3::UnitX()).cross(away_body),
      enu_from_body * (yaw * Vec3::UnitY()).cross(away_body), enu_from_body * Vec3::UnitZ().cross(away_body);
  return placed;
}

}  // namespace ensonify::boresight
