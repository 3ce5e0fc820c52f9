#include <fmt/format.h>

#include <new>

#include "command.h"
#include "prohull/error.h"

int main(int argc, char** argv) {
  using namespace prohull::cli;
  CLI::App app(fmt::format("prohull {}: {}. Ever coarser meshes, each of which provably encloses the finer one.",
                           PROHULL_VERSION, kWhatItIs),
               "prohull");
  app.set_version_flag("--version", "prohull " PROHULL_VERSION);
  app.require_subcommand(1);
  app.fallthrough(false);
  app.footer(
      "prohull COMMAND --help shows the options and examples of a command.\n"
      "Exit codes: 0 done; 1 the answer is no; 2 wrong usage; 3 bad input; 130 interrupted.");
  Run run;
  add_build(app, run);
  add_verify(app, run);
  add_info(app, run);
  add_lod(app, run);
  add_query(app, run);
  add_render(app, run);
  add_sample(app, run);
  add_completion(app, run);
  add_manual(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }

  catch_interrupts();
  const auto tell_interrupted = [] {
    fmt::print(stderr, "prohull: interrupted; nothing was written\n");
    return kInterrupted;
  };
  try {
    return run();
  } catch (const Interrupted&) {
    return tell_interrupted();
  } catch (const prohull::Cancelled&) {
    return tell_interrupted();
  } catch (const prohull::InputError& error) {
    fmt::print(stderr, "prohull: {}\n", error.what());
    return error.defect() == prohull::Defect::InvalidOption ? kWrongUsage : kBadInput;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "prohull: out of memory\n");
    return kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "prohull: {}\n", error.what());
    return kBadInput;
  }
}
