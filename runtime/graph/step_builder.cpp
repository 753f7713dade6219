#include "runtime/graph/step_builder.hpp"

#include <utility>

namespace tamp::runtime
{

int StepBuilder::add(Instance fresh)
{
  step_.instances.push_back(std::move(fresh));
  return static_cast<int>(step_.instances.size()) - 1;
}

int StepBuilder::add_on_patch(InstanceKind kind, int declaration, int patch, int group)
{
  Instance fresh;
  fresh.kind = kind;
  fresh.declaration = declaration;
  fresh.patch = patch;
  fresh.group = group;
  fresh.rank = layout_[patch].rank;
  return add(std::move(fresh));
}

int StepBuilder::add_on_rank(InstanceKind kind, int declaration, int rank)
{
  Instance fresh;
  fresh.kind = kind;
  fresh.declaration = declaration;
  fresh.rank = rank;
  return add(std::move(fresh));
}

void StepBuilder::edge(int from, int to, const Label* label, int halo, std::size_t bytes, int message)
{
  if (from != to) step_.edges.push_back({from, to, label, halo, bytes, message});
}

bool StepBuilder::crosses(const Transfer& t)
{
  return layout_[t.part.from_patch].rank != instance(t.consumer).rank;
}

void StepBuilder::transfer(const Transfer& t)
{
  if (!crosses(t)) {
    if (t.producer >= 0) edge(t.producer, t.consumer, t.part.label, t.halo, t.bytes);
    return;
  }
  const int m = message_for(t);
  Message& message = step_.messages[static_cast<std::size_t>(m)];
  message.parts.push_back(t.part);
  message.consumers.push_back(t.consumer);
  if (t.producer >= 0) edge(t.producer, message.send, t.part.label, t.halo, t.bytes, m);
  edge(message.receive, t.consumer, t.part.label, t.halo, t.bytes, m);
}

int StepBuilder::copier(const Transfer& t)
{
  return crosses(t) ? step_.messages[static_cast<std::size_t>(message_for(t))].send : t.consumer;
}

int StepBuilder::receiver(const Transfer& t)
{
  return crosses(t) ? step_.messages[static_cast<std::size_t>(message_for(t))].receive : t.consumer;
}

/// The message between two ranks that carries all transfers of this one's purpose.
int StepBuilder::message_for(const Transfer& t)
{
  const int from = layout_[t.part.from_patch].rank;
  const int to = instance(t.consumer).rank;
  const InstanceKind purpose = instance(t.consumer).kind;
  const bool of_one_label = purpose == InstanceKind::fill_halo || purpose == InstanceKind::combine;
  const MessageKey key{purpose, of_one_label ? t.part.label : nullptr, t.maker, from, to};
  const auto [found, fresh] = messages_.try_emplace(key, static_cast<int>(step_.messages.size()));
  if (fresh) {
    const int consumed_by = instance(t.consumer).declaration;
    Message message{purpose, from, to, 0, 0, {}, {}, 0};
    message.send = add_on_rank(InstanceKind::send_message, t.maker >= 0 ? t.maker : consumed_by, from);
    message.receive = add_on_rank(InstanceKind::receive_message, consumed_by, to);
    for (const int end : {message.send, message.receive}) instance(end).message = found->second;
    edge(message.send, message.receive, t.part.label, t.halo, 0, found->second);
    step_.messages.push_back(std::move(message));
  }
  return found->second;
}

IndexBox StepBuilder::box_of(const Label& label, int patch, int halo) const
{
  return grown(label.centring() == Centring::node ? layout_[patch].nodes : layout_[patch].cells, halo,
               layout_.grid().dimension);
}

IndexBox StepBuilder::shared_box(const Label& label, const IndexBox& box, const PatchImage& image, int image_halo) const
{
  return intersection(moved(box, opposite(image.shift)), box_of(label, image.patch, image_halo));
}

std::size_t StepBuilder::bytes_of(const Label& label, const IndexBox& box)
{
  return static_cast<std::size_t>(box.size()) * label.value_bytes();
}

/// Halos may have grown with later readers: only now is it known how much of a patch goes along.
CompiledStep StepBuilder::finish()
{
  for (Message& message : step_.messages) {
    if (message.purpose != InstanceKind::receive_particles) measure(message);
  }
  for (Edge& e : step_.edges) {
    if (e.message < 0) continue;
    const Message& message = step_.messages[static_cast<std::size_t>(e.message)];
    if (e.from == message.send && e.to == message.receive) e.bytes = message.bytes;
  }
  return std::move(step_);
}

void StepBuilder::measure(Message& message)
{
  for (std::size_t k = 0; k < message.parts.size(); ++k) {
    MessagePart& part = message.parts[k];
    if (message.purpose == InstanceKind::combine) {
      message.bytes += part.label->value_bytes();
      continue;
    }
    const int halo = instance(message.consumers[k]).halo;
    const int given = message.purpose == InstanceKind::sum_halo ? halo : 0;
    part.box = shared_box(*part.label, box_of(*part.label, part.to_patch, halo), {part.from_patch, part.shift}, given);
    message.bytes += bytes_of(*part.label, part.box);
  }
}

}  // namespace tamp::runtime
