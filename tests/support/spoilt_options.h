// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "tests/support/thrown_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <limits>
#include <string>

namespace groundglass {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One field of an options struct given a value that it must not have.
template <typename Options>
struct SpoiltField {
  std::string name;
  std::function<void(Options&)> spoil;
};

// The defaults pass Check(), and it names each field that is spoilt. That no field is left out is
// held by a structured binding beside each call: it does not compile when there is one more.
template <typename Options>
void ExpectCheckNamesEach(std::initializer_list<SpoiltField<Options>> fields) {
  EXPECT_NO_THROW(Options().Check());
  for (const SpoiltField<Options>& field : fields) {
    Options options;
    field.spoil(options);
    EXPECT_THAT(ThrownMessage([&] { options.Check(); }), testing::HasSubstr(field.name));
  }
}

}  // namespace groundglass
