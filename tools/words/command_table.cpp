// SPDX-License-Identifier: BSD-3-Clause
// The verbs of the program; main.cpp dispatches to them.
#include "tools/words/command.hpp"

namespace warren {

const std::vector<Command>& command_table() {
  static const std::vector<Command> table{
      generate_command(),   solve_command(),   build_command(),   query_command(),      update_command(),
      export_command(),     largest_command(), scale_command(),   compare_command(),    verify_command(),
      info_command(),       render_command(),  convert_command(), bench_scen_command(), example_command(),
      completion_command(), man_command()};
  return table;
}

}  // namespace warren
