// SPDX-License-Identifier: BSD-3-Clause
// A car that backs into a gap between parked cars, within two seconds on two threads, or it says why not.
#include <chrono>
#include <iostream>
#include <warren/warren.hpp>

int main(int argc, char** argv) try {
  using namespace std::chrono_literals;
  const warren::Scene street = warren::read_world(argc > 1 ? argv[1] : "parking-lot.scene");
  const warren::Answer answer = warren::solve(street, {}, {.seed = 3, .optimise = true}, {.threads = 2, .budget = 2s});
  for (std::size_t i = 0; i < answer.states.size(); ++i) {
    const auto pose = answer.states[i];
    std::cout << pose[0] << ' ' << pose[1] << ' ' << pose[2] << '\n';
  }
  warren::write_picture("parking.svg", street, answer);
  return answer.verified ? 0 : 1;
} catch (const warren::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
