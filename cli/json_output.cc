// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/json_output.h"

#include <cstdio>

namespace groundglass {

void PrintJson(const nlohmann::ordered_json& json) {
  std::printf("%s\n",
              json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

int TellDryRun(const CommonOptions& common,
               const std::string& words,
               const nlohmann::ordered_json& json) {
  if (!common.json) {
    std::printf("would %s\n", words.c_str());
    return kExitDone;
  }
  nlohmann::ordered_json whole = {{"written", false}};
  whole.update(json);
  PrintJson(whole);
  return kExitDone;
}

}  // namespace groundglass
