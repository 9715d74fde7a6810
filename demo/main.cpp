// rubble: runs, shows and describes scenes of destruction. Arguments -> scene -> loop.
#include <exception>
#include <iostream>

#include "demo/command_line.h"
#include "demo/info.h"
#include "demo/input_error.h"
#include "demo/report.h"
#include "rubble/error.h"

namespace {

using namespace rubble::demo;

enum ExitCode { kDone = 0, kFailed = 1, kBadInput = 2, kStopped = 3 };

void execute(const CommandLine& line) {
  if (line.command == CommandLine::Command::Info && isAssetFile(line.scene))
    return describeAsset(line.scene, std::cout);
  const Scene scene = loadScene(line.scene, line.overrides);
  switch (line.command) {
    case CommandLine::Command::Run:
      runScene(scene, line.run, std::cout);
      break;
    case CommandLine::Command::View:
      viewScene(scene, line.view);
      break;
    case CommandLine::Command::Info:
      describeScene(scene, std::cout);
      break;
    case CommandLine::Command::Report:
      report(line.report, std::cout);
      break;
  }
}

int fail(ExitCode code, const std::string& text) {
  std::cerr << "rubble: error: " << oneLine(text) << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    execute(parseCommandLine(argc, argv));
    return kDone;
  } catch (const HelpWanted& help) {
    std::cout << help.text;
    return kDone;
  } catch (const InputError& error) {
    return fail(kBadInput, error.what());
  } catch (const rubble::Error& error) {
    return fail(kBadInput, error.what());
  } catch (const RunStopped& stop) {
    return fail(kStopped, stop.what());
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}
