// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "scene/formats/model_io.h"

namespace groundglass {

// As ReadTexturedModel, and faces whose material has a plain colour and no picture (an OBJ's `Kd`,
// a glTF's baseColorFactor) come on a page of colours (scene/colour_page.h); what is seen through
// counts as solid. The grey with which our own files mark what no photograph shows is no colour.
TexturedModelReading ReadColouredModel(const std::filesystem::path& file,
                                       const ModelOptions& options = {});

}  // namespace groundglass
