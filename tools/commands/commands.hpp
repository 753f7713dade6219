#pragma once

#include <CLI/CLI.hpp>

/// A function for each command of the program, in the file of its name. It adds the command to `app` with a callback
/// that does the work when the command line has been read, and that throws when it cannot.
namespace tamp::tools
{

CLI::App* add_new_command(CLI::App& app);
CLI::App* add_run_command(CLI::App& app);
CLI::App* add_check_command(CLI::App& app);
CLI::App* add_graph_command(CLI::App& app);
CLI::App* add_profile_command(CLI::App& app);
CLI::App* add_plot_command(CLI::App& app);
CLI::App* add_schema_command(CLI::App& app);
CLI::App* add_drive_command(CLI::App& app);
CLI::App* add_compare_command(CLI::App& app);
CLI::App* add_modulus_command(CLI::App& app);
CLI::App* add_study_command(CLI::App& app);
CLI::App* add_verify_command(CLI::App& app);
CLI::App* add_stability_command(CLI::App& app);
CLI::App* add_bench_command(CLI::App& app);
CLI::App* add_help_command(CLI::App& app);
CLI::App* add_version_command(CLI::App& app);
CLI::App* add_completion_command(CLI::App& app);
CLI::App* add_man_command(CLI::App& app);

}  // namespace tamp::tools
