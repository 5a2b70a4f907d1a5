// SPDX-License-Identifier: BSD-3-Clause
// The shortest path of a point among the polygons of a GeoJSON file, proved to be the shortest; and judged once more.
#include <iostream>
#include <warren/warren.hpp>

int main(int argc, char** argv) {
  const warren::Scene town = warren::read_world(argc > 1 ? argv[1] : "town.geojson");
  const warren::Answer answer = warren::solve(town, {.start = {1.5, 1.5}, .goal = {9.5, 8.5}});
  const warren::Verdict verdict = warren::verify(town, answer);
  std::cout << answer.planner << ": " << verdict.length << (answer.optimal ? ", the shortest there is\n" : "\n");
  warren::write_picture("polygons.svg", town, answer);
  return verdict.verified ? 0 : 1;
}
