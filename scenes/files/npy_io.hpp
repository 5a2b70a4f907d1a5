// SPDX-License-Identifier: BSD-3-Clause
// Walls as a NumPy array of shape (n, 4), `<f4` or `<f8`, C order: the fast way in and out. Format versions 1 to 3 are
// read. The file is mapped and copied chunk by chunk in parallel, pages that are copied are given back, so reading n
// walls holds 16 n bytes (32 n where floats don't do) and runs at memory or disk speed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/cell_potential.hpp"
#include "core/run/execution.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

bool is_npy(std::string_view bytes);

/// What the header says of an array of walls that is as long as its file.
struct NpyWalls {
  bool is_float = false;  ///< else double
  std::size_t walls = 0;
  std::size_t data = 0;  ///< where the numbers begin
};
/// Throws InputError.
NpyWalls npy_walls(const InputFile& file);

/// Walls, and for a maze as `generate` writes it (its outline in the first four rows, all walls on the unit grid) also
/// hint, start and goal. Throws InputError for anything but such an array of finite numbers, Stopped at the deadline.
Scene read_npy(const InputFile& file, const Execution& execution);

/// Writes the walls, `<f4` where they are held as floats. Throws InputError if the scene holds obstacles of another
/// kind, and as OutputFile does.
void write_npy(const Scene& scene, const std::string& path, const Execution& execution);
/// Writes the walls of a maze while they are made. Throws WriteError, Stopped.
void write_npy(const WallStrips& walls, const std::string& path, const Execution& execution);

/// A potential (core/base/cell_potential) as an array of doubles of shape (2, rows + 1, columns + 1): values at
/// corners, then at the middles of cells, of which the last row and column mean nothing. Throws WriteError, Stopped.
void write_npy(const CellPotential& potential, const std::string& path, const Execution& execution);
/// Reads what that writes. Throws InputError for anything else, Stopped.
CellPotential read_potential_npy(const InputFile& file, const Execution& execution);

/// What stands before the numbers of a NumPy array: a Python literal, padded so that the numbers begin on a multiple of
/// 64 bytes. The header, format version 1, of an array in C order. `type` as NumPy spells it: "<f8", "<i4", "|S3". A
/// shape without numbers is that of a single value.
std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape);

}  // namespace warren
