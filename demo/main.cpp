// rubble: runs, shows and describes scenes of destruction, and cooks what they are made of. Arguments ->
// scene -> loop.
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

#include "demo/command_line.h"
#include "demo/console.h"
#include "demo/cook.h"
#include "demo/info.h"
#include "demo/input_error.h"
#include "demo/report.h"
#include "demo/setting_choice.h"
#include "rubble/machine_error.h"

namespace {

using namespace rubble::demo;

// `rubble --help` lists them.
enum ExitCode { kDone = 0, kFailed = 1, kBadInput = 2, kStopped = 3 };

void execute(const CommandLine& line) {
  if (line.command == CommandLine::Command::Cook) return cookFile(line.cook, std::cout);
  if (line.command == CommandLine::Command::CaseReport) return caseReport(line.caseReport, std::cout);
  if (line.command == CommandLine::Command::MaterialReport)
    return materialReport(line.materialReport, std::cout);
  if (line.command == CommandLine::Command::SizeReport) return sizeReport(line.sizeReport, std::cout);
  if (line.command == CommandLine::Command::StabilityReport)
    return stabilityReport(line.stabilityReport, std::cout);
  if (line.command == CommandLine::Command::BenchPaper) return benchPaper(line.benchPaper, std::cout);
  if (line.command == CommandLine::Command::Info && isAssetFile(line.scene))
    return describeAsset(line.scene, std::cout);
  Scene scene = loadScene(line.scene, line.overrides);
  switch (line.command) {
    case CommandLine::Command::BenchPaper:  // these have no scene
    case CommandLine::Command::CaseReport:
    case CommandLine::Command::Cook:
    case CommandLine::Command::MaterialReport:
    case CommandLine::Command::SizeReport:
    case CommandLine::Command::StabilityReport:
      break;
    case CommandLine::Command::Run:
      if (line.error) scene = sceneWithin(*line.error, line.scene, line.overrides, consoleLog(), std::cout);
      runScene(scene, line.run, std::cout);
      break;
    case CommandLine::Command::View:
      viewScene(scene, line.view);
      break;
    case CommandLine::Command::Info:
      describeScene(scene, line.run.cache, std::cout);
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

int failWithoutMemory() {
  return fail(kFailed, "out of memory; fewer elements, a coarser dust grid or smaller pictures need less");
}

int finish() {
  if (std::cout.flush()) return kDone;
  return fail(kFailed, "standard output cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    execute(parseCommandLine(argc, argv));
    return finish();
  } catch (const HelpWanted& help) {
    std::cout << help.text;
    return finish();
  } catch (const InputError& error) {
    return fail(kBadInput, error.what());
  } catch (const RunStopped& stop) {
    return fail(kStopped, stop.what());
  } catch (const rubble::MachineError& error) {
    return fail(kFailed, error.what());
  } catch (const rubble::Error& error) {  // the library refuses a definition, so the scene is at fault
    return fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return failWithoutMemory();
  } catch (const std::length_error&) {  // of a container that can never hold so much
    return failWithoutMemory();
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}
