// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/graphs/json_body_io.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/serve/http/http_message.hpp"
#include "core/base/types.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::serve {
namespace {

/// Throws HttpError where an object has a key twice.
OrderedJson parsed(std::string_view text) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto look = [&](int, OrderedJson::parse_event_t event, OrderedJson& seen) {
    if (event == OrderedJson::parse_event_t::object_start) keys.emplace_back();
    if (event == OrderedJson::parse_event_t::object_end) keys.pop_back();
    if (event != OrderedJson::parse_event_t::key) return true;
    const auto& key = seen.get_ref<const std::string&>();
    if (!keys.back().insert(key).second) refuse_json("body", "each key of an object once");
    return true;
  };
  return OrderedJson::parse(text, look);
}

}  // namespace

[[noreturn]] void refuse_json(const std::string& where, std::string_view expected) {
  throw HttpError(400, "bad_request", "body", fmt::format("{}: expected {}", where, expected));
}

OrderedJson json_object_of(std::string_view text, std::size_t deepest, const Execution& execution) {
  constexpr std::size_t bytes_a_byte = 64;  // of a tree of values
  if (nesting_of(text, NestedIn::whole) > deepest)
    refuse_json("body", fmt::format("JSON that is nested at most {} deep", deepest));
  execution.reserve(bytes_a_byte * text.size());
  try {
    OrderedJson json = parsed(text);
    if (!json.is_object()) refuse_json("body", "one JSON object");
    return json;
  } catch (const OrderedJson::parse_error& error) {
    const auto seen = text.substr(0, std::min(error.byte, text.size()));
    refuse_json(fmt::format("line {}", 1 + std::count(seen.begin(), seen.end(), '\n')), "JSON");
  } catch (const OrderedJson::exception&) {
    refuse_json("body", "JSON whose numbers a double can hold");
  }
}

double finite_number(const OrderedJson& json, const std::string& where) {
  if (!json.is_number()) refuse_json(where, "a number");
  const double number = json.get<double>();
  if (!(std::abs(number) <= largest_coordinate)) refuse_json(where, "a number of at most 1e60");
  return number;
}

std::uint64_t whole_number(const OrderedJson& json, const std::string& where, std::uint64_t most) {
  constexpr double exact = 9007199254740992.0;
  const double number = json.is_number_float() ? json.get<double>() : -1.0;  // 3.0 is one, too
  const bool is_whole = json.is_number_unsigned() || (number >= 0.0 && number < exact && number == std::floor(number));
  if (!is_whole || json.get<std::uint64_t>() > most) refuse_json(where, fmt::format("a whole number, 0 to {}", most));
  return json.get<std::uint64_t>();
}

const OrderedJson& list_of(const OrderedJson& json, const std::string& where, std::size_t most) {
  if (!json.is_array()) refuse_json(where, "a list");
  if (json.size() > most) refuse_json(where, fmt::format("a list of at most {}", grouped(most)));
  return json;
}

std::string text_in(const OrderedJson& json, const std::string& where) {
  if (!json.is_string()) refuse_json(where, "a text");
  return json.get<std::string>();
}

void take_keys(const OrderedJson& json, const std::string& where, std::initializer_list<JsonKey> keys,
               std::string names) {
  for (const auto& [key, value] : json.items()) {
    const auto known = std::ranges::find(keys, std::string_view(key), &JsonKey::name);
    if (known == keys.end() && names.empty()) {
      for (const JsonKey& one : keys) names.append(names.empty() ? "" : ", ").append(one.name);
    }
    if (known == keys.end()) refuse_json(where, "the keys " + names);
    known->take(value, key);
  }
}

const OrderedJson* member(const OrderedJson& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? nullptr : &*found;
}

}  // namespace warren::serve
