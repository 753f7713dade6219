# The runtime as a library of its own (docs/how_to/building.md):
# cmake --install BUILD --component runtime --prefix FOLDER.
# Installed is what a program includes, and what these headers include in turn; tests/install compiles them alone.
set(for_programs
  engine.hpp file_error.hpp step_error.hpp execute/on_workers.hpp graph/dump.hpp graph/page.hpp graph/step_verdict.hpp
  graph/svg.hpp grid/curve_order.hpp profile/compare.hpp profile/dealt_step.hpp profile/mean_step.hpp
  profile/memory_table.hpp profile/report.hpp profile/table.hpp profile/trace_file.hpp
  ranks/deal_patches.hpp ranks/on_all_ranks.hpp storage/background_writer.hpp storage/csv_writer.hpp
  storage/fields/field_file.hpp warehouse/storage_forecast.hpp)
set(included_by_them
  data/bound_argument.hpp data/buffer.hpp data/combine.hpp data/field.hpp data/heap.hpp data/label.hpp
  data/memory_ledger.hpp data/views.hpp execute/bound_graph.hpp execute/clock.hpp execute/clock_line.hpp
  execute/exchange.hpp execute/executor.hpp execute/halo.hpp execute/migration.hpp execute/rank_clocks.hpp
  execute/step_graphs.hpp execute/watchdog.hpp execute/work.hpp graph/declaration.hpp
  graph/fold.hpp graph/graph_error.hpp graph/task_data.hpp graph/task_graph.hpp grid/index_box.hpp
  grid/patch_layout.hpp profile/duration_histogram.hpp profile/over_time.hpp
  profile/profile.hpp profile/profiler.hpp profile/replay.hpp profile/task_rows.hpp profile/trace.hpp
  profile/trace_choice.hpp profile/trace_recorder.hpp profile/worker_waits.hpp ranks/communicator.hpp
  ranks/load_balance.hpp storage/checkpoints/checkpoint.hpp storage/checkpoints/state_tables.hpp
  storage/fields/field_columns.hpp storage/fields/xdmf.hpp storage/file_state.hpp storage/row_share.hpp warehouse/warehouse.hpp)
target_sources(tamp_runtime PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${for_programs}
                                                                                        ${included_by_them})

# As <tamp/runtime/engine.hpp> for programs; headers find each other as "runtime/engine.hpp".
include(GNUInstallDirs)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/tamp_runtime)
set_target_properties(tamp_runtime PROPERTIES EXPORT_NAME runtime)
install(TARGETS tamp_runtime EXPORT tamp_runtime
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tamp COMPONENT runtime
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT tamp_runtime NAMESPACE tamp:: FILE tamp_runtime-targets.cmake DESTINATION ${package} COMPONENT runtime)

include(CMakePackageConfigHelpers)
configure_package_config_file(tamp_runtime-config.cmake.in tamp_runtime-config.cmake INSTALL_DESTINATION ${package}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(tamp_runtime-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/tamp_runtime-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/tamp_runtime-config-version.cmake
        DESTINATION ${package} COMPONENT runtime)
