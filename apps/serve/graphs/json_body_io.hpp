// SPDX-License-Identifier: BSD-3-Clause
// JSON of strangers, taken value by value: what is not as it should be is refused with its place.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/execution.hpp"

namespace warren::serve {

using OrderedJson = nlohmann::ordered_json;  // people find their keys where they wrote them

/// One object. Throws HttpError (400) for what is none or nested deeper or has a key twice in one object, of which one
/// would be dropped without a word; Stopped where memory is out.
OrderedJson json_object_of(std::string_view text, std::size_t deepest, const Execution& execution);

[[noreturn]] void refuse_json(const std::string& where, std::string_view expected);

/// Each throws HttpError that names `where` for a value that is something else.
double finite_number(const OrderedJson& json, const std::string& where);
std::uint64_t whole_number(const OrderedJson& json, const std::string& where, std::uint64_t most);
const OrderedJson& list_of(const OrderedJson& json, const std::string& where, std::size_t most);
std::string text_in(const OrderedJson& json, const std::string& where);
/// What read(item, its place) makes of the items of a list.
template <class Read>
auto items_of(const OrderedJson& json, const std::string& where, std::size_t most, const Read& read) {
  std::vector<decltype(read(json, where))> items;
  for (const OrderedJson& item : list_of(json, where, most)) {
    items.push_back(read(item, fmt::format("{}[{}]", where, items.size())));
  }
  return items;
}

/// A key that an object may have, and what takes its value.
struct JsonKey {
  std::string_view name;
  std::function<void(const OrderedJson& value, const std::string& key)> take;
};
/// What takes a value: `to` becomes what read(value, key) says.
template <class T, class Read>
auto into(T& to, Read read) {
  return [&to, read](const OrderedJson& value, const std::string& key) { to = read(value, key); };
}
/// All that an object has, in its order. Throws HttpError that names `where` and the keys for any other; names: them in
/// other words.
void take_keys(const OrderedJson& json, const std::string& where, std::initializer_list<JsonKey> keys,
               std::string names = {});

/// nullptr where there is no such key, or it is null.
const OrderedJson* member(const OrderedJson& json, const char* key);

}  // namespace warren::serve
