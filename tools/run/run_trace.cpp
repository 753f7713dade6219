#include "tools/run/run_trace.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/profile/trace_file.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/whole_file.hpp"

namespace tamp::tools
{

namespace
{

std::string missing_steps(const runtime::TraceChoice& choice, const StepsRun& run,
                          const std::vector<runtime::TracedStep>& traced)
{
  const auto n = static_cast<std::int64_t>(traced.size());
  if (choice.kind != runtime::TraceChoice::Kind::range || n == choice.last - choice.first + 1) return {};
  const std::string held =
      traced.empty() ? "no step" : fmt::format("steps {} to {}", traced.front().number, traced.back().number);
  const std::int64_t n_run =
      std::min<std::int64_t>(run.last, choice.last) - std::max<std::int64_t>(run.first, choice.first) + 1;
  const std::string ran =
      run.last < run.first ? "the run had none" : fmt::format("the run had steps {} to {}", run.first, run.last);
  return fmt::format("--trace-steps {}:{}: trace.json holds {}, as {}{}", choice.first, choice.last, held, ran,
                     n < n_run ? ", of which no more fit" : "");
}

}  // namespace

std::string write_trace(const runtime::Engine& engine, const runtime::TraceChoice& choice, const StepsRun& run,
                        const nlohmann::ordered_json& machine, const std::filesystem::path& folder)
{
  const runtime::Trace trace = engine.trace();
  std::string line;
  runtime::on_first_rank(engine.communicator(), [&] {
    runtime::expect_no_stream(folder / "trace.json");
    runtime::WholeFile file(folder / "trace.json");
    runtime::write_trace(
        trace, [&](std::string_view text) { file.write(text); }, machine);
    file.publish();
    line = missing_steps(choice, run, trace.ranks.front().tape.steps);
  });
  return line;
}

}  // namespace tamp::tools
