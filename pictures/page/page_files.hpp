// SPDX-License-Identifier: BSD-3-Clause
// Styles and scripts of pages, which the build puts into the library, and how every page begins.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/embedded_file.hpp"

namespace warren {

std::span<const EmbeddedFile> page_files();

/// The bytes of one of them.
std::string_view page_file(std::string_view name);

/// A file as the element that runs it.
std::string script_element(std::string_view name);

/// Up to the end of <head>: the title as plain text, the style, and a policy by which nothing is loaded from anywhere
/// and nothing is run but the scripts of that name, as script_element() writes them.
std::string head_of_page(const std::string& title, std::string_view style, std::span<const std::string_view> scripts);

}  // namespace warren
