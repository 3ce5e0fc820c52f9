#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <string_view>

#include "command.h"
#include "help.h"
#include "prohull/error.h"

namespace {

using namespace prohull::cli;

/// Options of all commands that name a file to write.
constexpr std::array kOutputs{"--out",  "--report", "--certificate",   "--hierarchy",    "--curve",         "--page",
                              "--html", "--junit",  "--write-budgets", "--write-points", "--write-segments"};

/// What is wrong with the name; empty if nothing is.
std::string names_an_output(const std::string& name) {
  return name.empty() ? "the name of the output is empty; name a file" : "";
}

struct Named {
  std::string_view name;
  void (*add)(CLI::App&, Run&);
};
constexpr Named kCommands[]{{"build", add_build},     {"cage", add_cage},         {"verify", add_verify},
                            {"info", add_info},       {"lod", add_lod},           {"query", add_query},
                            {"collide", add_collide}, {"contains", add_contains}, {"distance", add_distance},
                            {"convex", add_convex},   {"spheres", add_spheres},   {"urdf", add_urdf},
                            {"motion", add_motion},   {"sweep", add_sweep},       {"repair", add_repair},
                            {"render", add_render},   {"view", add_view},         {"sample", add_sample}};

/// All commands, or only the one that is called: the options of all take 2 ms, as long as a small hull.
void add_commands(CLI::App& app, Run& run, std::string_view called) {
  const auto named = std::ranges::find(kCommands, called, &Named::name);
  if (named != std::end(kCommands)) {
    named->add(app, run);
  } else {
    for (const Named& command : kCommands) command.add(app, run);
    add_completion(app, run);
    add_manual(app, run);
    add_help(app, run);
  }
  for (CLI::App* command : app.get_subcommands({})) {
    for (const char* name : kOutputs)
      if (CLI::Option* const output = command->get_option_no_throw(name)) output->check(names_an_output);
    if (command->get_name() == "cage") command->get_option("--inner")->check(names_an_output);  // of query: an input
    CLI::Option* const quiet = command->add_flag(
        "-q,--quiet", console().quiet, "Print no summary and no progress. Errors and files written to - still appear.");
    command->add_flag("-v,--verbose", console().verbose, "Print more about what was done, and how long it took.")
        ->excludes(quiet);
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(fmt::format("prohull {}: {}. Makes ever coarser meshes, each of which provably encloses the finer one.",
                           PROHULL_VERSION, kWhatItIs),
               "prohull");
  app.formatter(std::make_shared<HelpFormatter>());
  app.failure_message(usage_error);
  app.set_help_flag("-h,--help", "Show this help.");
  app.set_version_flag("--version", "prohull " PROHULL_VERSION, "Show the version.");
  app.require_subcommand(1);
  app.fallthrough(false);
  app.footer(
      "`prohull help COMMAND` shows the options and examples of a command.\n"
      "Exit codes: 0 done; 1 the answer is no; 2 wrong usage; 3 bad input; 4 undecided; 130 interrupted.");
  Run run;
  add_commands(app, run, argc > 1 ? argv[1] : "");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  catch_interrupts(remove_unfinished_outputs);
  return run();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int code = parse_and_run(argc, argv);
    flush_standard_output();
    return code;
  } catch (const prohull::Cancelled&) {
    return tell_interrupted();
  } catch (const prohull::InputError& error) {
    tell_error(error.what());
    return error.defect() == prohull::Defect::InvalidOption ? kWrongUsage : kBadInput;
  } catch (const std::bad_alloc&) {
    tell_error("out of memory");
    return kBadInput;
  } catch (const std::exception& error) {
    tell_error(error.what());
    return kBadInput;
  }
}
