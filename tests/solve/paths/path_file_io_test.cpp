// SPDX-License-Identifier: BSD-3-Clause
#include "solve/paths/path_file_io.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/se2.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/scenes/files/temporary_directory.hpp"

namespace warren {
namespace {

std::string written(const Answer& answer, const std::string& ending, const PathFileOptions& options,
                    PathFileAccount* account = nullptr) {
  const TemporaryDirectory folder;
  const PathFileAccount made = write_path_file(answer, folder.file("path" + ending), options, {});
  if (account != nullptr) *account = made;
  return folder.read("path" + ending);
}

using Table = std::vector<std::vector<double>>;
Table rows_of(const std::string& csv, std::string& header) {
  std::istringstream in(csv);
  std::getline(in, header);
  Table rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

Answer solved(const std::string& name) {
  return solve(read_world(test::source_dir() + "/examples/worlds/" + name),
               name == "town.geojson" ? Question{.start = {1.5, 1.5}, .goal = {9.5, 8.5}} : Question{});
}

/// Who reads a path joins its places by straight lines.
TEST(PathFile, ChordsOfACarsArcsTurnByAtMostFiveDegreesInEveryFormat) {
  const Answer answer = solved("car-20.scene");
  std::string header;
  const Table rows = rows_of(written(answer, ".csv", {}), header);
  ASSERT_GT(rows.size(), answer.states.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_LE(std::abs(turn_between(rows[i - 1][3], rows[i][3])), 5.0 * std::numbers::pi / 180.0 + 1e-9) << i;
  }
  EXPECT_EQ(nlohmann::json::parse(written(answer, ".geojson", {}))["geometry"]["coordinates"].size(), rows.size());
  EXPECT_EQ(YAML::Load(written(answer, ".yaml", {}))["poses"].size(), rows.size());
  EXPECT_GT(rows_of(written(answer, ".csv", {.every = 0.01}), header).size(), rows.size());
}

TEST(PathFile, CsvHasThePathsOwnStatesWhereNothingElseIsAsked) {
  const Answer answer = solved("town.geojson");
  std::string header;
  const Table rows = rows_of(written(answer, ".csv", {}), header);
  EXPECT_EQ(header, "s,x,y");
  ASSERT_EQ(rows.size(), answer.path.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][1], answer.path[i].x);
    EXPECT_EQ(rows[i][2], answer.path[i].y);
  }
  EXPECT_NEAR(rows.back()[0], answer.length, 1e-12);
}

TEST(PathFile, PlacesAreNoFartherApartThanAskedAndCornersStay) {
  const Answer answer = solved("town.geojson");
  std::string header;
  const Table rows = rows_of(written(answer, ".csv", {.every = 0.3}), header);
  std::size_t corners = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_LE(rows[i][0] - rows[i == 0 ? 0 : i - 1][0], 0.3 + 1e-12);
    if (corners < answer.path.size() && Vec2{rows[i][1], rows[i][2]} == answer.path[corners]) ++corners;
  }
  EXPECT_EQ(corners, answer.path.size());
}

TEST(PathFile, MomentsAreEvenAndTheGoalIsTheLast) {
  const Answer answer = solved("parking-lot.scene");
  std::string header;
  PathFileAccount account;
  const PathFileOptions options{.every_s = 0.25, .limits = TravelLimits{.speed = 1.5, .acceleration = 0.8}};
  const Table rows = rows_of(written(answer, ".csv", options, &account), header);
  EXPECT_EQ(header, "t,s,x,y,theta,speed");
  EXPECT_EQ(account.places, rows.size());
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) EXPECT_DOUBLE_EQ(rows[i][0], 0.25 * static_cast<double>(i));
  EXPECT_EQ(rows.back()[0], account.duration_s);
  EXPECT_EQ(rows.back()[2], answer.states[answer.states.size() - 1][0]);
  EXPECT_NEAR(rows.back()[1], answer.length, 1e-9);
  EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.back() < 0.0; })) << "it backs in";
}

/// Who is at the goal already, by planners that make no leg of that.
TEST(PathFile, APathOfOneStateIsOneRowAtRest) {
  Answer point;
  point.path = {Vec2{1.5, 2.5}};
  Answer car;
  car.problem.robot = {.kind = RobotKind::car, .turning_radius = 1.5};
  car.states.width = 3;
  car.states.add(std::array{1.5, 2.5, 0.5});
  const TravelLimits limits{.speed = 1.0};
  for (const PathFileOptions& options : {PathFileOptions{.limits = limits}, {.every_s = 0.1, .limits = limits}}) {
    EXPECT_EQ(written(point, ".csv", options), "t,s,x,y,speed\n0,0,1.5,2.5,0\n");
    EXPECT_EQ(written(car, ".csv", options), "t,s,x,y,theta,speed\n0,0,1.5,2.5,0.5,0\n");
  }
  EXPECT_EQ(written(point, ".csv", {}), "s,x,y\n0,1.5,2.5\n");
  EXPECT_EQ(written(car, ".csv", {}), "s,x,y,theta\n0,1.5,2.5,0.5\n");
}

TEST(PathFile, YamlIsAPathOfRos) {
  const Answer answer = solved("parking-lot.scene");
  const PathFileOptions options{
      .every = 0.5, .limits = TravelLimits{.speed = 1.0, .acceleration = 0.5}, .frame = "odom"};
  const YAML::Node path = YAML::Load(written(answer, ".yaml", options));
  EXPECT_EQ(path["header"]["frame_id"].as<std::string>(), "odom");
  const YAML::Node last = path["poses"][path["poses"].size() - 1];
  const double theta = answer.states[answer.states.size() - 1][2];
  EXPECT_NEAR(last["pose"]["orientation"]["z"].as<double>(), std::sin(theta / 2), 1e-12);
  EXPECT_NEAR(last["pose"]["orientation"]["w"].as<double>(), std::cos(theta / 2), 1e-12);
  double before = -1.0;
  for (const YAML::Node& pose : path["poses"]) {
    const YAML::Node stamp = pose["header"]["stamp"];
    const double now = stamp["sec"].as<double>() + 1e-9 * stamp["nanosec"].as<double>();
    EXPECT_GE(now, before);
    before = now;
  }
  // What has no heading looks ahead.
  const Answer point = solved("town.geojson");
  const YAML::Node first = YAML::Load(written(point, ".yaml", {}))["poses"][0]["pose"]["orientation"];
  const Vec2 ahead = point.path[1] - point.path[0];
  EXPECT_NEAR(2.0 * std::atan2(first["z"].as<double>(), first["w"].as<double>()), std::atan2(ahead.y, ahead.x), 1e-9);
}

TEST(PathFile, GeoJsonIsALineWithItsTimes) {
  const Answer answer = solved("parking-lot.scene");
  const auto line = nlohmann::json::parse(
      written(answer, ".geojson", {.every = 0.5, .limits = TravelLimits{.speed = 1.0, .acceleration = 0.5}}));
  EXPECT_EQ(line["type"], "Feature");
  EXPECT_EQ(line["geometry"]["type"], "LineString");
  const std::size_t places = line["geometry"]["coordinates"].size();
  for (const char* list : {"theta", "t", "speed"}) EXPECT_EQ(line["properties"][list].size(), places) << list;
  EXPECT_EQ(line["properties"]["length"], answer.length);
}

TEST(PathFile, RefusesWhatItCanNotWrite) {
  const Answer answer = solved("town.geojson");
  EXPECT_THROW(path_format("path.txt"), UsageError);
  EXPECT_THROW(written(answer, ".csv", {.every = 1e-300}), UsageError);
  Answer arm;
  arm.problem.robot.kind = RobotKind::puma560;
  arm.states.width = 6;
  for (int i = 0; i < 2; ++i) arm.states.add(std::vector<double>(6, 0.1 * i));
  EXPECT_THROW(written(arm, ".yaml", {}), UsageError);
  std::string header;
  EXPECT_EQ(rows_of(written(arm, ".csv", {}), header).size(), 2U);
  EXPECT_EQ(header, "s,q1,q2,q3,q4,q5,q6");
}

}  // namespace
}  // namespace warren
