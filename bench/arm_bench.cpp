// SPDX-License-Identifier: BSD-3-Clause
// What an arm costs: forward kinematics of the Puma, with plain 4 x 4 matrices beside it; whether a state is free among
// n spheres, by the certificate and by a plain loop; motions certified, and sampled at ten places as the study's
// program did (the labels say how many were accepted and how many of these collide at one of 1000 places); a roadmap of
// n milestones.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

#include "bench/bodies.hpp"
#include "planners/roadmap/prm.hpp"

namespace {

using namespace warren;
using namespace warren::bench;

void bm_forward_kinematics(benchmark::State& state) {
  const ArmWorld world(Scene{}, model_of(puma560_table(state.range(0) == 0 ? 0.0 : 0.1), puma_radius, false), {});
  std::vector<JointState> states;
  for (std::uint64_t i = 0; i < 1024; ++i) states.push_back(uniform_state(world, 1, i));
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(world.kinematics().tool_pose(states[i++ % states.size()]));
  }
}
BENCHMARK(bm_forward_kinematics)->ArgName("tool")->Arg(0)->Arg(1);

void bm_plain_matrices(benchmark::State& state) {
  const DhTable table = puma560_table(0.1);
  const ArmWorld world(Scene{}, model_of(table, puma_radius, false), {});
  std::vector<JointState> states;
  for (std::uint64_t i = 0; i < 1024; ++i) states.push_back(uniform_state(world, 1, i));
  std::size_t i = 0;
  for (auto _ : state) {
    const JointState& q = states[i++ % states.size()];
    Eigen::Matrix4d frame = Eigen::Matrix4d::Identity();
    for (std::size_t j = 0; j < table.joints.size(); ++j) {
      const DhJoint& joint = table.joints[j];
      const double c = std::cos(q[j]);
      const double s = std::sin(q[j]);
      const double ca = std::cos(joint.alpha_rad);
      const double sa = std::sin(joint.alpha_rad);
      Eigen::Matrix4d step;
      step << c, -s * ca, s * sa, joint.a * c, s, c * ca, -c * sa, joint.a * s, 0, sa, ca, joint.d, 0, 0, 0, 1;
      frame = frame * step;
      benchmark::DoNotOptimize(frame);
    }
  }
}
BENCHMARK(bm_plain_matrices);

void bm_arm_state(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Scene scene = spheres(n);
  const ArmWorld world = world_of(n);
  const SerialChain chain(puma560_table());
  auto query = world.make_query();
  for (std::uint64_t i = 0; i < 100; ++i) {
    const JointState q = uniform_state(world, 1, i);
    const double plain = plain_clearance(chain, scene, q);
    if (std::abs(plain) > 1e-9 && world.is_free(q, query) != plain > 0.0)
      state.SkipWithError("index and loop disagree");
  }
  std::uint64_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(world.is_free(uniform_state(world, 1, i++ % 4096), query));
}
BENCHMARK(bm_arm_state)->Arg(9)->Arg(100)->Arg(1000)->Arg(10000);

void bm_plain_arm_state(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Scene scene = spheres(n);
  const ArmWorld world = world_of(n);
  const SerialChain chain(puma560_table());
  std::uint64_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(plain_clearance(chain, scene, uniform_state(world, 1, i++ % 4096)) > 0.0);
}
BENCHMARK(bm_plain_arm_state)->Arg(9)->Arg(100)->Arg(1000);

bool sampled_free(const ArmWorld& world, const JointState& a, const JointState& b, int places) {
  auto query = world.make_query();
  for (int i = 0; i <= places; ++i) {
    if (!world.is_free(world.interpolate(a, b, static_cast<double>(i) / places), query)) return false;
  }
  return true;
}

/// Motions between milestones and their neighbours in a roadmap of some hundred, both ends free.
struct Motion {
  JointState a;
  JointState b;
};
std::vector<Motion> motions_in(const ArmWorld& world) {
  auto query = world.make_query();
  std::vector<Motion> motions;
  for (std::uint64_t i = 0; motions.size() < 2000; ++i) {
    const JointState a = uniform_state(world, 1, 2 * i);
    const JointState far = uniform_state(world, 1, 2 * i + 1);
    const JointState b = world.interpolate(a, far, std::min(1.0, 1.5 / world.distance(a, far)));
    if (world.is_free(a, query) && world.is_free(b, query)) motions.push_back({a, b});
  }
  return motions;
}

template <class Check>
void run_arm_motions(benchmark::State& state, const Check& check) {
  const ArmWorld world = world_of(static_cast<std::size_t>(state.range(0)));
  const std::vector<Motion> motions = motions_in(world);
  int accepted = 0;
  int wrong = 0;
  int truly_free = 0;
  for (const Motion& m : motions) {
    const bool is_free = sampled_free(world, m.a, m.b, 1000);
    truly_free += is_free ? 1 : 0;
    if (!check(world, m)) continue;
    ++accepted;
    wrong += is_free ? 0 : 1;
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(check(world, motions[i++ % motions.size()]));
  state.counters["accepted"] = accepted;
  state.counters["colliding"] = wrong;
  state.counters["free"] = truly_free;
}

void bm_certified_arm_motion(benchmark::State& state) {
  run_arm_motions(state, [](const ArmWorld& world, const Motion& m) {
    auto query = world.make_query();
    return world.is_free_motion(m.a, m.b, query);
  });
}
BENCHMARK(bm_certified_arm_motion)->Arg(9)->Arg(100)->Arg(1000);

void bm_ten_arm_samples(benchmark::State& state) {
  run_arm_motions(state, [](const ArmWorld& world, const Motion& m) { return sampled_free(world, m.a, m.b, 11); });
}
BENCHMARK(bm_ten_arm_samples)->Arg(9)->Arg(100)->Arg(1000);

/// The whole of a roadmap with k = 10: samples, neighbours, motions, graph, query.
void bm_roadmap(benchmark::State& state) {
  const auto n = static_cast<std::uint64_t>(state.range(0));
  const ArmWorld world = world_of(9);
  auto query = world.make_query();
  std::vector<JointState> ends;
  for (std::uint64_t i = 0; ends.size() < 2; ++i) {
    const JointState q = uniform_state(world, 77, i);
    if (world.is_free(q, query)) ends.push_back(q);
  }
  RoadmapOptions options;
  options.samples = n;
  options.neighbours = 10;
  const Execution execution{.threads = static_cast<unsigned>(state.range(1))};
  std::uint64_t milestones = 0;
  for (auto _ : state) milestones += prm(WorldView(world), ends[0], ends[1], options, execution).roadmap.milestones;
  state.SetItemsProcessed(static_cast<std::int64_t>(milestones));
}
BENCHMARK(bm_roadmap)->ArgsProduct({{100, 1000, 10000}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
