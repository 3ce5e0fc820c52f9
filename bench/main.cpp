#include <fmt/format.h>

#include <exception>

#include "command.h"
#include "prohull/error.h"

int main(int argc, char** argv) {
  using namespace prohull::bench;
  CLI::App app("prohull-bench " PROHULL_VERSION ": measures prohull and its peers, and reproduces the paper's tables.",
               "prohull-bench");
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 a hull was not certified, an answer was wrong or a file failed; 2 wrong usage; 3 bad "
      "input.");
  Run run;
  add_construction(app, run);
  add_queues(app, run);
  add_queries(app, run);
  add_rays(app, run);
  add_aimed(app, run);
  add_asked(app, run);
  add_closest(app, run);
  add_collide(app, run);
  add_filters(app, run);
  add_gaps(app, run);
  add_intersections(app, run);
  add_joint_slice(app, run);
  add_leaks(app, run);
  add_looser(app, run);
  add_memory(app, run);
  add_peers(app, run);
  add_covers(app, run);
  add_link_covers(app, run);
  add_scale(app, run);
  add_sweeps(app, run);
  add_tight(app, run);
  add_corpus(app, run);
  add_motion(app, run);
  add_robots(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  try {
    return run();
  } catch (const prohull::InputError& error) {
    fmt::print(stderr, "prohull-bench: {}\n", error.what());
    return error.defect() == prohull::Defect::InvalidOption ? kWrongUsage : kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "prohull-bench: {}\n", error.what());
    return kBadInput;
  }
}
