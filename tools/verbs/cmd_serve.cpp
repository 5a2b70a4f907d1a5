// SPDX-License-Identifier: BSD-3-Clause
// warren serve: a world or a roadmap in the browser, and for programs that ask by HTTP.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "apps/serve/api/world_service.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/screen/world_files.hpp"
#include "tools/words/option_values.hpp"
#include "tools/words/question_words.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec serve_specs[] = {
    {"--port", "N", "port to listen at; 0 takes a free one (default: 8765)"},
    {"--listen", "ADDRESS",
     "address to listen at, such as 0.0.0.0: whoever reaches it may ask (default: this machine alone)"},
    {.name = "--public-url",
     .value = "URL",
     .help = "another address that leads here, by a proxy or a name: https://NAME/PATH/; may be repeated",
     .may_repeat = true},
    {"--budget", "TIME", "most time for each request (default: 10s)"},
    {"--writable", "",
     "let the world be changed for all who look at it: walls and polygons by the page, cells of a map by programs; no "
     "file is written"},
    {"--token-file", "FILE",
     "with --writable: only who knows this file's first line (16 to 256 letters) may change it"},
    roadmap_world_option,
};

std::unique_ptr<serve::ServedWorld> load_served(const Arguments& arguments, const Run& run) {
  const std::string& file = arguments.operand(0);
  Question body = question_words(arguments);
  read_asked_files(body, arguments, run.execution());
  if (is_roadmap_named(file)) {
    arguments.refuse({"--robot", "--clearance"}, "the roadmap was built with its own");
    arguments.refuse(price_option_specs(), "the roadmap was built with its own; serve its world for others");
    check_rules_of_maps(arguments);
    return std::make_unique<serve::ServedWorld>(load_roadmap(arguments, run.execution()), run.execution());
  }
  arguments.refuse({"--world"}, "is for a roadmap whose file has none, and this is a world");
  return std::make_unique<serve::ServedWorld>(load_world(file, arguments, run.execution()), body, run.execution());
}

serve::HttpPlace place_of(const Arguments& arguments) {
  constexpr std::uint32_t last_port = 65535;
  constexpr std::uint32_t usual_port = 8765;
  const auto port = given_count(arguments, "--port", 0, last_port).value_or(usual_port);
  serve::HttpPlace place{.port = static_cast<std::uint16_t>(port)};
  if (const auto address = arguments.value("--listen")) place.addresses = {*address};
  for (const std::string& text : arguments.values("--public-url")) {
    const auto url = serve::public_url_of(text);
    if (!url) throw UsageError(fmt::format("--public-url: '{}' is no https://NAME/PATH/ that may lead here", text));
    place.public_urls.push_back(*url);
  }
  return place;
}

/// It goes into a field of a request and into the address of the page.
std::string token_of(const Arguments& arguments, const Execution& execution) {
  constexpr std::size_t shortest = 16;
  constexpr std::size_t longest = 256;
  constexpr std::string_view marks = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  const auto name = arguments.value("--token-file");
  if (!name) return {};
  if (!arguments.has("--writable")) throw UsageError("--token-file: is for --writable");
  const InputFile file(std::string(*name), execution);
  std::string_view token = file.bytes().substr(0, file.bytes().find('\n'));
  if (token.ends_with('\r')) token.remove_suffix(1);
  if (token.size() < shortest || token.size() > longest || token.find_first_not_of(marks) != token.npos) {
    throw InputError(std::string(*name), "a first line of 16 to 256 letters, digits, - and _ is expected");
  }
  return std::string(token);
}

int serve(const Arguments& arguments) {
  const serve::HttpPlace place = place_of(arguments);
  const auto budget_s = given_value(arguments, "--budget", duration_value);
  Run run(arguments, RunScope::each_run);
  const std::string token = token_of(arguments, run.execution());
  std::unique_ptr<serve::ServedWorld> world = load_served(arguments, run);
  run.end();
  run.give_back_pages();
  serve::ServiceLimits limits{.memory_bytes = run.execution().deadline->memory_bytes(),
                              .threads = run.execution().threads};
  if (budget_s) limits.budget_s = *budget_s;
  limits.writable = arguments.has("--writable");
  limits.wants_token = !token.empty();
  for (const OptionSpec& option : joined_options({price_option_specs(), world_option_specs()})) {
    for (const std::string& value : arguments.values(option.name)) {
      limits.options.insert(limits.options.end(), {std::string(option.name), value});
    }
  }
  const std::unique_ptr<serve::HttpService> service = serve::writable_service(std::move(world), limits, token);
  const auto server = serve::http_server(place, {.threads = std::max(2U, run.threads())}, *service);
  if (limits.writable && !server->is_loopback() && token.empty()) {
    throw UsageError(
        "--listen: whoever reaches this address could change the world; there --writable needs --token-file");
  }
  if (!server->is_loopback()) {
    say_on_standard_error("warren: warning: whoever reaches this address may ask, and see the world\n");
  }
  print_text(fmt::format("listening on {}\n", server->address()));
  if (std::fflush(stdout) != 0) throw WriteError("standard output", "it did not take all");
  server->run(signal_flag());
  if (signal_flag() != SIGHUP) return exit_code::success;
  say_on_standard_error(fmt::format("warren: stopped: {}; nohup keeps it\n", text_of(StopReason::hang_up)));
  return exit_code::hung_up;
}

}  // namespace

Command serve_command() {
  constexpr std::string_view in_the_page = "is chosen in the page, or in each request";
  return {"serve",
          "FILE",
          "show a world or a roadmap in the browser, and answer by HTTP",
          joined_options({serve_specs,
                          options_but(question_option_specs(), {"--start", "--goal", "--goal-pose", "--contact"}),
                          price_option_specs(), options_but(world_option_specs(), {"--request"}),
                          options_but(run_option_specs(), {"--budget", "--trace"})}),
          serve,
          {{"--start", in_the_page}, {"--goal", in_the_page}, {"--planner", in_the_page}, {"--optimise", in_the_page}}};
}

}  // namespace warren::tools
