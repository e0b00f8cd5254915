// Functions that register the subcommands; separate from commands.h, so that main.cpp is compiled without CLI11.
#pragma once

namespace gaitlab::app {

struct Commands;

/// Registration functions, in the order of the program's help.
void add_run(Commands& commands);
void add_watch(Commands& commands);
void add_report(Commands& commands);
void add_check(Commands& commands);
void add_demo(Commands& commands);
void add_remedy(Commands& commands);
void add_manuals(Commands& commands);
void add_explain(Commands& commands);
void add_converge(Commands& commands);
void add_swap(Commands& commands);
void add_sweep(Commands& commands);
void add_optimize(Commands& commands);
void add_evaluate(Commands& commands);
void add_study(Commands& commands);
void add_dynamics(Commands& commands);
void add_figure(Commands& commands);
void add_compare(Commands& commands);
void add_rerun(Commands& commands);
void add_export(Commands& commands);
void add_approve(Commands& commands);
void add_test(Commands& commands);
void add_new(Commands& commands);
void add_completion(Commands& commands);
void add_man(Commands& commands);

}  // namespace gaitlab::app
