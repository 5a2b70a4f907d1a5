// SPDX-License-Identifier: BSD-3-Clause
// A part of the core's planar map by itself: junctions numbered from 0, slots around them in the order of the plane,
// and how a balanced set of them that cuts it in two is found.
//
// Between the chains lie faces; a closed curve through faces that crosses k chains cuts the map with k junctions or
// fewer. Shortest curves are shortest paths in the dual graph, whose vertices are the faces (Reif 1983): a
// breadth-first search from the longest face, which is where the region was cut from the rest, or the outside, gives
// each face its least number of chains to cross. The chains that are no edges of that search tree are a spanning tree
// of the junctions; each of them, put into the search tree, closes one curve through the first face, and what the curve
// holds is the subtree below the chain (Lipton and Tarjan 1979; the tree and its cotree). So one sum over the spanning
// tree gives the length and the balance of every such curve, and the best one is taken: O(junctions) in all. Corridors
// of mazes make these curves far shorter than straight lines. As junctions have at most four chains, some curve has a
// quarter of the junctions inside.
#pragma once

#include <cstdint>

#include "core/base/raw_vector.hpp"
#include "planners/route_cuts/core_graph.hpp"

namespace warren {

/// A connected part of the map.
struct PlanarRegion {
  RawVector<JunctionId> junction;  ///< of the whole map
  RawVector<HalfEdge> twin;        ///< four slots each, within the region; any number where a slot is empty
  RawVector<std::uint8_t> slots;   ///< a bit for each slot that isn't

  std::size_t size() const { return junction.size(); }
};

/// Which side of a cut a junction is on.
enum class CutSide : std::uint8_t { inside, outside, cut };

/// Scratch of one thread; regions one after the other.
class RegionCut {
 public:
  explicit RegionCut(const Execution& execution) : execution_(execution) {}

  /// The side of each junction; the region has at least two. Throws Stopped.
  const RawVector<CutSide>& cut(const PlanarRegion& region);

 private:
  using Face = std::uint32_t;

  HalfEdge next_around(HalfEdge back) const;
  /// Returns the longest one.
  Face trace_faces();
  void search_faces(Face first);
  void grow_tree();
  HalfEdge best_crossing() const;
  void mark_inside(HalfEdge crossing);
  void list_crossed(HalfEdge crossing);
  void cover_crossed();
  void poll(std::size_t i) const {
    if (i % (1U << 16) == 0) execution_.check();
  }

  const Execution& execution_;
  const PlanarRegion* region_ = nullptr;
  RawVector<Face> face_;               // left of a half-edge
  RawVector<HalfEdge> first_;          // half-edge of a face
  RawVector<std::uint32_t> distance_;  // of a face: chains between it and the first one
  RawVector<HalfEdge> entered_;        // by which half-edge of the face before a face was entered
  RawVector<std::uint8_t> in_search_;  // slots of a junction whose chains are in the search tree
  RawVector<Face> queue_;
  RawVector<HalfEdge> above_;        // half-edge of the junction above that leads to a junction
  RawVector<JunctionId> order_;      // of junctions, parents first
  RawVector<std::uint32_t> weight_;  // junctions below and at one
  RawVector<HalfEdge> crossed_;      // by the curve
  RawVector<CutSide> side_;
};

}  // namespace warren
