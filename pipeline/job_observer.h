// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "register/register.h"
#include "scene/progress.h"

#include <functional>
#include <string>

namespace groundglass {

// What a job calls while it is at work, from the thread that it was begun in. Any may be empty.
struct JobObserver {
  // A stage (kRegisterStage, ...) begins to make files. It tells what is returned how far it is.
  std::function<Progress(const std::string& stage)> begun;
  // What an earlier run left of this stage is kept.
  std::function<void(const std::string& stage)> kept;
  // A line for a person, once it is known: a file that somebody has changed is made again, a stage
  // has failed, there is nothing to texture with.
  std::function<void(const std::string& line)> told;
  // The tags are corrected, or the corrected ones kept; the long work on pictures comes next.
  std::function<void(const RegisteredScene& registered)> registered;
  // The texture is made, or the one that was there is kept: this share of the model's surface has
  // one, 0 to 1.
  std::function<void(double covered_share)> textured;

  // Each does nothing if its function is empty.
  Progress Begin(const std::string& stage) const { return begun ? begun(stage) : Progress(); }
  void Keep(const std::string& stage) const {
    if (kept) kept(stage);
  }
  void Tell(const std::string& line) const {
    if (told) told(line);
  }
};

}  // namespace groundglass
