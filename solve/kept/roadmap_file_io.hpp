// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps in files, as docs/file_formats.md describes them: sections of plain numbers, and `meta`, which says in JSON
// what the roadmap is. The same roadmap gives the same bytes, whatever threads, compiler and machine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/run/execution.hpp"
#include "scenes/text/output_file_io.hpp"
#include "solve/kept/roadmap.hpp"
#include "solve/kept/roadmap_file.hpp"

namespace warren {

/// Writes the file beside its place and renames it. `with_world`: whoever asks needs no second file then. Throws
/// WriteError, Stopped.
void write_roadmap(const Roadmap& roadmap, const std::string& path, const Execution& execution = {},
                   bool with_world = true);
/// The same into a file that the caller completes and puts in its place.
void write_roadmap(const Roadmap& roadmap, OutputFile& file, const Execution& execution, bool with_world = true);

/// Reads a whole roadmap and holds all of it against what it promises, but for the walls of a lattice: these are looked
/// at when Roadmap::world is first asked for the whole. `world`: for a file that has none, or to make
/// sure that it is for this one. Throws ReadError, InputError (cut off, damaged, of another version, world or body, or
/// without a world where none is given), Stopped.
Roadmap read_roadmap(std::unique_ptr<RoadmapFile> opened, const Execution& execution, std::optional<Scene> world = {});
/// The same of a file that nobody has opened yet.
inline Roadmap read_roadmap(const std::string& path, const Execution& execution = {}, std::optional<Scene> world = {}) {
  return read_roadmap(std::make_unique<RoadmapFile>(path, execution), execution, std::move(world));
}

/// Does the file begin as a .roadmap does?
inline bool is_roadmap_file(std::string_view first_bytes) { return first_bytes.starts_with(roadmap_magic); }

/// Holds all of a roadmap but its world against what it promises. Throws InputError, Stopped.
void check_roadmap(const RoadmapFile& file, const Execution& execution);

/// `meta` of the file: one JSON object.
std::string roadmap_meta(const RoadmapFile& file, const Execution& execution);

}  // namespace warren
