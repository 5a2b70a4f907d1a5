// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/roadmap_file.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace warren {
namespace {

TEST(ElementType, IsNamedAsNumpyDoes) {
  EXPECT_EQ(element_type<std::byte>().name(), "|u1");
  EXPECT_EQ(element_type<char>().name(), "|u1");
  EXPECT_EQ(element_type<std::int8_t>().name(), "|i1");
  EXPECT_EQ(element_type<std::uint16_t>().name(), "<u2");
  EXPECT_EQ(element_type<std::int32_t>().name(), "<i4");
  EXPECT_EQ(element_type<std::uint64_t>().name(), "<u8");
  EXPECT_EQ(element_type<float>().name(), "<f4");
  EXPECT_EQ(element_type<double>().name(), "<f8");
  EXPECT_EQ(element_type<double>().bytes(), 8U);
}

TEST(ElementType, IsLegalWhereItsSizeCanBeTold) {
  EXPECT_TRUE((ElementType{{'<', 'c', '8', '\0'}}).is_legal());  // a later version's
  for (const ElementType bad :
       {ElementType{}, ElementType{{'>', 'u', '4', '\0'}}, ElementType{{'<', 'u', '1', '\0'}},
        ElementType{{'|', 'u', '4', '\0'}}, ElementType{{'<', 'u', '3', '\0'}}, ElementType{{'<', 'U', '4', '\0'}},
        ElementType{{'<', 'u', '4', '4'}}, ElementType{{'<', '{', '4', '\0'}}}) {
    EXPECT_FALSE(bad.is_legal()) << std::string_view(bad.code.data(), 4);
  }
}

}  // namespace
}  // namespace warren
