// The list of subcommands, by the functions that register them; separate from commands.h, so that main.cpp is compiled without
// CLI11.
#pragma once

namespace gaitlab::app {

struct Commands;

void add_run(Commands&), add_watch(Commands&), add_report(Commands&), add_check(Commands&), add_demo(Commands&);
void add_remedy(Commands&), add_manuals(Commands&), add_explain(Commands&), add_converge(Commands&), add_swap(Commands&);
void add_sweep(Commands&), add_optimize(Commands&), add_evaluate(Commands&), add_study(Commands&), add_dynamics(Commands&);
void add_figure(Commands&), add_compare(Commands&), add_rerun(Commands&), add_export(Commands&), add_approve(Commands&);
void add_test(Commands&), add_new(Commands&), add_completion(Commands&), add_man(Commands&), add_identify(Commands&);

/// The order of the program's help.
inline constexpr void (*kSubcommands[])(Commands&) = {
    add_run,   add_watch,  add_report,   add_check,    add_demo,  add_remedy,     add_manuals,  add_explain, add_converge,
    add_swap,  add_sweep,  add_optimize, add_evaluate, add_study, add_identify,   add_dynamics, add_figure,  add_compare,
    add_rerun, add_export, add_approve,  add_test,     add_new,   add_completion, add_man};

}  // namespace gaitlab::app
