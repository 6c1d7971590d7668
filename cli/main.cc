// SPDX-License-Identifier: Apache-2.0
// Part of Groundglass.
#include "cli/commands.h"
#include "scene/error.h"

#include <csignal>
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  using namespace groundglass;
  // A limit on file sizes is a full disk: an error like any other, not the end on the spot.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app{
      "Groundglass corrects hand-measured camera tags against a polygon model, and turns the\n"
      "photographs into a textured model.",
      "groundglass"};
  app.set_version_flag("--version", "groundglass " GROUNDGLASS_VERSION);
  app.require_subcommand(1);
  int exit_status = kExitDone;
  AddRunCommand(app, exit_status);
  AddCheckCommand(app, exit_status);
  AddCalibrateCommand(app, exit_status);
  AddRegisterCommand(app, exit_status);
  AddInvrenderCommand(app, exit_status);
  AddRenderCommand(app, exit_status);
  AddSynthCommand(app, exit_status);
  AddEvaluateCommand(app, exit_status);
  AddConvertCommand(app, exit_status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitWrongUsage;
  } catch (const Error& error) {
    std::fprintf(stderr, "groundglass: %s\n", error.what());
    return kExitWrongInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "groundglass: %s\n", error.what());
    return kExitWrongInput;
  }
  return exit_status;
}
