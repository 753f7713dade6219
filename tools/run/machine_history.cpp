#include "tools/run/machine_history.hpp"

#include <array>
#include <fstream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tools/scene/tables/csv_table.hpp"
#include "tools/system/capacity.hpp"
#include "tools/system/processor_time.hpp"

namespace tamp::tools
{

namespace
{

const std::vector<std::string>& machine_columns()
{
  static const std::vector<std::string> names{"step",   "time[s]",  "wall[s]", "processor[s]", "wall_per_step[s]",
                                              "rss[B]", "ledger[B]"};
  return names;
}

/// A table that an earlier version has begun goes on without the last column.
bool is_of_earlier_version(const std::filesystem::path& file)
{
  std::string header;
  return std::getline(std::ifstream(file), header) && header.find(machine_columns().back()) == std::string::npos;
}

/// Processor time [s] and memory [bytes] of a rank: resident, and what its ledger knows of.
struct Taken {
  double processor = 0;
  double resident = 0;
  double ledger = 0;
};

}  // namespace

MachineHistory::MachineHistory(runtime::Communicator communicator)
    : communicator_(std::move(communicator)), processor_at_start_(process_seconds())
{
}

void MachineHistory::begin(const std::filesystem::path& folder)
{
  runtime::on_first_rank(communicator_, [&] { csv_.emplace(folder / "machine.csv", machine_columns()); });
}

void MachineHistory::resume(const std::filesystem::path& folder, long kept_until)
{
  runtime::on_first_rank(communicator_, [&] {
    const std::filesystem::path file = folder / "machine.csv";
    runtime::expect_no_stream(file);
    std::vector<std::string> columns = machine_columns();
    if (is_of_earlier_version(file)) columns.pop_back();
    n_columns_ = columns.size();
    csv_ = runtime::CsvWriter::continued(file, columns, kept_until);
    for (const auto& [name, values] : numbers_by_column(file)) {
      if (name == "wall[s]" && !values.empty()) wall_before_ = values.back();
      if (name == "processor[s]" && !values.empty()) processor_before_ = values.back();
    }
  });
}

void MachineHistory::add_step(double seconds)
{
  step_seconds_ += seconds;
  ++n_steps_;
}

void MachineHistory::write_row(long step, double time, std::size_t ledger_bytes)
{
  Taken all;
  const auto own_ledger = static_cast<double>(ledger_bytes);
  for (const Taken& rank :
       communicator_.gather_value(Taken{process_seconds() - processor_at_start_, resident_bytes(), own_ledger})) {
    all.processor += rank.processor;
    all.resident += rank.resident;
    all.ledger += rank.ledger;
  }
  const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
  const double wall_per_step = n_steps_ > 0 ? step_seconds_ / static_cast<double>(n_steps_) : 0;
  runtime::on_first_rank(communicator_, [&] {
    const std::array row{static_cast<double>(step),
                         time,
                         wall_before_ + wall,
                         processor_before_ + all.processor,
                         wall_per_step,
                         all.resident,
                         all.ledger};
    csv_->write_row(std::span(row).first(n_columns_ == 0 ? row.size() : n_columns_));
  });
  step_seconds_ = 0;
  n_steps_ = 0;
}

}  // namespace tamp::tools
