// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#pragma once

#include "invrender/charts/charts.h"
#include "invrender/compose/chart_pixels.h"
#include "invrender/inputs/fill_options.h"
#include "scene/textured_model.h"

namespace groundglass {

// Weak texels within their reach of good ones take their colour from them: the last pixel before
// an edge of the model shows the sky as much as the wall.
void InpaintBorders(ChartPixels& pixels);

// Open texels in slits and specks of a few texels (slit_texels), covered on one side at least, take
// the colour beside them, so that no black hairline shows. No photograph showed them: their
// provenance is kProvenanceFilled.
void CloseHoles(const DilateOptions& options, ChartPixels& pixels);

// Copies a chart to its page and repeats its border around it, `gutter_texels` wide, so that
// filters near the border find only the face's own colour.
void PlaceOnPage(const Chart& chart,
                 const ChartPixels& pixels,
                 int gutter_texels,
                 TexturePage& page);

}  // namespace groundglass
