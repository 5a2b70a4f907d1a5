// SPDX-License-Identifier: BSD-3-Clause
// What the program's exit code says: the table of docs/file_formats.md.
#pragma once

namespace warren::tools::exit_code {

inline constexpr int success = 0;
inline constexpr int no_path = 1;  ///< or `verify` refutes the answer
inline constexpr int usage = 2;
inline constexpr int bad_data = 65;
inline constexpr int unreadable = 66;
inline constexpr int internal = 70;
inline constexpr int unwritable = 73;
inline constexpr int budget = 124;
inline constexpr int hung_up = 129;
inline constexpr int interrupted = 130;
inline constexpr int terminated = 143;

}  // namespace warren::tools::exit_code
