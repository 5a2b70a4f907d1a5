// SPDX-License-Identifier: BSD-3-Clause
// The interface of `warren serve` (docs/service.md): page, tiles, questions and paths of one world, as a service that
// any server of HTTP may ask. And what it tells of questions that are still being answered.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/serve/api/served_world.hpp"
#include "apps/serve/http/http_server.hpp"
#include "core/base/solution.hpp"

namespace warren::serve {

// Which of a service's places a request is for (route.cpp).

enum class Place : std::uint8_t {
  graph,
  open_graph,
  save_graph,
  check,
  health,
  metrics,
  world,
  query,
  batch,
  progress,
  scene,
  update,
  path,
  clearance,
  sweep,
  file,
  tile,
  layer,
  legend
};
/// Of those below api/, but for a path's own name; the last ones have other addresses.
constexpr auto enum_names(Place) {
  return std::array<std::string_view, 15>{"graph",   "graph/open", "graph/save", "check",          "health",
                                          "metrics", "world",      "query",      "query/batch",    "progress",
                                          "scene",   "update",     "path",       "path/clearance", "path/sweep"};
}

struct Route {
  Place place;
  std::string name = {};  ///< of a file, of a path, of a layer
  TilePlace tile = {};
  bool has_its_hash = false;  ///< a tile's address names its world, so what it shows never changes
};

/// Is it a question about a route graph?
bool is_of_graphs(Place place);

/// hash: of the world. Throws HttpError: 404 for a path that is none, 405 for the wrong method.
Route route_of(const HttpRequest& request, const TileGrid& grid, std::string_view hash);

/// A parameter of the query; nothing where it is missing. Throws HttpError where it is there twice.
std::optional<std::string> parameter(const HttpRequest& request, std::string_view name);
/// The same as numbers apart by commas. Throws HttpError where they are others than so many finite ones.
std::optional<std::vector<double>> numbers_parameter(const HttpRequest& request, std::string_view name,
                                                     std::size_t count);
/// Is it 1, or else missing or 0? Throws HttpError.
bool flag_parameter(const HttpRequest& request, std::string_view name);

// Questions that are being answered, by the names that their askers gave them, and each better path of planners that
// get better with time: whoever waits for the answer sees what there is already.

/// Any number of threads may use it.
class RunningQuestions {
 public:
  /// A question that is named while this lives. Under a name that is taken, or "", nothing is seen of it.
  class Entry : NotCopied {
   public:
    Entry(RunningQuestions& all, std::string name);
    ~Entry();
    bool is_seen() const { return is_seen_; }
    /// Keeps what came last, up to most_told; of ways of more than most_points the points are left out.
    void tell(const Improvement& improvement, std::vector<Vec2> way);

   private:
    RunningQuestions& all_;
    std::string name_;
    bool is_seen_;
  };

  static constexpr std::size_t most_told = 64;
  static constexpr std::size_t most_points = 2000;
  static constexpr std::size_t most_points_told = 4000;  ///< at once, but for the last way's

  /// Is a question of this name running, and what came from its from-th improvement on, or some of it; as JSON.
  std::string told(const std::string& name, std::uint64_t from) const;

 private:
  struct Told {
    Improvement improvement;
    std::vector<Vec2> way;  ///< of the reference point
  };
  struct Question {
    std::uint64_t first = 0;  ///< the number of the first that is kept
    std::deque<Told> told = {};
  };
  Guarded<std::map<std::string, Question>> questions_;
};

/// What is asked about route graphs of the served world (docs/service.md): built, opened, judged edge by edge, saved as
/// Nav2 loads them. The graph itself is the client's. place: one that is_of_graphs() knows. Throws HttpError,
/// UsageError, InputError, Stopped.
HttpResponse answer_of_graphs(const ServedWorld& world, Place place, std::string_view body, const Execution& execution);

/// What a service may spend on its clients.
struct ServiceLimits {
  double budget_s = 10.0;  ///< of each request that is worked on; questions may ask for less
  std::size_t memory_bytes = static_cast<std::size_t>(-1);  ///< that the process may hold
  unsigned threads = 0;                                     ///< of each request
  bool writable = false;                                    ///< does whoever owns the service take changes?
  bool wants_token = false;                                 ///< from those who change
  std::vector<std::string> options = {};  ///< of the command line, which solve has to be given for the same answers
  std::size_t scene_bytes = std::size_t{64} << 20U;  ///< of a scene that is told
  std::size_t tile_bytes = std::size_t{64} << 20U;   ///< of tiles that are kept
  std::size_t path_bytes = std::size_t{1} << 30U;    ///< of paths that are kept; one has half of it at most
  std::size_t most_points = 10'000;                  ///< of a path that an answer lists
  std::size_t most_view_points = 500'000;            ///< of a path that is told by itself
  std::size_t small_body = std::size_t{64} << 10U;
  std::size_t batch_body = std::size_t{4} << 20U;      ///< of a route graph, too
  std::size_t batch_answers = std::size_t{32} << 20U;  ///< bytes
};

/// Of one world, to which it refers.
std::unique_ptr<HttpService> world_service(const ServedWorld& world, const ServiceLimits& limits);

/// A service whose world may be changed while it is asked (docs/service.md): each change makes a new world with a
/// service of its own, and requests that have begun go on in the one that they began in. One change at a time. Changes
/// are refused where limits.writable is false. token: who sends it as `Authorization: Bearer TOKEN` may change the
/// world; empty: whoever reaches it.
std::unique_ptr<HttpService> writable_service(std::unique_ptr<ServedWorld> world, const ServiceLimits& limits,
                                              std::string token);

}  // namespace warren::serve
