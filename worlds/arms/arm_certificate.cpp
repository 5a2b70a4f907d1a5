// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_certificate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/whole.hpp"
#include "worlds/arms/arm_lanes.hpp"

namespace warren::detail {
namespace {

/// A frame at eight (four) moments of a motion: columns, origin; the velocity of a point p is spin x p + moment.
template <class T>
struct ArmFrameLanes {
  Lanes3<T> x, y, z, at, spin, moment;
};

template <class T>
struct ArmBallLanes {
  Lanes3<T> at, velocity;
};

/// Pieces middle - half .. middle + half, a lane each, of the motion's parameter in [0, 1]; items that are open there.
template <class T>
struct ArmBlock {
  std::array<T, lane_count<T>> middle;
  T half;
  std::size_t first_item;
  std::size_t end_item;
};

/// Two solids, or a solid and an obstacle, of which balls and boxes don't say enough.
struct ArmUnsure {
  std::uint32_t item;
  std::uint32_t solid;
  std::uint32_t other;
  unsigned lanes;
};

/// Kept for the next motion; what it holds then changes no verdict.
template <class T>
struct ArmScratch {
  std::array<ArmFrameLanes<T>, most_frames + 1> frames{};  // the first one is the base's
  std::vector<ArmBallLanes<T>> hulls;
  std::vector<ArmBallLanes<T>> balls;
  std::vector<std::uint64_t> hull_stamps;  // of the block that they are of
  std::vector<std::uint64_t> ball_stamps;
  std::vector<T> bends;  // of links, then of pairs
  std::vector<std::uint32_t> near;
  std::vector<std::uint32_t> items;
  std::vector<ArmUnsure> unsure;
  std::vector<ArmBlock<T>> blocks;
  std::vector<std::uint32_t> order;          // items, those that stopped motions last before the others
  std::array<std::size_t, 3> order_sizes{};  // that it is for: lanes of links, links that move, pairs
  std::uint64_t stamp = 0;

  ArmScratch() {
    frames[0].x.x += T(1);
    frames[0].y.y += T(1);
    frames[0].z.z += T(1);
  }
  void fit(const ArmSetup& setup) {
    const auto grow = [](auto& some, std::size_t needed) { some.resize(std::max(some.size(), needed)); };
    grow(hulls, setup.links.size());
    grow(hull_stamps, setup.links.size());
    grow(ball_stamps, setup.links.size());
    grow(balls, setup.solid_of_ball.size());
    grow(bends, setup.link_lanes + setup.pair_lanes);
    grow(near, std::max(setup.obstacle_lanes, setup.solid_of_ball.size()));
  }
};

template <class T>
ArmScratch<T>& arm_scratch() {
  thread_local ArmScratch<T> scratch;
  return scratch;
}

/// One motion, by lanes. All of it is inlined into the function that has the instruction set.
template <class T>
class alignas(32) ArmMotion {
 public:
  using Tables = ArmTables<T>;
  using Ball = typename Tables::Ball;
  static constexpr unsigned width = lane_count<T>;

  [[gnu::always_inline]] ArmMotion(const ArmSetup& setup, const Tables& tables, ArmScratch<T>& scratch)
      : setup_(setup), tables_(tables), scratch_(scratch) {
    scratch_.fit(setup);
  }

  /// False: the motion is none that the tables' bounds are made for.
  [[gnu::always_inline]] inline bool take(std::span<const double> q, std::span<const double> way) {
    q_ = q;
    all_way_ = way;
    for (std::size_t slot = 1; slot < setup_.drives.size(); ++slot) {
      const ArmDrive& drive = setup_.drives[slot];
      double from = drive.multiplier * q[drive.variable] + drive.offset;
      const double turn = drive.multiplier * way[drive.variable];
      if (!(std::abs(turn) <= drive.most_way)) return false;
      if (drive.slides) {
        if (!(std::min(from, from + turn) >= drive.low && std::max(from, from + turn) <= drive.high)) return false;
      } else if (!(std::abs(from) <= 3.5)) {
        if (!(std::abs(from) <= drive.most_value)) return false;
        from = std::remainder(from, 2.0 * std::numbers::pi);
      }
      start_[slot] = static_cast<T>(from);
      way_[slot] = static_cast<T>(turn);
    }
    return true;
  }

  /// How much the arm may turn away from what it does at a moment: (1) of the head comment, links in lanes.
  [[gnu::always_inline]] inline void bound_bends(T factor) {
    const std::size_t slots = setup_.drives.size();
    turned_[0] = T(0);
    for (std::size_t slot = 1; slot < slots; ++slot) {
      const ArmDrive& drive = setup_.drives[slot];
      size_[slot] = std::abs(way_[slot]);
      speed_ += size_[slot];
      travel_ += size_[slot] * static_cast<T>(drive.most_reach);
      own_[slot] = drive.slides ? T(0) : size_[slot];
      before_[slot] = 2 * turned_[drive.parent];
      turned_[slot] = turned_[drive.parent] + own_[slot];
    }
    up_ = factor * T(1.00001);
    for (std::size_t link = 0; link < setup_.moving; link += width) {
      Lanes<T> sum{};
      for (std::size_t slot = 1; slot < slots; ++slot) {
        const T weight = size_[slot] * (own_[slot] + before_[slot]);
        sum += weight * lanes_at<T>(&tables_.reach[slot * setup_.link_lanes + link]);
      }
      sum *= all_of<T>(up_);
      std::memcpy(&scratch_.bends[link], &sum, sizeof sum);
    }
  }
  /// The same of pairs, once one is asked for: most motions that are blocked meet what stands around.
  [[gnu::always_inline]] inline void bound_pairs() {
    if (are_pairs_bounded_) return;
    are_pairs_bounded_ = true;
    for (std::size_t pair = 0; pair < setup_.pairs.size(); pair += width) {
      std::array<T, width> common{};
      for (std::size_t i = 0; i < width && pair + i < setup_.pairs.size(); ++i) {
        common[i] = 2 * turned_[setup_.pairs[pair + i].common];
      }
      const Lanes<T> less = lanes_at<T>(common.data());
      Lanes<T> sum{};
      for (std::size_t slot = 1; slot < setup_.drives.size(); ++slot) {
        const Lanes<T> sway = own_[slot] + greater<T>(before_[slot] - less, Lanes<T>{});
        sum += size_[slot] * sway * lanes_at<T>(&tables_.pair_reach[slot * setup_.pair_lanes + pair]);
      }
      sum *= all_of<T>(up_);
      std::memcpy(&scratch_.bends[setup_.link_lanes + pair], &sum, sizeof sum);
    }
  }

  /// free, blocked; refused: doubt is left.
  [[gnu::always_inline]] inline MotionVerdict judge() {
    constexpr unsigned most_blocks = sizeof(T) == 4 ? 4000 : 20000;
    constexpr T finest = sizeof(T) == 4 ? T(0x1p-20) : T(0x1p-45);  // middles are exact
    const T floor = std::max(static_cast<T>(setup_.resolution), sizeof(T) == 4 ? T(2) * tables_.slack : T(0));
    bool doubt = false;
    unsigned blocks = 0;
    auto& stack = scratch_.blocks;
    stack.clear();
    scratch_.items.clear();
    fit_order();
    ArmBlock<T> whole{};
    for (unsigned i = 0; i < width; ++i) whole.middle[i] = (T(i) + T(0.5)) / width;
    whole.half = T(0.5) / width;
    stack.push_back(whole);
    while (!stack.empty()) {
      const ArmBlock<T> block = stack.back();
      stack.pop_back();
      if (++blocks + bodies_looked_at_ / 2 > most_blocks) return MotionVerdict::refused;
      scratch_.items.resize(block.end_item);
      begin(block);
      if (look_at_items(block, blocks == 1)) return MotionVerdict::blocked;
      if (open_ == 0) continue;
      if (block.half * travel_ <= floor || block.half <= finest) {
        doubt = true;
        continue;
      }
      cut(block);
    }
    return doubt ? MotionVerdict::refused : MotionVerdict::free;
  }

  /// All frames, at one moment.
  [[gnu::always_inline]] inline void place_at(T moment) {
    ArmBlock<T> block{};
    block.middle.fill(moment);
    begin(block);
    place(setup_.drives.size() - 1);
  }

  /// A lane's frame as the certificate of convex bodies wants it, in motion against another slot.
  [[gnu::always_inline]] inline MovingFrame frame_of(std::size_t slot, std::size_t against, unsigned lane,
                                                     double bend) const {
    const ArmFrameLanes<T>& f = scratch_.frames[slot];
    const ArmFrameLanes<T>& g = scratch_.frames[against];
    const auto vector = [lane](const Lanes3<T>& v) __attribute__((always_inline)) {
      return Vec3(double{v.x[lane]}, double{v.y[lane]}, double{v.z[lane]});
    };
    MovingFrame frame;
    frame.turn << vector(f.x), vector(f.y), vector(f.z);
    frame.at = vector(f.at);
    frame.spin = vector(f.spin) - vector(g.spin);
    frame.velocity = vector(f.moment) - vector(g.moment) + frame.spin.cross(frame.at);
    frame.bend = bend;
    return frame;
  }

 private:
  [[gnu::always_inline]] inline void begin(const ArmBlock<T>& block) {
    middle_ = lanes_at<T>(block.middle.data());
    half_ = block.half;
    slack_ = tables_.slack + tables_.way_slack * speed_ * half_;
    placed_ = 0;
    open_ = 0;
    scratch_.unsure.clear();
    ++scratch_.stamp;
  }

  /// Slots up to this one.
  [[gnu::always_inline]] inline void place(std::size_t slot) {
    while (placed_ < slot) place_next(++placed_);
  }

  [[gnu::always_inline]] inline void place_next(std::size_t slot) {
    const ArmDrive& drive = setup_.drives[slot];
    const typename Tables::Frame& own = tables_.frames[slot];
    const ArmFrameLanes<T>& p = scratch_.frames[drive.parent];
    ArmFrameLanes<T>& f = scratch_.frames[slot];
    const Lanes<T> value = start_[slot] + middle_ * way_[slot];
    Lanes3<T> x;
    Lanes3<T> y;
    combine(p, own.turn[0], own.turn[1], own.turn[2], x);
    combine(p, own.turn[3], own.turn[4], own.turn[5], y);
    combine(p, own.turn[6], own.turn[7], own.turn[8], f.z);
    combine(p, own.at[0], own.at[1], own.at[2], f.at);
    f.at.x += p.at.x;
    f.at.y += p.at.y;
    f.at.z += p.at.z;
    const T speed = way_[slot];
    f.spin = p.spin;
    f.moment = p.moment;
    if (drive.slides) {
      f.x = x;
      f.y = y;
      add_scaled(f.z, value, f.at);
      add_scaled(f.z, all_of<T>(speed), f.moment);
      return;
    }
    Lanes<T> s;
    Lanes<T> c;
    sines_of<T>(value, s, c);
    mix(x, c, y, s, f.x);
    mix(y, c, x, -s, f.y);
    const Lanes3<T> turning{f.z.x * speed, f.z.y * speed, f.z.z * speed};
    add_scaled(f.z, all_of<T>(speed), f.spin);
    cross_and_add<T>(f.at, turning, f.moment, f.moment);
  }

  [[gnu::always_inline]] static inline void combine(const ArmFrameLanes<T>& p, T a, T b, T c, Lanes3<T>& to) {
    to.x = p.x.x * a + p.y.x * b + p.z.x * c;
    to.y = p.x.y * a + p.y.y * b + p.z.y * c;
    to.z = p.x.z * a + p.y.z * b + p.z.z * c;
  }
  [[gnu::always_inline]] static inline void mix(const Lanes3<T>& a, const Lanes<T>& by, const Lanes3<T>& b,
                                                const Lanes<T>& and_by, Lanes3<T>& to) {
    to.x = a.x * by + b.x * and_by;
    to.y = a.y * by + b.y * and_by;
    to.z = a.z * by + b.z * and_by;
  }
  [[gnu::always_inline]] static inline void add_scaled(const Lanes3<T>& a, const Lanes<T>& by, Lanes3<T>& to) {
    to.x += a.x * by;
    to.y += a.y * by;
    to.z += a.z * by;
  }

  [[gnu::always_inline]] inline void place_ball(const ArmFrameLanes<T>& f, const Ball& ball,
                                                ArmBallLanes<T>& to) const {
    combine(f, ball.x, ball.y, ball.z, to.at);
    to.at.x += f.at.x;
    to.at.y += f.at.y;
    to.at.z += f.at.z;
    cross_and_add<T>(f.spin, to.at, f.moment, to.velocity);
  }
  [[gnu::always_inline]] inline const ArmBallLanes<T>& hull_of(std::uint32_t link) {
    if (scratch_.hull_stamps[link] != scratch_.stamp) {
      scratch_.hull_stamps[link] = scratch_.stamp;
      place(setup_.links[link].slot);
      place_ball(scratch_.frames[setup_.links[link].slot], tables_.hulls[link], scratch_.hulls[link]);
    }
    return scratch_.hulls[link];
  }
  [[gnu::always_inline]] inline void place_balls(std::uint32_t link) {
    if (scratch_.ball_stamps[link] == scratch_.stamp) return;
    scratch_.ball_stamps[link] = scratch_.stamp;
    const ArmSetup::Link& of = setup_.links[link];
    for (std::uint32_t i = of.first_ball; i < of.end_ball; ++i) {
      place_ball(scratch_.frames[of.slot], tables_.balls[i], scratch_.balls[i]);
    }
  }

  /// Lanes in which a plane with the normal `gap`, which leads from what is nearest there to a centre, stays between
  /// them; the centre is `square` off in the square, moves as told, and needs `need`.
  [[gnu::always_inline]] inline LaneMask<T> is_parted(const Lanes<T>& square, const Lanes3<T>& gap,
                                                      const Lanes3<T>& velocity, T need) const {
    constexpr T up = T(1) + 64 * unit_rounding<T>;
    const Lanes<T> left = square - magnitude<T>(dot_of<T>(gap, velocity)) * half_;
    return (left > Lanes<T>{}) & (left * left > square * (need * need * up));
  }
  /// Lanes in which something surely meets that would with `within` and no rounding.
  [[gnu::always_inline]] inline LaneMask<T> is_within(const Lanes<T>& square, T within) const {
    const T surely = std::max(within - tables_.slack, T(0));
    return square < all_of<T>(surely * surely * (T(1) - 64 * unit_rounding<T>));
  }

  /// From the nearest point of an obstacle's core to p; its square.
  [[gnu::always_inline]] inline Lanes<T> gap_of(std::uint32_t obstacle, const Lanes3<T>& p, Lanes3<T>& gap) const {
    const typename Tables::Obstacle& o = tables_.obstacles[obstacle];
    const Lanes3<T> d{p.x - o.x, p.y - o.y, p.z - o.z};
    gap = d;
    switch (setup_.shapes[obstacle]) {
      case ArmObstacleShape::point:
        break;
      case ArmObstacleShape::upright_box:
        gap = {d.x - clamped<T>(d.x, o.half[0]), d.y - clamped<T>(d.y, o.half[1]), d.z - clamped<T>(d.z, o.half[2])};
        break;
      case ArmObstacleShape::segment: {
        const Lanes<T> along = clamped<T>(d.x * o.axes[6] + d.y * o.axes[7] + d.z * o.axes[8], o.half[2]);
        gap = {d.x - along * o.axes[6], d.y - along * o.axes[7], d.z - along * o.axes[8]};
        break;
      }
      case ArmObstacleShape::box: {
        Lanes<T> x = d.x * o.axes[0] + d.y * o.axes[1] + d.z * o.axes[2];
        Lanes<T> y = d.x * o.axes[3] + d.y * o.axes[4] + d.z * o.axes[5];
        Lanes<T> z = d.x * o.axes[6] + d.y * o.axes[7] + d.z * o.axes[8];
        x -= clamped<T>(x, o.half[0]);
        y -= clamped<T>(y, o.half[1]);
        z -= clamped<T>(z, o.half[2]);
        gap = {x * o.axes[0] + y * o.axes[3] + z * o.axes[6], x * o.axes[1] + y * o.axes[4] + z * o.axes[7],
               x * o.axes[2] + y * o.axes[5] + z * o.axes[8]};
        return x * x + y * y + z * z;
      }
      case ArmObstacleShape::cylinder: {
        const Lanes<T> along = d.x * o.axes[6] + d.y * o.axes[7] + d.z * o.axes[8];
        Lanes3<T> off{d.x - along * o.axes[6], d.y - along * o.axes[7], d.z - along * o.axes[8]};
        const Lanes<T> away = root_of<T>(dot_of<T>(off, off));
        const Lanes<T> beyond = along - clamped<T>(along, o.half[2]);
        const Lanes<T> outside = greater<T>(away - o.half[0], Lanes<T>{});
        const Lanes<T> part = outside / greater<T>(away, all_of<T>(std::numeric_limits<T>::min()));
        gap = {off.x * part + beyond * o.axes[6], off.y * part + beyond * o.axes[7], off.z * part + beyond * o.axes[8]};
        return beyond * beyond + outside * outside;
      }
    }
    return dot_of<T>(gap, gap);
  }

  /// Obstacles that what is around a link's hull on its pieces meets, and of which its hull is not parted.
  [[gnu::always_inline]] inline std::size_t near_obstacles(std::uint32_t link, T room) {
    const ArmBallLanes<T>& hull = hull_of(link);
    const T need = tables_.hulls[link].outer + room;
    const Lanes3<T> wide{magnitude<T>(hull.velocity.x) * half_ + need, magnitude<T>(hull.velocity.y) * half_ + need,
                         magnitude<T>(hull.velocity.z) * half_ + need};
    const Lanes<T> low_x = least_lane<T>(hull.at.x - wide.x);
    const Lanes<T> low_y = least_lane<T>(hull.at.y - wide.y);
    const Lanes<T> low_z = least_lane<T>(hull.at.z - wide.z);
    const Lanes<T> high_x = -least_lane<T>(-hull.at.x - wide.x);
    const Lanes<T> high_y = -least_lane<T>(-hull.at.y - wide.y);
    const Lanes<T> high_z = -least_lane<T>(-hull.at.z - wide.z);
    const auto& b = tables_.bounds;
    std::size_t count = 0;
    for (std::size_t first = 0; first < setup_.obstacle_lanes; first += width) {
      const LaneMask<T> meets = (lanes_at<T>(&b[0][first]) <= high_x) & (lanes_at<T>(&b[3][first]) >= low_x) &
                                (lanes_at<T>(&b[1][first]) <= high_y) & (lanes_at<T>(&b[4][first]) >= low_y) &
                                (lanes_at<T>(&b[2][first]) <= high_z) & (lanes_at<T>(&b[5][first]) >= low_z);
      for (unsigned bits = bits_of<T>(meets); bits != 0; bits &= bits - 1) {
        const auto obstacle = as_whole<std::uint32_t>(first) + as_whole<std::uint32_t>(std::countr_zero(bits));
        Lanes3<T> gap;
        const Lanes<T> square = gap_of(obstacle, hull.at, gap);
        const T all = need + tables_.obstacles[obstacle].inflate;
        if (bits_of<T>(is_parted(square, gap, hull.velocity, all)) != all_lanes<T>) scratch_.near[count++] = obstacle;
      }
    }
    return count;
  }

  /// True: the link surely meets something. Lanes in which that is open are noted.
  [[gnu::always_inline]] inline bool look_at_link(std::uint32_t link, unsigned& open) {
    const T room = T(0.5) * half_ * half_ * scratch_.bends[link] + slack_;
    const std::size_t count = near_obstacles(link, room);
    if (count == 0) return false;
    place_balls(link);
    for (std::uint32_t i = setup_.links[link].first_ball; i < setup_.links[link].end_ball; ++i) {
      const ArmBallLanes<T>& ball = scratch_.balls[i];
      const T outer = tables_.balls[i].outer + room;
      for (std::size_t n = 0; n < count; ++n) {
        const std::uint32_t obstacle = scratch_.near[n];
        const T inflate = tables_.obstacles[obstacle].inflate;
        Lanes3<T> gap;
        const Lanes<T> square = gap_of(obstacle, ball.at, gap);
        const unsigned left = all_lanes<T> & ~bits_of<T>(is_parted(square, gap, ball.velocity, outer + inflate));
        if (left == 0) continue;
        if (setup_.is_whole_obstacle[obstacle] != 0 &&
            bits_of<T>(is_within(square, tables_.balls[i].inner + inflate)) != 0 && tables_.balls[i].inner > T(0)) {
          return true;
        }
        note(setup_.is_whole_ball[i] != 0 && setup_.is_whole_obstacle[obstacle] != 0, setup_.solid_of_ball[i], obstacle,
             left, open);
      }
    }
    return false;
  }

  [[gnu::always_inline]] inline void note(bool is_whole, std::uint32_t solid, std::uint32_t other, unsigned left,
                                          unsigned& open) {
    if (is_whole) {
      open |= left;
      return;
    }
    for (std::size_t i = first_unsure_; i < scratch_.unsure.size(); ++i) {
      ArmUnsure& unsure = scratch_.unsure[i];
      if (unsure.solid != solid || unsure.other != other) continue;
      unsure.lanes |= left;
      return;
    }
    scratch_.unsure.push_back({item_, solid, other, left});
  }

  /// Is a ball not parted from the hull of another link, in some lane?
  [[gnu::always_inline]] inline bool is_near(std::uint32_t ball, std::uint32_t other, T room) const {
    const ArmBallLanes<T>& hull = scratch_.hulls[other];
    Lanes3<T> gap;
    Lanes3<T> velocity;
    subtract<T>(scratch_.balls[ball].at, hull.at, gap);
    subtract<T>(scratch_.balls[ball].velocity, hull.velocity, velocity);
    const T need = tables_.hulls[other].outer + tables_.balls[ball].outer + room;
    return bits_of<T>(is_parted(dot_of<T>(gap, gap), gap, velocity, need)) != all_lanes<T>;
  }

  [[gnu::always_inline]] inline bool look_at_pair(std::uint32_t pair, unsigned& open) {
    const auto [a, b, common] = setup_.pairs[pair];
    bound_pairs();
    const T room = T(0.5) * half_ * half_ * scratch_.bends[setup_.link_lanes + pair] + slack_ + tables_.clearance;
    const ArmBallLanes<T>& hull_a = hull_of(a);
    const ArmBallLanes<T>& hull_b = hull_of(b);
    Lanes3<T> gap;
    Lanes3<T> velocity;
    subtract<T>(hull_b.at, hull_a.at, gap);
    subtract<T>(hull_b.velocity, hull_a.velocity, velocity);
    const T hulls = tables_.hulls[a].outer + tables_.hulls[b].outer + room;
    if (bits_of<T>(is_parted(dot_of<T>(gap, gap), gap, velocity, hulls)) == all_lanes<T>) return false;
    place_balls(a);
    place_balls(b);
    std::size_t count = 0;
    for (std::uint32_t i = setup_.links[b].first_ball; i < setup_.links[b].end_ball; ++i) {
      if (is_near(i, a, room)) scratch_.near[count++] = i;
    }
    if (count == 0) return false;
    for (std::uint32_t i = setup_.links[a].first_ball; i < setup_.links[a].end_ball; ++i) {
      if (count > 1 && !is_near(i, b, room)) continue;
      const ArmBallLanes<T>& ball = scratch_.balls[i];
      for (std::size_t n = 0; n < count; ++n) {
        const std::uint32_t other = scratch_.near[n];
        subtract<T>(scratch_.balls[other].at, ball.at, gap);
        subtract<T>(scratch_.balls[other].velocity, ball.velocity, velocity);
        const Lanes<T> square = dot_of<T>(gap, gap);
        const T outer = tables_.balls[i].outer + tables_.balls[other].outer + room;
        const unsigned left = all_lanes<T> & ~bits_of<T>(is_parted(square, gap, velocity, outer));
        if (left == 0) continue;
        const T least = std::min(tables_.balls[i].inner, tables_.balls[other].inner);
        const T inner = tables_.balls[i].inner + tables_.balls[other].inner + tables_.clearance;
        if (least > T(0) && bits_of<T>(is_within(square, inner)) != 0) return true;
        note(setup_.is_whole_ball[i] != 0 && setup_.is_whole_ball[other] != 0, setup_.solid_of_ball[i],
             setup_.solid_of_ball[other], left, open);
      }
    }
    return false;
  }

  /// Pairs come after the links' lanes. True: it surely meets something.
  [[gnu::always_inline]] inline bool look_at(std::uint32_t item) {
    unsigned open = 0;
    item_ = item;
    first_unsure_ = scratch_.unsure.size();
    const bool is_link = item < setup_.link_lanes;
    const auto pair = as_whole<std::uint32_t>(item - setup_.link_lanes);
    if (is_link ? look_at_link(item, open) : look_at_pair(pair, open)) return true;
    if (open != 0) scratch_.items.push_back(item);
    open_ |= open;
    return false;
  }

  /// What stopped a motion is asked first of the next one: a hit is a hit in any order.
  [[gnu::always_inline]] inline void fit_order() {
    const std::size_t all = setup_.moving + setup_.pairs.size();
    const std::array<std::size_t, 3> sizes{setup_.link_lanes, setup_.moving, setup_.pairs.size()};
    if (scratch_.order_sizes == sizes) return;  // of any arm with these sizes it is an order of all that there is
    scratch_.order.clear();
    scratch_.order_sizes = sizes;
    for (std::size_t i = 0; i < all; ++i) {
      scratch_.order.push_back(as_whole<std::uint32_t>(i < setup_.moving ? i : i - setup_.moving + setup_.link_lanes));
    }
  }
  /// The block's items, for the first block all. True: one surely meets something.
  [[gnu::always_inline]] inline bool look_at_items(const ArmBlock<T>& block, bool is_first) {
    const std::size_t first = is_first ? 0 : block.first_item;
    const std::size_t end = is_first ? scratch_.order.size() : block.end_item;
    for (std::size_t i = first; i < end; ++i) {
      const std::uint32_t item = is_first ? scratch_.order[i] : scratch_.items[i];
      if (!look_at(item)) continue;
      if (is_first)
        std::rotate(scratch_.order.begin(), scratch_.order.begin() + as_whole<std::ptrdiff_t>(i),
                    scratch_.order.begin() + as_whole<std::ptrdiff_t>(i) + 1);
      return true;
    }
    return !scratch_.unsure.empty() && settle(block.end_item);
  }

  /// The convex bodies themselves, lane by lane, for what their balls leave open: rare, so no part of the search's
  /// code. True: two surely meet. Items that stay open are noted from first_item on.
  [[gnu::noinline]] bool settle(std::size_t first_item) {
    const double room = setup_.clearance + double{slack_};
    for (const ArmUnsure& unsure : scratch_.unsure) {
      const bool is_link = unsure.item < setup_.link_lanes;
      const ArmSetup::Pair pair =
          is_link ? ArmSetup::Pair{unsure.item, 0, 0} : setup_.pairs[unsure.item - setup_.link_lanes];
      const std::size_t slot = setup_.links[pair.a].slot;
      const std::size_t other_slot = is_link ? 0 : setup_.links[pair.b].slot;
      const double bend = double{scratch_.bends[unsure.item]} * (is_link ? 1.0 : 0.5);  // of a pair it is that of both
      const ConvexBody& one = setup_.solids[unsure.solid];
      const ConvexBody& other = is_link ? setup_.bodies[unsure.other] : setup_.solids[unsure.other];
      const auto cost = as_whole<unsigned>(one.cost() + other.cost());
      unsigned open = 0;
      for (unsigned lanes = unsure.lanes; lanes != 0; lanes &= lanes - 1) {
        bodies_looked_at_ += cost;
        const auto lane = as_whole<unsigned>(std::countr_zero(lanes));
        const MovingFrame at = frame_of(slot, pair.common, lane, bend);
        const MovingFrame other_at = frame_of(other_slot, pair.common, lane, is_link ? 0.0 : bend);
        const Apart apart = keep_apart(one, at, other, other_at, double{half_}, room);
        if (apart == Apart::proved) continue;
        if (apart == Apart::meet && surely_meet(one, slot, other, other_slot, lane)) return true;
        open |= 1U << lane;
      }
      open_ |= open;
      auto& items = scratch_.items;
      const auto noted = items.begin() + as_whole<std::ptrdiff_t>(first_item);
      if (open != 0 && std::find(noted, items.end(), unsure.item) == items.end()) items.push_back(unsure.item);
    }
    return false;
  }
  /// By frames in doubles: do they meet in the middle of a piece?
  bool surely_meet(const ConvexBody& one, std::size_t slot, const ConvexBody& other, std::size_t other_slot,
                   unsigned lane) {
    ArmMotion<double> exact(setup_, setup_.doubles, arm_scratch<double>());
    if constexpr (sizeof(T) == sizeof(float)) {
      if (!exact.take(q_, all_way_)) return false;
      exact.place_at(double{middle_[lane]});
      lane = 0;
    }
    const MovingFrame at = exact.frame_of(slot, slot, lane, 0.0);
    const MovingFrame other_at = exact.frame_of(other_slot, other_slot, lane, 0.0);
    return keep_apart(one, at, other, other_at, 0.0, setup_.clearance) == Apart::meet;
  }

  /// Open pieces are cut, half a block of them into a whole one, as finely as its lanes allow.
  [[gnu::always_inline]] inline void cut(const ArmBlock<T>& block) {
    while (open_ != 0) {
      std::array<unsigned, width / 2> pieces;
      unsigned count = 0;
      for (; open_ != 0 && count < width / 2; open_ &= open_ - 1) {
        pieces[count++] = as_whole<unsigned>(std::countr_zero(open_));
      }
      const unsigned each = width / std::bit_ceil(count);
      ArmBlock<T> part;
      part.half = block.half / static_cast<T>(each);
      for (unsigned i = 0; i < width; ++i) {
        const T piece = block.middle[pieces[std::min(i / each, count - 1)]];
        part.middle[i] = piece - block.half + static_cast<T>(2 * (i % each) + 1) * part.half;
      }
      part.first_item = block.end_item;
      part.end_item = scratch_.items.size();
      scratch_.blocks.push_back(part);
    }
  }

  const ArmSetup& setup_;
  const Tables& tables_;
  ArmScratch<T>& scratch_;
  std::span<const double> q_;
  std::span<const double> all_way_;
  std::array<T, most_frames + 1> start_;
  std::array<T, most_frames + 1> way_;
  std::array<T, most_frames + 1> size_;    // of the way
  std::array<T, most_frames + 1> own_;     // of the turn
  std::array<T, most_frames + 1> before_;  // twice what turns before
  std::array<T, most_frames + 1> turned_;  // by the slot and those before it
  T up_;                                   // for rounding
  bool are_pairs_bounded_ = false;
  T speed_ = 0;   // sum of the sizes
  T travel_ = 0;  // of any point, at most
  Lanes<T> middle_;
  T half_;
  T slack_;
  std::size_t placed_;
  std::uint32_t item_ = 0;         // that is looked at
  std::size_t first_unsure_ = 0;   // of it
  unsigned open_;                  // lanes
  unsigned bodies_looked_at_ = 0;  // pairs of convex bodies, a lane each; large ones count more than once
};

template <class T>
[[gnu::always_inline]] inline MotionVerdict judge_by_lanes(const ArmSetup& setup, const ArmTables<T>& tables,
                                                           std::span<const double> q, std::span<const double> way,
                                                           double bend_factor) {
  if (!(tables.slack < T(1e30))) return MotionVerdict::refused;
  ArmMotion<T> motion(setup, tables, arm_scratch<T>());
  if (!motion.take(q, way)) return MotionVerdict::refused;
  motion.bound_bends(static_cast<T>(bend_factor));
  return motion.judge();
}

}  // namespace

MotionVerdict judge_arm_motion(const ArmSetup& setup, std::span<const double> q, std::span<const double> way,
                               InstructionSet set, double bend_factor) {
  if (setup.always_meets) return MotionVerdict::blocked;
  MotionVerdict verdict = MotionVerdict::refused;
  const auto by_floats = VersionsOf<&judge_by_lanes<float>>::up_to_avx2(set);
  const auto by_doubles = VersionsOf<&judge_by_lanes<double>>::up_to_avx2(set);
  if (setup.floats_hold) verdict = by_floats(setup, setup.floats, q, way, bend_factor);
  if (verdict == MotionVerdict::refused) verdict = by_doubles(setup, setup.doubles, q, way, bend_factor);
  return verdict == MotionVerdict::free && setup.always_touches ? MotionVerdict::refused : verdict;
}

}  // namespace warren::detail

namespace warren {

MotionVerdict ArmCertificate::motion(std::span<const double> q, std::span<const double> way) const {
  return detail::judge_arm_motion(*this, q, way, detail::best_instruction_set());
}

bool ArmCertificate::is_free(std::span<const double> q) const {
  constexpr JointState rest{};
  return motion(q, rest) == MotionVerdict::free;
}

}  // namespace warren
