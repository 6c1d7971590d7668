// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/convert_arguments.h"
#include "exchange/camera_exchange.h"
#include "exchange/city_gml.h"
#include "exchange/city_json.h"
#include "scene/error.h"
#include "scene/formats/atomic_file.h"
#include "scene/formats/osu_io.h"
#include "scene/formats/textured_model_io.h"

#include <utility>

namespace groundglass {
namespace {

// A textured model for programs of cities.
ConvertResult ConvertToCityJson(const ConvertArguments& arguments) {
  TexturedModelReading reading =
      ReadTexturedModel(arguments.input, arguments.model_arguments.Options());
  WriteFilesAtomically(FormatCityJson(reading.textured, arguments.output));
  return {std::to_string(reading.textured.model.faces.size()) + " faces in " + arguments.output,
          std::move(reading.warnings),
          std::move(reading.left_out)};
}

ConvertResult ConvertFromCityGml(const ConvertArguments& arguments) {
  const ModelReading reading = ReadCityGml(arguments.input);
  const PolygonModel& model = reading.model;
  if (EndsIn(arguments.output, ".osu")) {
    WriteFileAtomically(arguments.output, FormatOsu(model));
  } else if (EndsIn(arguments.output, ".obj")) {
    WriteFileAtomically(arguments.output, FormatObj(model));
  } else {
    throw Error(arguments.output, "a CityGML model is written as .osu or .obj");
  }
  return {std::to_string(model.faces.size()) + " faces in " + arguments.output,
          reading.warnings,
          reading.left_out};
}

ConvertResult ConvertCameras(const ConvertArguments& arguments) {
  const ExchangeSource source = ReadExchangeSource(arguments.input, arguments.images);
  ExchangeResult result =
      arguments.format.empty()
          ? WriteCamerasAsViews(source, arguments.output, arguments.lookat_distance)
          : WriteCamerasAs(arguments.format, source, arguments.output);
  return {std::move(result.summary), std::move(result.warnings)};
}

}  // namespace

void AddCameraFormatOption(CLI::App* command, std::string& format) {
  AddChoice(command,
            "--to",
            CameraFormatNames(),
            "write cameras as another program has them:\n" + DescribeCameraFormats(),
            format);
}

std::optional<ConvertResult> ConvertExchanged(const ConvertArguments& arguments) {
  if (!arguments.format.empty() || HasExchangeCameras(arguments.input)) {
    return ConvertCameras(arguments);
  }
  if (EndsIn(arguments.output, ".city.json")) return ConvertToCityJson(arguments);
  if (EndsIn(arguments.input, ".gml")) return ConvertFromCityGml(arguments);
  return std::nullopt;
}

}  // namespace groundglass
