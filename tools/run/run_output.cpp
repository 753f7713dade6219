#include "tools/run/run_output.hpp"

#include <chrono>
#include <utility>

#include "runtime/ranks/on_all_ranks.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

RunOutput::RunOutput(tasks::Simulation& simulation, runtime::Executor& executor, Options options)
    : simulation_(simulation), executor_(executor), options_(std::move(options))
{
  if (!options_.in_background) return;
  on_first_rank([&] {
    writer_ = with_resources_for("starting threads", [] { return std::make_unique<runtime::BackgroundWriter>(); });
  });
}

template <class Work>
void RunOutput::on_first_rank(const Work& work) const
{
  runtime::on_first_rank(simulation_.communicator(), work);
}

void RunOutput::begin()
{
  if (options_.in_background) {
    on_first_rank([&] { fields_.emplace(options_.folder); });
  } else {
    fields_.emplace(options_.folder, simulation_.communicator());
  }
}

std::string RunOutput::resume(long last_step, std::size_t n_expected)
{
  if (options_.in_background) {
    on_first_rank([&] { fields_ = runtime::FieldFile::continued(options_.folder, last_step, n_expected); });
  } else {
    fields_ = runtime::FieldFile::continued(options_.folder, last_step, n_expected, simulation_.communicator());
  }
  if (!fields_) return "";
  n_fields_at_start_ = fields_->n_steps();
  return fields_->notice();
}

void RunOutput::write_fields(bool with_nodes)
{
  wait();
  timed(time_.fields, [&] {
    const long step = simulation_.n_steps();
    const double time = simulation_.time();
    runtime::FieldCopy own = simulation_.fields(simulation_.scene().output.fields, with_nodes);
    if (own.nodes && own.nodes->columns.empty()) own.nodes.reset();
    const auto watch = executor_.watch("writing fields");
    if (!options_.in_background) return fields_->write_step(step, time, own.particles, own.nodes);
    const auto all = std::make_shared<runtime::FieldCopy>(
        gathered(std::move(own), simulation_.engine().graph().layout(), simulation_.communicator()));
    leave([this, step, time, all] { fields_->write_step(step, time, all->particles, all->nodes); });
  });
}

void RunOutput::write_checkpoint(const std::string& fingerprint, std::span<const std::byte> host)
{
  wait();
  timed(time_.checkpoints, [&] {
    const std::filesystem::path folder = options_.folder / "checkpoints";
    if (!options_.in_background) {
      const auto watch = executor_.watch("writing a checkpoint");
      return simulation_.engine().write_checkpoint(folder, fingerprint, host, options_.keep);
    }
    const auto copy =
        std::make_shared<runtime::CheckpointCopy>(simulation_.engine().copy_checkpoint(fingerprint, host));
    leave([this, folder, copy] { runtime::write_checkpoint(folder, std::move(*copy), options_.keep); });
  });
}

void RunOutput::finish()
{
  if (!options_.in_background) return;
  const auto watch = executor_.watch("writing what is left to write");
  on_first_rank([&] { writer_->wait(); });
}

void RunOutput::settle()
{
  try {
    finish();
  } catch (const std::exception&) {
    return;  // the run reports what failed first
  }
}

OutputTime RunOutput::time() const
{
  OutputTime all = time_;
  if (writer_ != nullptr) all.waited = writer_->waited();
  return all;
}

template <class Work>
void RunOutput::timed(double& seconds, const Work& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void RunOutput::wait()
{
  if (!options_.in_background) return;
  const auto watch = executor_.watch("waiting for the output before to be written");
  on_first_rank([&] { writer_->wait(); });
}

void RunOutput::leave(std::function<void()> job)
{
  on_first_rank([&] {
    writer_->add([this, job = std::move(job)] {
      options_.expect_own();
      job();
    });
  });
}

}  // namespace tamp::tools
