// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include <random>
#include <span>
#include <string>

namespace groundglass {

// A damaged copy of a text: one to four random edits of bytes, lines and words, with words of
// the trade (huge counts, NaN, hexadecimal, empty names) among what is put in.
std::string Mutate(const std::string& text,
                   std::span<const std::string> dictionary,
                   std::mt19937_64& random);

// How many texts a test tries: GROUNDGLASS_FUZZ_ROUNDS, or a number that suits every day.
int FuzzRounds();

}  // namespace groundglass
